// pair_cut.hpp -- two patches, each cut to the other's front half-space, and their kernel terms.
#pragma once
#include "least.hpp"
#include "urad/clip.hpp"
#include "urad/pair.hpp"
#include "urad/vec.hpp"

namespace urad {

/// A patch after the cut: its own shape, or the moments of what is left.
struct Cut {
  urad_shape shape;
  urad_point centroid;
  bool clipped;
};

/// False when nothing of `patch` lies in front of the plane. `cut` is filled only where a cut was
/// needed.
inline bool cut_to_front(const urad_scene& scene, const Patch& patch, const PatchPlane& plane,
                         Cut* cut) noexcept {
  const Side side = side_of_plane(scene, patch, plane.on, plane.normal_q30);
  cut->clipped = side == Side::both;
  if (side == Side::behind) return false;
  return side == Side::front ||
         clipped_shape(scene, patch, plane.on, plane.normal_q30, &cut->shape, &cut->centroid);
}

/// The parts of two patches in front of each other. Shapes live as long as the kernel terms that
/// point to them.
struct Cuts {
  Cut i, j;
};

/// Of a patch of which no part is behind the plane: whether one is in front. The greatest of four
/// distances is not below that of the centroid, which is half a unit off in every coordinate.
inline bool clearly_in_front(const Patch& patch, const PatchPlane& plane) noexcept {
  return plane_distance(plane.normal_q30, plane.on, patch.centroid) > kPlaneTolerance + 2;
}

/// Kernel terms of what is left; false when that is nothing. side: what side_of_run() says of i and
/// the surface of j, if it was asked; where the two face each other, looks at every vertex are saved.
inline bool clipped_kernel(const urad_scene& scene, const Patch& i, const Patch& j, Cuts* cuts,
                           PairKernel* kernel, int32_t* limit_q24, bool* clipped,
                           Side side = Side::both) noexcept {
  if (side == Side::front && clearly_in_front(j, plane_of(i))) {
    cuts->i.clipped = cuts->j.clipped = *clipped = false;
    *limit_q24 = least(i.shape->log2_area_q24, j.shape->log2_area_q24);
    return pair_kernel(*i.shape, i.centroid, *j.shape, j.centroid, kernel);
  }
  if (!cut_to_front(scene, i, plane_of(j), &cuts->i) ||
      !cut_to_front(scene, j, plane_of(i), &cuts->j))
    return false;
  const urad_shape& shape_i = cuts->i.clipped ? cuts->i.shape : *i.shape;
  const urad_shape& shape_j = cuts->j.clipped ? cuts->j.shape : *j.shape;
  *clipped = cuts->i.clipped || cuts->j.clipped;
  *limit_q24 = least(shape_i.log2_area_q24, shape_j.log2_area_q24);
  return pair_kernel(shape_i, cuts->i.clipped ? cuts->i.centroid : i.centroid, shape_j,
                     cuts->j.clipped ? cuts->j.centroid : j.centroid, kernel);
}

}  // namespace urad
