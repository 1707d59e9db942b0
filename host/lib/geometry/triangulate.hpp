// Triangles of a polygon, for sampling and drawing.
#pragma once
#include <array>
#include <vector>

#include "geometry/polygon.hpp"

namespace host {

using Triangle = std::array<Vec3, 3>;

/// Ear clipping of the bridged loop [Meisters 1975], O(n^3) at worst. Counter-clockwise like the
/// polygon; triangles without area are left out. Polygons that cross themselves give triangles
/// whose areas need not add up.
std::vector<Triangle> triangulate(const Polygon& polygon);

/// Whether the polygon is one loop of four corners, all of them convex.
bool is_convex_quad(const Polygon& polygon);

}  // namespace host
