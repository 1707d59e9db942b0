#include "geometry/distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/planar.hpp"

namespace host {
namespace {

double to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0 ? std::clamp(glm::dot(x - a, ab) / length2, 0.0, 1.0) : 0.0;
  return glm::length(x - a - t * ab);
}

double between_segments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double ends = std::min(
      {to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
  const Vec3 e = b - a;
  const Vec3 f = d - c;
  const Vec3 across = glm::cross(e, f);
  const double across2 = glm::dot(across, across);
  const double s = glm::dot(glm::cross(c - a, f), across);
  const double t = glm::dot(glm::cross(c - a, e), across);
  const bool inside = across2 > 0 && s >= 0 && s <= across2 && t >= 0 && t <= across2;
  return inside ? std::min(ends, std::abs(glm::dot(c - a, across)) / std::sqrt(across2)) : ends;
}

/// The least height of corners of `corners` straight over the inside of `plate`.
double over_inside(const Loop& corners, const Polygon& plate) {
  const Moments m = moments(plate);
  const Projection flat(m.normal);
  const Loop2 outline = flat(plate.outer);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& x : corners) {
    const double height = glm::dot(m.normal, x - m.centroid);
    if (locate(flat(x - height * m.normal), outline, 0) >= 0)
      least = std::min(least, std::abs(height));
  }
  return least;
}

}  // namespace

double distance(const Polygon& p, const Polygon& q) {
  double least = std::min(over_inside(p.outer, q), over_inside(q.outer, p));
  for (std::size_t i = 0; i < p.outer.size(); ++i)
    for (std::size_t j = 0; j < q.outer.size(); ++j)
      least = std::min(least, between_segments(p.outer[i], p.outer[(i + 1) % p.outer.size()],
                                               q.outer[j], q.outer[(j + 1) % q.outer.size()]));
  return least;
}

}  // namespace host
