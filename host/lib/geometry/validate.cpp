#include "geometry/validate.hpp"

#include <cmath>

#include "geometry/planar.hpp"

namespace host {
namespace {

constexpr double kPlanarity = 1e-6;

template <class Test>
bool any_vertex(const Polygon& polygon, Test test) {
  const auto in_loop = [&](const Loop& loop) {
    for (const Vec3& x : loop)
      if (test(x)) return true;
    return false;
  };
  if (in_loop(polygon.outer)) return true;
  for (const Loop& hole : polygon.holes)
    if (in_loop(hole)) return true;
  return false;
}

template <class Test>
bool any_loop(const Polygon& polygon, Test test) {
  if (test(polygon.outer)) return true;
  for (const Loop& hole : polygon.holes)
    if (test(hole)) return true;
  return false;
}

bool has_nan(const Vec3& x) { return std::isnan(x.x) || std::isnan(x.y) || std::isnan(x.z); }
bool has_infinity(const Vec3& x) { return std::isinf(x.x) || std::isinf(x.y) || std::isinf(x.z); }

bool repeats_vertex(const Loop& loop) {
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (loop[k] == loop[(k + 1) % loop.size()]) return true;
  return false;
}

/// The plane through a loop's widest triangle: first vertex, the one furthest from it, the one
/// furthest from their line. It exists also where the signed areas of a crossed loop cancel.
struct WidestTriangle {
  Vec3 normal{0};    // zero when the loop is one line
  double width = 0;  // height of the triangle over its longest side

  explicit WidestTriangle(const Loop& loop) {
    Vec3 axis(0);
    for (const Vec3& x : loop)
      if (glm::length(x - loop[0]) > glm::length(axis)) axis = x - loop[0];
    const double length = glm::length(axis);
    if (!(length > 0)) return;
    for (const Vec3& x : loop) {
      const Vec3 cross = glm::cross(axis / length, x - loop[0]);
      if (glm::length(cross) > width) {
        width = glm::length(cross);
        normal = cross / width;
      }
    }
  }
};

double box_diagonal(const Loop& loop) {
  Vec3 low = loop[0];
  Vec3 high = loop[0];
  for (const Vec3& x : loop) {
    low = glm::min(low, x);
    high = glm::max(high, x);
  }
  return glm::length(high - low);
}

/// Loops that touch or cross themselves: edges that share no vertex must keep apart, and neighbours
/// must not fold back.
bool touches_itself(const Loop2& loop, double tolerance) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& a = loop[i];
    const Vec2& b = loop[(i + 1) % n];
    const Vec2& after = loop[(i + 2) % n];
    if (distance_to_segment(a, b, after) <= tolerance ||
        distance_to_segment(after, a, b) <= tolerance)
      return true;
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const Vec2& c = loop[j];
      const Vec2& d = loop[(j + 1) % n];
      if (cross_properly(a, b, c, d, 0) || distance_to_segment(a, c, d) <= tolerance ||
          distance_to_segment(b, c, d) <= tolerance || distance_to_segment(c, a, b) <= tolerance ||
          distance_to_segment(d, a, b) <= tolerance)
        return true;
    }
  }
  return false;
}

bool crosses_itself_properly(const Loop2& loop, double tolerance) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j)
      if (cross_properly(loop[i], loop[(i + 1) % n], loop[j], loop[(j + 1) % n], tolerance))
        return true;
  return false;
}

/// Whether two segments of one line share more than a point.
bool overlap(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double tolerance) {
  if (side(a, b, c, tolerance) != 0 || side(a, b, d, tolerance) != 0) return false;
  const double length = glm::length(b - a);
  const Vec2 axis = (b - a) / length;
  const double s = glm::dot(c - a, axis);
  const double t = glm::dot(d - a, axis);
  return std::min(length, std::max(s, t)) - std::max(0.0, std::min(s, t)) > tolerance;
}

/// Whether two loops cross or share a part of an edge; single common points are allowed.
bool loops_cross(const Loop2& p, const Loop2& q, double tolerance) {
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j) {
      const Vec2& a = p[i];
      const Vec2& b = p[(i + 1) % p.size()];
      const Vec2& c = q[j];
      const Vec2& d = q[(j + 1) % q.size()];
      if (cross_properly(a, b, c, d, tolerance) || overlap(a, b, c, d, tolerance)) return true;
    }
  return false;
}

/// Whether a vertex or an edge's middle of `loop` lies on the given side (1 inside, -1 outside) of
/// `other`.
bool any_point(const Loop2& loop, const Loop2& other, int where, double tolerance) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 middle = 0.5 * (loop[k] + loop[(k + 1) % loop.size()]);
    if (locate(loop[k], other, tolerance) == where || locate(middle, other, tolerance) == where)
      return true;
  }
  return false;
}

bool holes_misplaced(const Loop2& outer, const std::vector<Loop2>& holes, double tolerance) {
  for (std::size_t i = 0; i < holes.size(); ++i) {
    if (loops_cross(holes[i], outer, tolerance) || any_point(holes[i], outer, -1, tolerance))
      return true;
    for (std::size_t j = 0; j < i; ++j)
      if (loops_cross(holes[i], holes[j], tolerance) ||
          any_point(holes[i], holes[j], 1, tolerance) ||
          any_point(holes[j], holes[i], 1, tolerance))
        return true;
  }
  return false;
}

}  // namespace

std::string_view name(PolygonStatus status) {
  constexpr std::string_view kNames[] = {
      "ok",
      "invalid_syntax",
      "invalid_nan",
      "invalid_infinite",
      "invalid_too_few_vertices",
      "invalid_repeated_vertex",
      "invalid_zero_area",
      "invalid_non_planar",
      "invalid_self_crossing",
  };
  return kNames[static_cast<int>(status)];
}

PolygonStatus validate(const Polygon& given) {
  if (any_vertex(given, has_nan)) return PolygonStatus::invalid_nan;
  if (any_vertex(given, has_infinity)) return PolygonStatus::invalid_infinite;
  if (any_loop(given, [](const Loop& loop) { return loop.size() < 3; }))
    return PolygonStatus::invalid_too_few_vertices;
  if (any_loop(given, repeats_vertex)) return PolygonStatus::invalid_repeated_vertex;

  // A power of two changes no digit, and keeps the squares and products below from over- and
  // underflow.
  const double largest = coordinate_rounding(given);
  const double scale = largest > 0 ? std::ldexp(1.0, std::min(-std::ilogb(largest) - 50, 1000)) : 1;
  Polygon polygon = given;
  for (Vec3& x : polygon.outer) x *= scale;
  for (Loop& hole : polygon.holes)
    for (Vec3& x : hole) x *= scale;
  const double tolerance = coordinate_rounding(polygon);

  if (any_loop(polygon, [&](const Loop& l) { return !(WidestTriangle(l).width > tolerance); }))
    return PolygonStatus::invalid_zero_area;
  const WidestTriangle widest(polygon.outer);
  const Moments m = moments({polygon.outer, {}});
  const double size = box_diagonal(polygon.outer);
  const bool no_area = !(m.area > 4 * tolerance * size);
  // The signed areas of a crossed loop may cancel until their normal is rounding alone.
  const bool area_cancels = !(m.area > 1e-3 * widest.width * size);
  const Vec3 normal = area_cancels ? widest.normal : m.normal;
  const Vec3 point = area_cancels ? polygon.outer[0] : m.centroid;
  const bool planar = !any_vertex(polygon, [&](const Vec3& x) {
    return std::abs(glm::dot(normal, x - point)) > kPlanarity * size + tolerance;
  });
  const Projection flatten(normal);
  const Loop2 outer = flatten(polygon.outer);
  // No area on balance: a figure of eight has two that cancel, a path out and back has none.
  if (no_area && planar && !crosses_itself_properly(outer, tolerance))
    return PolygonStatus::invalid_zero_area;
  if (!planar) return PolygonStatus::invalid_non_planar;

  std::vector<Loop2> holes;
  for (const Loop& hole : polygon.holes) holes.push_back(flatten(hole));
  if (touches_itself(outer, tolerance)) return PolygonStatus::invalid_self_crossing;
  for (const Loop2& hole : holes)
    if (touches_itself(hole, tolerance)) return PolygonStatus::invalid_self_crossing;
  return holes_misplaced(outer, holes, tolerance) ? PolygonStatus::invalid_self_crossing
                                                  : PolygonStatus::ok;
}

PolygonStatus validate(const Polygon& p, const Polygon& q) {
  const PolygonStatus status = validate(p);
  return status == PolygonStatus::ok ? validate(q) : status;
}

}  // namespace host
