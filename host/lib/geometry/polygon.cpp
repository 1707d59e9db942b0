#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace host {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

using LongVec3 = glm::vec<3, long double>;

/// Twice the area vector of a loop, seen from `origin` [Newell]. Smaller coordinates, smaller
/// rounding.
template <class Vector = Vec3>
Vector doubled_area(const Loop& loop, const Vec3& origin) {
  Vector sum(0);
  for (std::size_t k = 0; k < loop.size(); ++k)
    sum += glm::cross(Vector(loop[k]) - Vector(origin),
                      Vector(loop[(k + 1) % loop.size()]) - Vector(origin));
  return sum;
}

struct Box {
  Vec3 low{std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity()};
  void add(const Vec3& x) {
    low = glm::min(low, x);
    high = glm::max(high, x);
  }
};

/// Mean of the vertices: a point of the plane, in the middle.
Vec3 mean(const Loop& loop) {
  Vec3 sum(0);
  for (const Vec3& x : loop) sum += x - loop[0];
  return loop[0] + sum / static_cast<double>(loop.size());
}

double largest_coordinate(const Vec3& x) {
  return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)});
}

/// Integrals over the fan of signed triangles (origin, a, b), origin in the plane: area, first and
/// second moment about the origin.
struct Integrals {
  double area = 0;
  Vec3 first{0};
  glm::dmat3 second{0};

  void add_loop(const Loop& loop, const Vec3& origin, const Vec3& normal, double sign) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec3 a = loop[k] - origin;
      const Vec3 b = loop[(k + 1) % loop.size()] - origin;
      const double triangle = sign * 0.5 * glm::dot(normal, glm::cross(a, b));
      const Vec3 sum = a + b;
      area += triangle;
      first += triangle / 3 * sum;
      second += triangle / 12 *
                (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(sum, sum));
    }
  }
};

/// Where the edge meets the plane, given the heights of its ends. From the same end whatever the
/// edge's direction, so that both halves of a polygon, and two polygons with a common edge, get the
/// same point.
Vec3 cut(const Vec3& a, long double ha, const Vec3& b, long double hb) {
  const bool a_first = a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  const LongVec3 from(a_first ? a : b), to(a_first ? b : a);
  const long double share = a_first ? ha / (ha - hb) : hb / (hb - ha);
  return Vec3(from + (to - from) * share);
}

Loop clip_loop(const Loop& loop, const Plane& plane, bool* any_in_front) {
  // A height below the rounding of its own coordinates has no sign: such a vertex is on the plane.
  const auto height = [&](const Vec3& x) {
    const long double h = glm::dot(plane.normal, LongVec3(x) - LongVec3(plane.point));
    const double reach = largest_coordinate(x) + largest_coordinate(plane.point);
    return std::abs(h) <= 4 * kEpsilon * reach ? 0.0L : h;
  };
  Loop kept;
  kept.reserve(loop.size() + 4);
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3& a = loop[k];
    const Vec3& b = loop[(k + 1) % loop.size()];
    const long double ha = height(a);
    const long double hb = height(b);
    if (ha > 0) *any_in_front = true;
    if (ha >= 0) kept.push_back(a);
    if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)) kept.push_back(cut(a, ha, b, hb));
  }
  return kept;
}

}  // namespace

Moments moments(const Polygon& polygon) {
  Moments result;
  Box box;
  for (const Vec3& x : polygon.outer) box.add(x);
  if (polygon.outer.size() < 3) return result;
  const Vec3 origin = mean(polygon.outer);
  const double extent = largest_coordinate(box.high - box.low);
  const Vec3 doubled = doubled_area(polygon.outer, origin);
  const double length = glm::length(doubled);
  const auto count = static_cast<double>(polygon.outer.size());
  if (!(length > kEpsilon * count * extent * extent)) return result;

  const Vec3 normal = doubled / length;
  Integrals sum;
  sum.add_loop(polygon.outer, origin, normal, 1);
  for (const Loop& hole : polygon.holes)
    sum.add_loop(hole, origin, normal,
                 glm::dot(normal, doubled_area(hole, origin)) > 0 ? -1.0 : 1.0);
  if (!(sum.area > kEpsilon * count * extent * extent)) return result;

  const Vec3 shift = sum.first / sum.area;
  result.area = sum.area;
  result.normal = normal;
  result.centroid = origin + shift;
  result.second = sum.second / sum.area - glm::outerProduct(shift, shift);
  return result;
}

std::vector<Loop> boundary(const Polygon& polygon) {
  std::vector<Loop> loops{polygon.outer};
  if (polygon.outer.empty()) return loops;
  const Vec3 normal = doubled_area(polygon.outer, polygon.outer[0]);
  for (const Loop& hole : polygon.holes) {
    loops.push_back(hole);
    if (!hole.empty() && glm::dot(normal, doubled_area(hole, hole[0])) > 0)
      std::reverse(loops.back().begin(), loops.back().end());
  }
  return loops;
}

Polygon clip(const Polygon& polygon, const Vec3& point, const Vec3& normal) {
  return clip(polygon, Plane{point, LongVec3(normal)});
}

Plane plane_of(const Polygon& polygon) {
  const Vec3& point = polygon.outer[0];
  return {point, glm::normalize(doubled_area<LongVec3>(polygon.outer, point))};
}

Polygon clip(const Polygon& polygon, const Plane& plane) {
  bool in_front = false;
  Polygon kept{clip_loop(polygon.outer, plane, &in_front), {}};
  const bool whole = kept.outer.size() == polygon.outer.size();
  if (kept.outer.size() < 3 || (!in_front && !whole)) return {};
  for (const Loop& hole : polygon.holes) {
    bool unused = false;
    Loop loop = clip_loop(hole, plane, &unused);
    if (loop.size() >= 3) kept.holes.push_back(std::move(loop));
  }
  return kept;
}

}  // namespace host
