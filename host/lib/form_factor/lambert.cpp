#include "form_factor/lambert.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "form_factor/area_rule.hpp"
#include "form_factor/facing.hpp"
#include "geometry/order.hpp"

namespace host {
namespace {

/// Lambert's sum over one loop. The vertices run clockwise as seen from x, because the lit side
/// looks at it.
double loop_sum(const Vec3& x, const Vec3& n, const Loop& loop) {
  double sum = 0;
  Vec3 a = loop.back() - x;
  for (const Vec3& vertex : loop) {
    const Vec3 b = vertex - x;
    const Vec3 cross = glm::cross(b, a);
    const double area = glm::length(cross);
    // An edge seen end-on spans no angle; x on the edge has no direction across it, and no light
    // along it either.
    if (area > 0) sum += glm::dot(n, cross) / area * std::atan2(area, glm::dot(a, b));
    a = b;
  }
  return sum;
}

double point_sum(const Vec3& x, const Vec3& n, const std::vector<Loop>& loops) {
  double sum = 0;
  for (const Loop& loop : loops) sum += loop_sum(x, n, loop);
  return std::clamp(0.5 * std::numbers::inv_pi * sum, 0.0, 1.0);
}

}  // namespace

double point_form_factor(const Vec3& x, const Vec3& n, const Polygon& polygon) {
  const Moments m = moments(polygon);
  if (m.area <= 0 || glm::dot(m.normal, x - m.centroid) <= 0) return 0;
  const Polygon above = clip(polygon, x, n);
  return above.outer.empty() ? 0 : point_sum(x, n, boundary(above));
}

double lambert_exchange(const Polygon& given_p, const Polygon& given_q, int n) {
  gauss_rule(n);  // a wrong n is an error for every pair, also for one that cannot see each other
  const Polygon p = standard_order(given_p);
  const Polygon q = standard_order(given_q);
  const FacingPair pair = clip_to_front(p, q);
  if (pair.empty()) return 0;
  const Moments mp = moments(p);
  const Moments mq = moments(q);
  const std::vector<Loop> loops = boundary(pair.q);
  double sum = 0;
  for (const AreaPoint& point : area_points(p, n, mq.centroid, mq.normal))
    sum += point.area * point_sum(point.x, mp.normal, loops);
  return sum;
}

Estimate lambert_estimate(const Polygon& p, const Polygon& q, int n) {
  const double exchange = lambert_exchange(p, q, n);
  return {exchange > 0 ? std::min(1.0, exchange / moments(standard_order(p)).area) : 0.0};
}

}  // namespace host
