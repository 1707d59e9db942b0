// A planar polygon with holes and its moments: all that a form factor needs to know of a patch.
#pragma once
#include <glm/glm.hpp>
#include <vector>

namespace host {

using Vec3 = glm::dvec3;
using Loop = std::vector<Vec3>;

/// Planar polygon, counter-clockwise seen from its lit side. Holes may run in either direction.
struct Polygon {
  Loop outer;
  std::vector<Loop> holes;
};

/// Area, centroid, unit normal on the lit side, and M = (1/A) integral (x - c)(x - c)^T dA.
struct Moments {
  double area = 0;
  Vec3 centroid{0};
  Vec3 normal{0};
  glm::dmat3 second{0};
};

/// Moments of any planar polygon, holes subtracted. A polygon without area gives area 0 and normal
/// 0.
Moments moments(const Polygon& polygon);

/// Outer loop first, then the holes, each turned to run against the outer loop, so that sums over
/// all edges are integrals over the boundary.
std::vector<Loop> boundary(const Polygon& polygon);

/// The part of `polygon` with normal . (x - point) >= 0 (Sutherland-Hodgman per loop, so that edges
/// along the plane may be traversed twice; every integral over the result is right). Empty outer
/// loop when nothing is left.
Polygon clip(const Polygon& polygon, const Vec3& point, const Vec3& normal);

/// A plane in more digits than coordinates have: where two planes almost agree, the line in which
/// they meet moves by the rounding of a normal over the angle between them.
struct Plane {
  Vec3 point;
  glm::vec<3, long double> normal;  ///< unit length
};

/// The plane of a polygon with an area, through its first vertex.
Plane plane_of(const Polygon& polygon);

Polygon clip(const Polygon& polygon, const Plane& plane);

}  // namespace host
