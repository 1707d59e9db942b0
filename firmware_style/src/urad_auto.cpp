// urad_auto.cpp -- the C interface of cheapest.hpp.
#include "urad/auto.h"

#include "urad/cheapest.hpp"

namespace {

using urad::Way;

static_assert(int(URAD_WAY_KERNEL) == int(Way::kernel));
static_assert(int(URAD_WAY_REFINED) == int(Way::refined));

constexpr uint32_t kLeastError_uq32 = 4296;  // 1e-6

/// log2 of a relative error in Q7.8, rounded down: nobody gets less accuracy
/// than asked for.
int16_t error_q8(uint32_t error_uq32) {
  return int16_t(urad::shift_down(urad::log2_q24(error_uq32), 16) - 32 * 256);
}

/// The inputs of another net would be read beyond those of a pair.
bool reads_pairs(const urad_net* net) { return !net || net->inputs == urad::kPairInputs; }

uint32_t sum_saturated(uint32_t a, uint32_t b) { return a > UINT32_MAX - b ? UINT32_MAX : a + b; }

/// Half a unit of f, by f.
uint32_t rounding_uq32(uint32_t f_uq32) {
  return f_uq32 == 0 ? UINT32_MAX : urad::exp2_uq((31 << 24) - urad::log2_q24(f_uq32), 0);
}

}  // namespace

extern "C" {

urad_status urad_form_factor_auto(const urad_scene* scene, uint16_t from, uint16_t to,
                                  const urad_net* net, uint32_t error_uq32,
                                  urad_auto_factor* factor, urad_counters* counters) {
  if (!scene || !factor || error_uq32 < kLeastError_uq32) return URAD_BAD_ARGUMENT;
  if (from >= scene->patch_count || to >= scene->patch_count) return URAD_BAD_ARGUMENT;
  if (!reads_pairs(net)) return URAD_BAD_NET;
  *factor = {0, 0, 0, URAD_WAY_NONE};
  if (from == to) return URAD_OK;
  urad_counters unread{};
  const urad::Patch i = urad::patch_at(*scene, from), j = urad::patch_at(*scene, to);
  const urad::CheapestPair pair = urad::cheapest_exchange(*scene, i, j, net, error_q8(error_uq32),
                                                          counters ? counters : &unread);
  if (pair.way == Way::none) {
    factor->error_uq32 = urad::exp2_uq(pair.log2_error_q8 * 65536, 32);
    return URAD_OK;
  }
  factor->f_uq32 = urad::form_factor_uq32(pair.log2_exchange_q24, i.shape->log2_area_q24);
  factor->error_uq32 =
      sum_saturated(urad::exp2_uq(pair.log2_error_q8 * 65536, 32), rounding_uq32(factor->f_uq32));
  factor->points = pair.point_sums;
  factor->way = uint16_t(pair.way);
  return URAD_OK;
}

urad_status urad_auto_source_init(urad_source* source, const urad_scene* scene, const urad_net* net,
                                  uint32_t error_uq32, uint16_t rays, urad_counters* counters,
                                  void* memory, size_t bytes) {
  if (error_uq32 < kLeastError_uq32) return URAD_BAD_ARGUMENT;
  const urad_status status =
      urad_pair_source_init(source, scene, URAD_KERNEL_MOMENT, net, rays, counters, memory, bytes);
  if (status != URAD_OK) return status;
  auto* const pairs = static_cast<urad::PairSource*>(memory);
  pairs->log2_error_q8 = error_q8(error_uq32);
  pairs->exchange = urad::cheapest_of_source;
  return URAD_OK;
}

}  // extern "C"
