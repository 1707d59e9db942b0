// Cuts one face of a file into patches.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace host {

/// How finely faces are cut. At most one of the two may be set; neither: as the file says, else
/// whole faces.
struct MeshOptions {
  int subdivide = 0;      ///< N: N x N patches a quad, N^2 similar triangles a triangle
  double patch_size = 0;  ///< longest patch edge wanted, in the file's unit
};

/// A planar polygon of the file.
struct Face {
  Polygon polygon;
  int material = 0;
  std::array<int, 2> counts{1,
                            1};  ///< cuts along the first and the last edge when no option is set
  std::string where;             ///< "file:line", for messages
};

inline constexpr int kMaxPatches = 65535;
inline constexpr int kMaxPolygonVertices = 64;

/// Patches of a face: a grid or a list of polygons.
struct Piece {
  std::optional<Grid> grid;
  std::vector<Polygon> patches;  ///< without a grid
};

/// Cuts a face: parallelogram to a grid, convex quad to bilinear quads, triangle to similar
/// triangles; any other polygon stays whole or becomes triangles cut alike. Adds the patches to
/// *total; throws Error when that exceeds kMaxPatches, before they are made.
Piece cut_face(const Face& face, const MeshOptions& options, std::size_t* total);

/// The polygon laid exactly into its mean plane. Throws Error with `where` for NaN, fewer than 3 or
/// more than kMaxPolygonVertices vertices, no area, a vertex further than 1e-4 of the size from the
/// plane, self-crossing.
Polygon checked_polygon(const Polygon& polygon, const std::string& where);

/// Length of the diagonal of the bounding box. At least one vertex.
double size_of(const Loop& loop);

}  // namespace host
