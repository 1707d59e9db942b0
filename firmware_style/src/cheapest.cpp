#include "urad/cheapest.hpp"

#include "cheapest_models.hpp"
#include "lambert_carrier.hpp"
#include "pair_cut.hpp"
#include "urad/lambert.hpp"
#include "urad/network.hpp"

namespace urad {

namespace {

constexpr int16_t kMostError_q8 = 4 * 256;  // beyond a factor 16 all are equally useless

constexpr uint32_t kNearRho_uq16 = 22938;
constexpr int32_t kLeastDoubt_q8 = -16 * 256;

constexpr int32_t q8(int32_t x_q24) noexcept { return round_shift(x_q24, 16); }

/// log2 of a trait, x with `fraction_bits`; 0 counts as one unit.
constexpr int16_t log2_trait_q8(uint32_t x, int fraction_bits) noexcept {
  return int16_t(q8(log2_q24(x)) - fraction_bits * 256);
}

constexpr int16_t limited_q8(int32_t x) noexcept {
  return int16_t(x > 32767 ? 32767 : x < -32767 ? -32767 : x);
}

/// Opposite corners have the same mean, within 2^-8 of the patch's size.
bool is_parallelogram(const urad_scene& scene, const Patch& patch) noexcept {
  if (patch.surface->grid) return true;
  if (patch.vertex_count != 4) return false;
  const urad_point off = (patch_vertex(scene, patch, 0) - patch_vertex(scene, patch, 1)) -
                         (patch_vertex(scene, patch, 3) - patch_vertex(scene, patch, 2));
  return log2_q24(square(off)) <= patch.shape->log2_spread_q24 - (16 << 24) ||
         square(off) <= uint64_t{16};  // rounding of the corners
}

uint32_t bend_sum_uq22(const PairSide& side) noexcept {
  return 2 * side.size_uq22 + 12 * uint32_t(side.along_q22 > 0 ? side.along_q22 : 0) +
         4 * magnitude(side.across_q22);
}

void fill_traits(const urad_scene& scene, const Patch& i, const Patch& j, const PairKernel& kernel,
                 bool cut, PairTraits* traits) noexcept {
  const PairSide &a = kernel.side[0], &b = kernel.side[1];
  const PairSide& carrier = carries(i, j) ? a : b;
  const bool grazing_a = a.log2_cosine_q24 < b.log2_cosine_q24;
  const bool thin_a = a.shape->fill_uq15 < b.shape->fill_uq15;
  int16_t* const t = traits->log2_q8;
  t[trait_bend_sum] = log2_trait_q8(bend_sum_uq22(a) + bend_sum_uq22(b), 22);
  t[trait_bend] = log2_trait_q8(magnitude(kernel.log2_bend_q24), 24);
  t[trait_rho] = log2_trait_q8(kernel.rho_uq22, 22);
  t[trait_cosine_least] = limited_q8(q8((grazing_a ? a : b).log2_cosine_q24));
  t[trait_cosine_most] = limited_q8(q8((grazing_a ? b : a).log2_cosine_q24));
  t[trait_fill] = log2_trait_q8((thin_a ? a : b).shape->fill_uq15, 15);
  t[trait_size] = limited_q8(q8(carrier.log2_slope_q24 + carrier.log2_cosine_other_q24));
  t[trait_slant] = limited_q8(q8(carrier.log2_slope_q24 - carrier.log2_cosine_other_q24));
  t[trait_doubt] = 0;
  traits->pair_class = cut                               ? PairClass::cut
                       : kernel.rho_uq16 > kNearRho_uq16 ? PairClass::near
                       : is_parallelogram(scene, i) && is_parallelogram(scene, j)
                           ? PairClass::symmetric
                           : PairClass::lopsided;
}

/// Sums that hardly doubt themselves are as exact as their rounding.
constexpr int16_t doubt_q8(int32_t log2_doubt_q24) noexcept {
  const int32_t doubt = q8(log2_doubt_q24);
  return int16_t(doubt < kLeastDoubt_q8 ? kLeastDoubt_q8 : doubt > 32767 ? 32767 : doubt);
}

int32_t weighted_q8(const ErrorModel& model, const PairTraits& traits) noexcept {
  int32_t sum_q16 = 0;
  for (int k = 0; k < kTraits; ++k) sum_q16 += model.weight_q8[k] * traits.log2_q8[k];
  return model.base_q8 + shift_down(sum_q16, 8);
}

const ErrorModel& model_of(Way way, const PairTraits& traits) noexcept {
  return kErrorModel[int(way)][int(traits.pair_class)];
}

int16_t within_q8(int32_t error_q8, int32_t floor_q8) noexcept {
  const int32_t above = error_q8 > floor_q8 ? error_q8 : floor_q8;
  return int16_t(above > kMostError_q8 ? kMostError_q8 : above);
}

int32_t by_kernel_q24(const PairKernel& kernel) noexcept {
  return kernel.log2_kernel_q24 + kernel.log2_bend_q24;
}

int32_t by_network_q24(const PairKernel& kernel, const urad_net& net) noexcept {
  if (kernel.rho_uq16 < net.far_rho_uq16) return by_kernel_q24(kernel);
  Pair inputs;
  pair_inputs(kernel, &inputs);
  return by_kernel_q24(kernel) + mul_round(network_run(net, inputs.input_q15), inputs.gate_uq16, 8);
}

/// What a sum's own rounding leaves in doubt: kSumRounding of the factor, whatever that is.
int32_t rounding_q8(const Patch& i, const Patch& j, int32_t log2_g_q24) noexcept {
  const Patch& carrier = carries(i, j) ? i : j;
  return kSumRounding_q8 - q8(log2_g_q24 - carrier.shape->log2_area_q24);
}

}  // namespace

CheapestPair cheapest_exchange(const urad_scene& scene, const Patch& i, const Patch& j,
                               const urad_net* net, int16_t log2_error_q8,
                               urad_counters* counters) noexcept {
  Cuts cuts;
  PairKernel kernel;
  PairTraits traits;
  int32_t limit_q24 = 0;
  bool cut = true;
  uint16_t point_sums = 0;
  const bool known = clipped_kernel(scene, i, j, &cuts, &kernel, &limit_q24, &cut);
  const auto found = [&](int32_t log2_g_q24, Way way, int32_t floor_q8) {
    ++counters->evaluated;
    if (cut) ++counters->clipped;
    if (way == Way::kernel) ++counters->far_pairs;
    if (way > Way::network) ++counters->near_pairs;
    return CheapestPair{least(log2_g_q24, limit_q24),
                        within_q8(weighted_q8(model_of(way, traits), traits), floor_q8), way,
                        point_sums};
  };
  const auto nothing = [&] {
    ++counters->skipped_facing;
    return CheapestPair{kNoExchange, -32767, Way::none, 0};
  };
  if (!known) return nothing();
  fill_traits(scene, i, j, kernel, cut, &traits);
  const auto good = [&](Way way) {
    return within_q8(weighted_q8(model_of(way, traits), traits), kKernelFloor_q8) <= log2_error_q8;
  };
  if (good(Way::kernel)) return found(by_kernel_q24(kernel), Way::kernel, kKernelFloor_q8);
  if (net && !cut && good(Way::network))
    return found(by_network_q24(kernel, *net), Way::network, kKernelFloor_q8);

  const auto sum_found = [&](const LambertSum& sum, Way way) {
    traits.log2_q8[trait_doubt] = doubt_q8(sum.log2_doubt_q24);
    return found(sum.log2_exchange_q24, way, rounding_q8(i, j, sum.log2_exchange_q24));
  };
  if (good(Way::point)) {
    const LambertSum sum = lambert_whole(scene, i, j, 1);
    point_sums = sum.point_sums;
    if (sum.log2_exchange_q24 != kNoExchange) return sum_found(sum, Way::point);
  }
  for (int points = 2; points <= 3; ++points) {
    const Way way = points == 2 ? Way::four_points : Way::nine_points;
    const ErrorModel& before = kErrorBefore[points - 2][int(traits.pair_class)];
    if (weighted_q8(before, traits) > log2_error_q8) continue;
    const LambertSum sum = lambert_whole(scene, i, j, points);
    point_sums = uint16_t(point_sums + sum.point_sums);
    traits.log2_q8[trait_doubt] = doubt_q8(sum.log2_doubt_q24);
    if (sum.log2_exchange_q24 != kNoExchange && good(way)) return sum_found(sum, way);
    traits.log2_q8[trait_doubt] = 0;
  }
  const int32_t rest_q8 = weighted_q8(model_of(Way::refined, traits), traits);
  const int32_t wanted_q16 = (log2_error_q8 - rest_q8) * kRefinedInverse_q8[int(traits.pair_class)];
  const LambertSum sum = lambert_refined(scene, i, j, wanted_q16 * 256);
  if (sum.log2_exchange_q24 == kNoExchange) return nothing();
  point_sums = uint16_t(point_sums + sum.point_sums);
  return sum_found(sum, Way::refined);
}

int32_t cheapest_of_source(const PairSource& source, const Patch& i, const Patch& j) noexcept {
  const CheapestPair pair =
      cheapest_exchange(*source.scene, i, j, source.net, source.log2_error_q8, source.counters);
  if (source.ways) ++source.ways[int(pair.way)];
  return pair.log2_exchange_q24;
}

bool exchange_by(const urad_scene& scene, const Patch& i, const Patch& j, Way way,
                 const urad_net* net, int32_t log2_doubt_q24, int32_t* log2_exchange_q24,
                 PairTraits* traits) noexcept {
  Cuts cuts;
  PairKernel kernel;
  int32_t limit_q24;
  bool cut;
  if (!clipped_kernel(scene, i, j, &cuts, &kernel, &limit_q24, &cut)) return false;
  fill_traits(scene, i, j, kernel, cut, traits);
  LambertSum sum{kNoExchange, 0, 0};
  switch (way) {
    case Way::kernel:
      sum.log2_exchange_q24 = by_kernel_q24(kernel);
      break;
    case Way::network:
      if (net) sum.log2_exchange_q24 = by_network_q24(kernel, *net);
      break;
    case Way::point:
    case Way::four_points:
    case Way::nine_points:
      sum = lambert_whole(scene, i, j, int(way) - int(Way::point) + 1);
      break;
    case Way::refined:
      sum = lambert_refined(scene, i, j, log2_doubt_q24);
      break;
    case Way::none:
      break;
  }
  traits->log2_q8[trait_doubt] = doubt_q8(sum.log2_doubt_q24);
  *log2_exchange_q24 = sum.log2_exchange_q24;
  if (sum.log2_exchange_q24 == kNoExchange) return false;
  *log2_exchange_q24 = least(sum.log2_exchange_q24, limit_q24);
  return true;
}

}  // namespace urad
