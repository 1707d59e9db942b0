// cheapest_floor.hpp -- what no way to a form factor can be surer of than: the grid of coordinates.
#pragma once
#include "cheapest_traits.hpp"

namespace urad {

/// Of a pair found to exchange nothing: all of its factor, or nothing of it.
inline constexpr int16_t kAllOfIt_q8 = 0, kNothingOfIt_q8 = -32767;

/// Every vertex lies behind the plane, whatever rounding did.
inline bool clearly_behind(const urad_scene& scene, const Patch& patch,
                           const PatchPlane& plane) noexcept {
  for (uint16_t k = 0; k < patch.vertex_count; ++k)
    if (plane_distance(plane.normal_q30, plane.on, patch_vertex(scene, patch, k)) >=
        -kPlaneTolerance)
      return false;
  return true;
}

/// Patches of one plane exchange nothing, and neither does what is behind. What lies on the other's
/// plane within rounding might face it.
inline int16_t none_q8(const urad_scene& scene, const Patch& i, const Patch& j) noexcept {
  const urad_surface& surface = *i.surface;
  const bool one_plane =
      i.surface == j.surface && (surface.grid || (surface.flags & URAD_SURFACE_PLANAR));
  return one_plane || clearly_behind(scene, i, plane_of(j)) || clearly_behind(scene, j, plane_of(i))
             ? kNothingOfIt_q8
             : kAllOfIt_q8;
}

/// What rounded vertices leave open of a factor, log2 of its relative error: three units (two
/// vertices and a normal) of the height of the lower centroid over the other's plane. Rounding is no
/// reason to look for a better way: what was guessed decides that, and this is said.
inline int32_t grid_q8(const PairTraits& traits) noexcept {
  return traits.log2_q8[trait_grain] + 405;
}

/// The same of a sum over vertices: a unit at both sides of the narrower patch.
inline int32_t grid_q8(const PairTraits& traits, const PairKernel& kernel) noexcept {
  constexpr int32_t log2_12_q24 = 60145776;
  int32_t floor_q8 = grid_q8(traits);
  for (const PairSide& side : kernel.side) {
    const urad_shape& shape = *side.shape;
    const int32_t log2_length_q24 = (shape.log2_spread_q24 + log2_12_q24) >> 1;
    const int32_t unit_q8 = q8(log2_length_q24 - shape.log2_area_q24);
    if (unit_q8 > floor_q8) floor_q8 = unit_q8;
  }
  return floor_q8;
}

}  // namespace urad
