#include "urad/form_factor.hpp"

#include "urad/clip.hpp"
#include "urad/log2.hpp"
#include "urad/network.hpp"

namespace urad {

namespace {

/// A patch after the cut: its own shape, or the moments of what is left.
struct Cut {
  urad_shape shape;
  urad_point centroid;
  bool clipped;
};

/// False when nothing of `patch` lies in front of the plane. `cut` is filled only where a cut was
/// needed.
bool cut_to_front(const urad_scene& scene, const Patch& patch, const Patch& plane,
                  Cut* cut) noexcept {
  const Side side = side_of_plane(scene, patch, plane.centroid, plane.shape->normal_q30);
  cut->clipped = side == Side::both;
  if (side == Side::behind) return false;
  return side == Side::front || clipped_shape(scene, patch, plane.centroid, plane.shape->normal_q30,
                                              &cut->shape, &cut->centroid);
}

int32_t least(int32_t a, int32_t b) noexcept { return a < b ? a : b; }

/// log2 K plus the network's word on it, never above log2 of the smaller area: F <= 1 both ways.
int32_t corrected_q24(const Pair& pair, Kernel kernel, const urad_net* net, uint32_t skips_off,
                      int32_t limit_q24, urad_counters* counters) noexcept {
  ++counters->evaluated;
  int32_t log2_g_q24 = pair.log2_kernel_q24;
  if (kernel == Kernel::moment) log2_g_q24 += pair.log2_bend_q24;
  if (net) {
    const bool far = pair.rho_uq16 < net->far_rho_uq16;
    if (far) ++counters->far_pairs;
    if (!far || (skips_off & skip_off_far)) {
      const int32_t y_q16 = network_run(*net, pair.input_q15);
      log2_g_q24 += far ? 0 : int32_t(round_shift(int64_t{y_q16} * pair.gate_uq16, 8));
    }
  }
  return least(log2_g_q24, limit_q24);
}

int32_t no_exchange(urad_counters* counters) noexcept {
  ++counters->skipped_facing;
  return kNoExchange;
}

}  // namespace

bool clipped_pair(const urad_scene& scene, const Patch& i, const Patch& j, Pair* pair,
                  int32_t* limit_q24, bool* clipped) noexcept {
  Cut cut_i, cut_j;
  if (!cut_to_front(scene, i, j, &cut_i) || !cut_to_front(scene, j, i, &cut_j)) return false;
  const urad_shape& shape_i = cut_i.clipped ? cut_i.shape : *i.shape;
  const urad_shape& shape_j = cut_j.clipped ? cut_j.shape : *j.shape;
  *clipped = cut_i.clipped || cut_j.clipped;
  *limit_q24 = least(shape_i.log2_area_q24, shape_j.log2_area_q24);
  return pair_invariants(shape_i, cut_i.clipped ? cut_i.centroid : i.centroid, shape_j,
                         cut_j.clipped ? cut_j.centroid : j.centroid, pair);
}

int32_t exchange_log2_q24(const urad_scene& scene, const Patch& i, const Patch& j, Kernel kernel,
                          const urad_net* net, uint32_t skips_off,
                          urad_counters* counters) noexcept {
  Pair pair;
  int32_t limit_q24;
  bool clipped;
  if (!clipped_pair(scene, i, j, &pair, &limit_q24, &clipped)) return no_exchange(counters);
  if (clipped) ++counters->clipped;
  return corrected_q24(pair, kernel, net, skips_off, limit_q24, counters);
}

int32_t exchange_in_front_q24(const Patch& i, const Patch& j, Kernel kernel, const urad_net* net,
                              uint32_t skips_off, urad_counters* counters) noexcept {
  Pair pair;
  if (!pair_invariants(*i.shape, i.centroid, *j.shape, j.centroid, &pair))
    return no_exchange(counters);
  return corrected_q24(pair, kernel, net, skips_off,
                       least(i.shape->log2_area_q24, j.shape->log2_area_q24), counters);
}

uint32_t form_factor_uq32(int32_t log2_exchange_q24, int32_t log2_area_q24) noexcept {
  if (log2_exchange_q24 == kNoExchange) return 0;
  return exp2_uq(log2_exchange_q24 - log2_area_q24, 32);
}

}  // namespace urad
