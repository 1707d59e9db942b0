// cheapest_traits.hpp -- what the kernel of a pair, and then a sum, say about errors.
#pragma once
#include "lambert_carrier.hpp"
#include "pair_cut.hpp"
#include "urad/cheapest.hpp"

namespace urad {

inline constexpr uint32_t kNearRho_uq16 = 22938;

constexpr int32_t q8(int32_t x_q24) noexcept { return round_shift(x_q24, 16); }

constexpr int16_t trait_q8(int32_t x_q8) noexcept {
  return int16_t(x_q8 > kTraitLimit_q8    ? kTraitLimit_q8
                 : x_q8 < -kTraitLimit_q8 ? -kTraitLimit_q8
                                          : x_q8);
}

/// log2 of x with `fraction_bits`, 8 to 24: within the limit of traits. 0 counts as one unit.
constexpr int16_t log2_trait_q8(uint32_t x, int fraction_bits) noexcept {
  return int16_t(int32_t((uint32_t(log2_q24(x)) + 0x8000u) >> 16) - fraction_bits * 256);
}

/// Opposite corners have the same mean, within 2^-8 of the patch's size.
inline bool is_parallelogram(const urad_scene& scene, const Patch& patch) noexcept {
  if (patch.surface->grid) return true;
  if (patch.vertex_count != 4) return false;
  const urad_point off = (patch_vertex(scene, patch, 0) - patch_vertex(scene, patch, 1)) -
                         (patch_vertex(scene, patch, 3) - patch_vertex(scene, patch, 2));
  return log2_q24(square(off)) <= patch.shape->log2_spread_q24 - (16 << 24) ||
         square(off) <= uint64_t{16};  // rounding of the corners
}

inline uint32_t bends_uq22(const PairSide& side) noexcept {
  return 2 * side.size_uq22 + 12 * uint32_t(side.along_q22 > 0 ? side.along_q22 : 0) +
         4 * magnitude(side.across_q22);
}

inline int32_t log2_size_q8(const PairSide& side) noexcept {
  return q8(side.log2_slope_q24 + side.log2_cosine_other_q24);
}

/// log2 of the distance of the centroids, in scene units.
inline int32_t log2_distance_q24(const PairSide& side) noexcept {
  return shift_down(side.shape->log2_spread_q24 - side.log2_slope_q24 - side.log2_cosine_other_q24,
                    1);
}

inline void fill_traits(const urad_scene& scene, const Patch& i, const Patch& j, const Cuts& cuts,
                        const PairKernel& kernel, PairTraits* traits) noexcept {
  const bool first = carries(i, j);
  const PairSide &carrier = kernel.side[first ? 0 : 1], &receiver = kernel.side[first ? 1 : 0];
  const bool cut_carrier = (first ? cuts.i : cuts.j).clipped;
  const bool cut_receiver = (first ? cuts.j : cuts.i).clipped;
  const int32_t cosine_carrier_q8 = q8(carrier.log2_cosine_q24);
  const int32_t cosine_receiver_q8 = q8(receiver.log2_cosine_q24);
  const int32_t areas_q24 = receiver.shape->log2_area_q24 - carrier.shape->log2_area_q24;
  const int32_t area_least_q24 = least(receiver.shape->log2_area_q24, carrier.shape->log2_area_q24);
  const int lopsided = int(!is_parallelogram(scene, i)) + int(!is_parallelogram(scene, j));
  int16_t* const t = traits->log2_q8;
  t[trait_bends_carrier] = log2_trait_q8(bends_uq22(carrier), 22);
  t[trait_bends_receiver] = log2_trait_q8(bends_uq22(receiver), 22);
  t[trait_bend] = log2_trait_q8(magnitude(kernel.log2_bend_q24), 24);
  t[trait_rho] = log2_trait_q8(kernel.rho_uq22, 22);
  t[trait_cosine_carrier] = trait_q8(cosine_carrier_q8);
  t[trait_cosine_receiver] = trait_q8(cosine_receiver_q8);
  t[trait_fill_carrier] = log2_trait_q8(carrier.shape->fill_uq15, 15);
  t[trait_fill_receiver] = log2_trait_q8(receiver.shape->fill_uq15, 15);
  t[trait_size_carrier] = trait_q8(log2_size_q8(carrier));
  t[trait_size_receiver] = trait_q8(log2_size_q8(receiver));
  t[trait_areas] = trait_q8(q8(areas_q24));
  t[trait_grain] =
      trait_q8(-q8(log2_distance_q24(carrier)) - least(cosine_carrier_q8, cosine_receiver_q8));
  t[trait_factor] =
      trait_q8(q8(kernel.log2_kernel_q24 - area_least_q24) + q8(kernel.log2_bend_q24));
  t[trait_facing] = int16_t(-round_shift(dot(i.shape->normal_q30, j.shape->normal_q30), 50));
  t[trait_shapes] = int16_t(lopsided * 256);
  t[trait_cut] = int16_t((cut_receiver ? 4 * 256 : 0) + (cut_carrier ? 8 * 256 : 0));
  traits->pair_class = cut_carrier || cut_receiver       ? PairClass::cut
                       : kernel.rho_uq16 > kNearRho_uq16 ? PairClass::near
                       : lopsided == 0                   ? PairClass::symmetric
                                                         : PairClass::lopsided;
}

/// A bound on |T3|, log2: 3/2 of the greater T2 if nothing cancelled, over sqrt 2. It holds for 99 %
/// of the pairs of every kind; those of triangles come nearest (tests/third_order_fixed_test.cpp).
inline int32_t most_third_q8(const PairTraits& traits) noexcept {
  const int32_t one = traits.log2_q8[trait_bends_carrier];
  const int32_t other = traits.log2_q8[trait_bends_receiver];
  const int32_t bends_q8 = one > other ? one : other;
  return bends_q8 + shift_down(bends_q8, 1) - 128;
}

/// Adds what is known once there is a sum.
inline void fill_traits(const LambertSum& sum, int32_t log2_by_kernel_q24,
                        PairTraits* traits) noexcept {
  int32_t off_q8 = q8(sum.log2_exchange_q24) - q8(log2_by_kernel_q24);
  off_q8 = off_q8 > kTraitLimit_q8    ? kTraitLimit_q8
           : off_q8 < -kTraitLimit_q8 ? -kTraitLimit_q8
                                      : off_q8;
  traits->log2_q8[trait_off] = log2_trait_q8(magnitude(off_q8), 8);
  for (int k = 0; k < kSumTraits; ++k) traits->log2_q8[trait_sum + k] = sum.log2_trait_q8[k];
}

}  // namespace urad
