#include "form_factor/contour_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "form_factor/area_rule.hpp"
#include "form_factor/facing.hpp"

namespace host {
namespace {

struct ContourPoint {
  Vec3 x, step;  ///< place; direction times length times weight
};

void add_loop(const Loop& loop, std::span<const GaussPoint> rule,
              std::vector<ContourPoint>* points) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 from = loop[k], along = loop[(k + 1) % loop.size()] - from;
    for (const GaussPoint& g : rule)
      points->push_back({from + 0.5 * (1 + g.x) * along, 0.5 * g.weight * along});
  }
}

std::vector<ContourPoint> contour_points(const Polygon& polygon, int n) {
  std::vector<ContourPoint> points;
  for (const Loop& loop : boundary(polygon)) add_loop(loop, gauss_rule(n), &points);
  return points;
}

}  // namespace

Estimate contour_estimate(const Polygon& p, const Polygon& q, int n) {
  const FacingPair facing = clip_to_front(p, q);
  if (facing.empty()) return {};
  const std::vector<ContourPoint> to = contour_points(facing.q, n);
  double sum = 0;
  for (const ContourPoint& a : contour_points(facing.p, n))
    for (const ContourPoint& b : to) {
      const Vec3 r = b.x - a.x;
      sum += 0.5 * std::log(glm::dot(r, r)) * glm::dot(a.step, b.step);
    }
  const double f = sum / (2 * std::numbers::pi * moments(p).area);
  // Points that coincide on a shared edge have no logarithm; a rule may also pass what is possible.
  return {std::isfinite(f) ? std::clamp(f, 0.0, 1.0) : std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace host
