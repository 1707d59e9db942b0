// Polygons in their own plane: two of the three coordinates, exactly as they were given.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/polygon.hpp"

namespace host {

using Vec2 = glm::dvec2;
using Loop2 = std::vector<Vec2>;

/// Drops the coordinate in which the normal is largest, and keeps counter-clockwise
/// counter-clockwise.
struct Projection {
  int u = 0;
  int v = 1;

  explicit Projection(const Vec3& normal) {
    const Vec3 size = glm::abs(normal);
    const int drop = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    u = (drop + 1) % 3;
    v = (drop + 2) % 3;
    if (normal[drop] < 0) std::swap(u, v);
  }
  Vec2 operator()(const Vec3& x) const { return {x[u], x[v]}; }
  Loop2 operator()(const Loop& loop) const {
    Loop2 flat;
    flat.reserve(loop.size());
    for (const Vec3& x : loop) flat.push_back((*this)(x));
    return flat;
  }
};

/// Twice the signed area of the triangle a b c: positive when they run counter-clockwise.
inline double orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a;
  const Vec2 ac = c - a;
  return ab.x * ac.y - ab.y * ac.x;
}

/// -1, 0, 1: c to the right of, on, or to the left of the line a b, "on" being within `tolerance`
/// of it.
inline int side(const Vec2& a, const Vec2& b, const Vec2& c, double tolerance) {
  const double doubled = orientation(a, b, c);
  const double limit = tolerance * glm::length(b - a);
  return doubled > limit ? 1 : doubled < -limit ? -1 : 0;
}

/// Whether the inner parts of the segments a b and c d cross in one point, each clear of the
/// other's line.
inline bool cross_properly(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d,
                           double tolerance) {
  return side(a, b, c, tolerance) * side(a, b, d, tolerance) < 0 &&
         side(c, d, a, tolerance) * side(c, d, b, tolerance) < 0;
}

inline double distance_to_segment(const Vec2& x, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0 ? std::clamp(glm::dot(x - a, ab) / length2, 0.0, 1.0) : 0.0;
  return glm::length(x - a - t * ab);
}

/// 1 inside, -1 outside, 0 within `tolerance` of the loop. Even-odd rule.
inline int locate(const Vec2& x, const Loop2& loop, double tolerance) {
  bool inside = false;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2& a = loop[k];
    const Vec2& b = loop[(k + 1) % loop.size()];
    if (distance_to_segment(x, a, b) <= tolerance) return 0;
    if ((a.y > x.y) != (b.y > x.y) && (orientation(a, b, x) > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside ? 1 : -1;
}

/// The rounding of the largest coordinate: points closer than this cannot be told apart.
inline double coordinate_rounding(const Polygon& polygon) {
  double largest = 0;
  const auto add = [&](const Loop& loop) {
    for (const Vec3& x : loop)
      largest = std::max({largest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  };
  add(polygon.outer);
  for (const Loop& hole : polygon.holes) add(hole);
  return 4 * std::numeric_limits<double>::epsilon() * largest;
}

}  // namespace host
