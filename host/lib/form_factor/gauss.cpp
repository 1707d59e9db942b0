#include "form_factor/gauss.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

#include "form_factor/area_rule.hpp"
#include "form_factor/facing.hpp"
#include "geometry/order.hpp"

namespace host {

double gauss_exchange(const Polygon& given_p, const Polygon& given_q, int n) {
  gauss_rule(n);  // a wrong n is an error for every pair, also for one that cannot see each other
  const Polygon p = standard_order(given_p);
  const Polygon q = standard_order(given_q);
  if (clip_to_front(p, q).empty()) return 0;
  const Moments mp = moments(p);
  const Moments mq = moments(q);
  const std::vector<AreaPoint> q_points = area_points(q, n, mp.centroid, mp.normal);
  double sum = 0;
  for (const AreaPoint& x : area_points(p, n, mq.centroid, mq.normal))
    for (const AreaPoint& y : q_points) {
      const Vec3 r = y.x - x.x;
      const double r2 = glm::dot(r, r);
      const double heights = glm::dot(mp.normal, r) * -glm::dot(mq.normal, r);
      if (r2 > 0) sum += std::max(0.0, heights) * (x.area / r2) * (y.area / r2);
    }
  return std::min({sum * std::numbers::inv_pi, mp.area, mq.area});
}

Estimate gauss_estimate(const Polygon& p, const Polygon& q, int n) {
  const double exchange = gauss_exchange(p, q, n);
  return {exchange > 0 ? std::min(1.0, exchange / moments(standard_order(p)).area) : 0.0};
}

}  // namespace host
