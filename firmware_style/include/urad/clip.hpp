// clip.hpp -- what of a patch lies in front of a plane: the moments of the part that is left, no
// vertex list kept.
#pragma once
#include "urad/patch.hpp"

namespace urad {

enum class Side : uint8_t { behind, front, both };

struct PatchPlane {
  urad_point on, normal_q30;
};

/// The plane of a patch. All patches of a planar surface have one and the same: vertices rounded by
/// a file put their centroids on either side of each other's planes, and what is cut must not
/// depend on which of a run was asked.
PatchPlane plane_of(const Patch& patch) noexcept;

/// Where the patch lies relative to the plane through `on`; "on the plane" (kPlaneTolerance) counts
/// as either.
Side side_of_plane(const urad_scene& scene, const Patch& patch, const urad_point& on,
                   const urad_point& normal_q30) noexcept;

/// The same for a whole surface: a grid by its four corners; a polygon list answers `both` unless
/// asked patch by patch.
Side side_of_plane(const urad_scene& scene, const urad_surface& surface, const urad_point& on,
                   const urad_point& normal_q30) noexcept;

/// What one look at a shooter and a surface tells of all their pairs: `front` when every patch lies
/// wholly in front of the other's plane, `behind` when none can exchange light.
Side side_of_run(const urad_scene& scene, const Patch& shooter,
                 const urad_surface& surface) noexcept;

/// Moments of the part of `patch` in front of the plane. The fan's centre is a point of the cut, so
/// the closing edges add nothing and one pass over the vertices is enough (Green's theorem on the
/// polygon's dominant plane). False, nothing written, when no area is left.
///   Error   crossings 3e-6 of their edge; of what is left, area 1e-5 and spread 2e-4. K follows the
///   clipped double kernel to 1e-3 (tests/pair_test.cpp)
bool clipped_shape(const urad_scene& scene, const Patch& patch, const urad_point& on,
                   const urad_point& normal_q30, urad_shape* shape, urad_point* centroid) noexcept;

}  // namespace urad
