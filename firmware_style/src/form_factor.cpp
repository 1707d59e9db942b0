#include "urad/form_factor.hpp"

#include "pair_cut.hpp"
#include "urad/lambert.hpp"
#include "urad/log2.hpp"
#include "urad/network.hpp"

namespace urad {

namespace {

int32_t kernel_q24(const PairKernel& pair, Kernel kernel) noexcept {
  return pair.log2_kernel_q24 + (kernel == Kernel::moment ? pair.log2_bend_q24 : 0);
}

/// Whether the exchange of a pair that needed no cut is left out.
bool left_out(const PairKernel& pair, SmallExchange* limit, urad_counters* counters) noexcept {
  constexpr uint32_t kWellBehaved_uq16 = 65536 / 8;
  constexpr int32_t kTwice_q24 = 1 << 24;
  if (!limit || pair.rho_uq16 >= kWellBehaved_uq16) return false;
  const int32_t above_q24 = kernel_q24(pair, Kernel::moment) + kTwice_q24;
  if (above_q24 > limit->least_q24) return false;
  limit->left_out_q24 = above_q24;
  ++counters->skipped_small;
  return true;
}

/// log2 K plus the network's word on it, never above log2 of the smaller area: F <= 1 both ways.
int32_t corrected_q24(const PairKernel& pair, Kernel kernel, const urad_net* net,
                      uint32_t skips_off, int32_t limit_q24, urad_counters* counters) noexcept {
  ++counters->evaluated;
  int32_t log2_g_q24 = kernel_q24(pair, kernel);
  if (net) {
    const bool far = pair.rho_uq16 < net->far_rho_uq16;
    if (far) ++counters->far_pairs;
    if (!far || (skips_off & skip_off_far)) {
      ++counters->networks;
      Pair inputs;
      pair_inputs(pair, &inputs);
      const int32_t y_q16 = network_run(*net, inputs.input_q15);
      log2_g_q24 += far ? 0 : word_q24(y_q16, inputs.gate_uq16);
    }
  }
  return least(log2_g_q24, limit_q24);
}

/// Where kernel and network cannot be right, and the net says so.
bool handed_over(const PairKernel& pair, bool clipped, const urad_net* net) noexcept {
  return net && net->near_rho_uq16 && (clipped || pair.rho_uq16 > net->near_rho_uq16);
}

int32_t no_exchange(urad_counters* counters) noexcept {
  ++counters->skipped_facing;
  return kNoExchange;
}

}  // namespace

bool clipped_pair(const urad_scene& scene, const Patch& i, const Patch& j, Pair* pair,
                  int32_t* limit_q24, bool* clipped) noexcept {
  Cuts cuts;
  PairKernel kernel;
  if (!clipped_kernel(scene, i, j, &cuts, &kernel, limit_q24, clipped)) return false;
  pair_inputs(kernel, pair);
  return true;
}

int32_t exchange_log2_q24(const urad_scene& scene, const Patch& i, const Patch& j, Kernel kernel,
                          const urad_net* net, uint32_t skips_off, urad_counters* counters,
                          SmallExchange* limit) noexcept {
  Cuts cuts;
  PairKernel pair;
  int32_t limit_q24;
  bool clipped;
  if (!clipped_kernel(scene, i, j, &cuts, &pair, &limit_q24, &clipped)) {
    if (!(skips_off & skip_off_facing)) return no_exchange(counters);
    ++counters->evaluated;
    return lambert_exchange_log2_q24(scene, i, j, 1);
  }
  if (!clipped && left_out(pair, limit, counters)) return kNoExchange;
  if (clipped) ++counters->clipped;
  if (handed_over(pair, clipped, net))
    return exchange_exact_q24(scene, i, j, kHandOverPoints, counters);
  return corrected_q24(pair, kernel, net, skips_off, limit_q24, counters);
}

int32_t exchange_in_front_q24(const urad_scene& scene, const Patch& i, const Patch& j,
                              Kernel kernel, const urad_net* net, uint32_t skips_off,
                              urad_counters* counters, SmallExchange* limit) noexcept {
  PairKernel pair;
  if (!pair_kernel(*i.shape, i.centroid, *j.shape, j.centroid, &pair)) return no_exchange(counters);
  if (left_out(pair, limit, counters)) return kNoExchange;
  if (handed_over(pair, false, net))
    return exchange_exact_q24(scene, i, j, kHandOverPoints, counters);
  return corrected_q24(pair, kernel, net, skips_off,
                       least(i.shape->log2_area_q24, j.shape->log2_area_q24), counters);
}

int32_t exchange_exact_q24(const urad_scene& scene, const Patch& i, const Patch& j, int points,
                           urad_counters* counters) noexcept {
  const int32_t log2_g_q24 = lambert_exchange_log2_q24(scene, i, j, points, &counters->sums);
  if (log2_g_q24 == kNoExchange) return no_exchange(counters);
  ++counters->evaluated;
  ++counters->near_pairs;
  return log2_g_q24;
}

uint32_t form_factor_uq32(int32_t log2_exchange_q24, int32_t log2_area_q24) noexcept {
  if (log2_exchange_q24 == kNoExchange) return 0;
  return exp2_uq(log2_exchange_q24 - log2_area_q24, 32);
}

}  // namespace urad
