// Smooth shading: one radiosity per patch becomes one colour per corner, interpolated inside the
// patch.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "scene/scene.hpp"

namespace host {

/// A convex quad or a triangle of a patch: what ray tracers and PLY readers draw.
struct Facet {
  std::array<std::size_t, 4>
      vertex{};  ///< counter-clockwise from the lit side; a triangle repeats its last
  std::size_t patch = 0;
  bool quad = true;
};

/// The corners of all patches. Patches of one surface share a vertex where they meet, unless the
/// surface bends there by more than 60 degrees; patches of different surfaces never do.
struct CornerMesh {
  std::vector<Vec3> vertex;
  std::vector<std::size_t>
      first;  ///< [patches + 1] corners of patch k: corner[first[k]] .. corner[first[k + 1] - 1]
  std::vector<std::size_t> corner;  ///< vertex numbers, outer loop first, then the holes
  std::vector<Facet> facets;        ///< ordered by patch
};

/// Grids match corners by lattice index, which is exact; polygon lists by position, within 1e-4 of
/// the surface's shortest edge, so that two corners of one patch never become one.
CornerMesh merge_corners(const Scene& scene);

/// Colour per vertex: mean of the radiosities of the patches that share it, weighted by area.
/// Throws Error unless there is one radiosity per patch.
std::vector<Vec3> smooth_colours(const Scene& scene, const CornerMesh& mesh,
                                 const std::vector<Vec3>& radiosity);

/// Inside a facet: bilinear on quads, u along corner 0 -> 1 and v along 0 -> 3; barycentric on
/// triangles, v along 0 -> 2. Both are Embree's hit coordinates. Continuous across edges that two
/// facets share.
inline Vec3 interpolate(const Facet& facet, const std::vector<Vec3>& colour, double u, double v) {
  const auto& c = facet.vertex;
  if (!facet.quad) return (1 - u - v) * colour[c[0]] + u * colour[c[1]] + v * colour[c[2]];
  return (1 - v) * ((1 - u) * colour[c[0]] + u * colour[c[1]]) +
         v * ((1 - u) * colour[c[3]] + u * colour[c[2]]);
}

}  // namespace host
