#include "form_factor/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "form_factor/area_rule.hpp"
#include "form_factor/edge_pair.hpp"
#include "form_factor/facing.hpp"
#include "form_factor/gauss.hpp"
#include "form_factor/lambert.hpp"
#include "geometry/distance.hpp"
#include "geometry/order.hpp"

namespace host {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

constexpr double kDoubtful = 1e-10;  // relative error from which a second opinion is worth its time

struct Exchange {
  double value = 0;
  double error = 0;  // absolute
};

/// A clipped polygon, ready for both rules: loops relative to a common origin, holes against the
/// outer loop.
struct Side {
  Moments m;
  std::vector<Loop> loops;
  double radius = 0;  // about the centroid

  Side(const Polygon& polygon, const Vec3& origin) : m(moments(polygon)), loops(boundary(polygon)) {
    m.centroid -= origin;
    for (Loop& loop : loops)
      for (Vec3& x : loop) {
        x -= origin;
        radius = std::max(radius, glm::length(x - m.centroid));
      }
  }

  bool is_sliver() const { return m.area < 1e-3 * radius * radius; }

  std::vector<Edge> edges() const {
    std::vector<Edge> result;
    for (const Loop& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec3 d = loop[(k + 1) % loop.size()] - loop[k];
        const double length = glm::length(d);
        if (length > 0) result.push_back({loop[k], d / length, length});
      }
    return result;
  }
};

Exchange contour_exchange(const Side& p, const Side& q) {
  const std::vector<Edge> p_edges = p.edges();
  const std::vector<Edge> q_edges = q.edges();
  const double unit = std::hypot(glm::length(q.m.centroid - p.m.centroid), p.radius, q.radius);
  const double negligible = 1e-3 * kEpsilon * kEpsilon * p.radius * q.radius;
  double sum = 0;
  double rounding = 0;
  for (const Edge& e : p_edges)
    for (const Edge& f : q_edges) {
      const Vec3 products = e.direction * f.direction;
      const double cosine = products.x + products.y + products.z;
      // What rounding leaves of a cosine: little where the axes are those of the edges, however
      // small the cosine, so that slivers along two axes keep theirs.
      const double noise =
          kEpsilon * (std::abs(products.x) + std::abs(products.y) + std::abs(products.z));
      const double lengths = e.length * f.length;
      rounding += noise * lengths;
      if (std::abs(cosine) <= noise || lengths <= negligible) continue;
      const double term = cosine * log_distance_integral(e, f, unit);
      sum += term;
      rounding += kEpsilon * (std::abs(term) + std::abs(cosine) * lengths);
    }
  constexpr double kScale = 0.5 * std::numbers::inv_pi;
  return {kScale * sum, 4 * kScale * rounding};
}

/// Points of a fan of quadrilaterals with signed areas. They may lie outside a concave polygon;
/// from afar the kernel is as smooth there, and the signs make up for it.
void add_fan(const Loop& v, const Vec3& normal, std::span<const GaussPoint> rule,
             std::vector<AreaPoint>* points) {
  for (std::size_t k = 1; k + 1 < v.size(); k += 2) {
    const Vec3& a = v[0];
    const Vec3& b = v[k];
    const Vec3& c = v[k + 1];
    const Vec3& d = v[std::min(k + 2, v.size() - 1)];
    const bool triangle = k + 2 >= v.size();
    for (const GaussPoint& gs : rule)
      for (const GaussPoint& gt : rule) {
        const double s = 0.5 * (1 + gs.x);
        const double t = 0.5 * (1 + gt.x);
        const Vec3 du = triangle ? (b - a) + t * (c - b) : (1 - t) * (b - a) + t * (c - d);
        const Vec3 dv = triangle ? s * (c - b) : (1 - s) * (d - a) + s * (c - b);
        const Vec3 x = triangle ? a + s * du : a + s * (b - a) + t * dv;
        points->push_back({x, 0.25 * gs.weight * gt.weight * glm::dot(normal, glm::cross(du, dv))});
      }
  }
}

/// Points along one direction for 1e-16 when the other polygon stays `distance` away from a patch
/// of this radius.
int far_points(double radius, double distance) {
  const double x = distance / radius;
  return static_cast<int>(std::ceil(18.5 / std::log(x + std::sqrt(1 + x * x))));
}

/// Far pairs: the kernel itself over both areas, in which nothing cancels. False when the contour
/// is cheaper.
bool far_exchange(const Side& p, const Side& q, Exchange* result) {
  const double gap = glm::length(q.m.centroid - p.m.centroid) - p.radius - q.radius;
  if (!(gap > 2 * std::max(p.radius, q.radius))) return false;
  const int np = far_points(p.radius, gap);
  const int nq = far_points(q.radius, gap);
  const auto size = [](const Side& side, int n) {
    std::size_t quads = 0;
    for (const Loop& loop : side.loops) quads += (loop.size() - 1) / 2;
    return quads * static_cast<std::size_t>(n * n);
  };
  constexpr std::size_t kMostEvaluations = 1000;
  if (size(p, np) * size(q, nq) > kMostEvaluations) return false;
  std::vector<AreaPoint> p_points;
  std::vector<AreaPoint> q_points;
  for (const Loop& loop : p.loops) add_fan(loop, p.m.normal, gauss_rule(np), &p_points);
  for (const Loop& loop : q.loops) add_fan(loop, q.m.normal, gauss_rule(nq), &q_points);
  double sum = 0;
  for (const AreaPoint& x : p_points) {
    double inner = 0;
    for (const AreaPoint& y : q_points) {
      const Vec3 r = y.x - x.x;
      const double r2 = glm::dot(r, r);
      inner += y.area * glm::dot(p.m.normal, r) * glm::dot(q.m.normal, r) / (r2 * r2);
    }
    sum -= x.area * inner;
  }
  // The heights over the two planes are differences of coordinates of the size of the distance.
  const Vec3 r = q.m.centroid - p.m.centroid;
  const double heights =
      std::abs(glm::dot(p.m.normal, r)) + std::abs(glm::dot(q.m.normal, r)) + p.radius + q.radius;
  const double rounding = p.m.area * q.m.area * heights / (gap * gap * gap);
  *result = {sum * std::numbers::inv_pi, 4 * kEpsilon * rounding};
  return true;
}

/// Relative error of a rule of n points over a patch of this radius, `gap` away from what it looks
/// at, where the integrand stays analytic [Trefethen 2008].
double rule_error(int n, double radius, double gap) {
  const double x = gap / radius;
  return std::pow(x + std::sqrt(1 + x * x), -2 * n);
}

/// The finer of two rules. Their difference alone proves nothing: near each other, both may miss the
/// same narrow peak.
Exchange by_difference(double coarse, double fine, double from_afar, double rounding) {
  const double difference = std::abs(fine - coarse);
  if (!(difference <= 1e-6 * fine)) return {fine, std::numeric_limits<double>::infinity()};
  return {fine, std::max(10 * difference, from_afar * fine) + rounding};
}

/// Exact point-to-polygon sums at points of the smaller polygon.
Exchange point_exchange(const Polygon& p, const Polygon& q, const Side& p_side, const Side& q_side,
                        double gap) {
  constexpr int kPoints = 20;
  const bool p_smaller = p_side.m.area <= q_side.m.area;
  const Polygon& smaller = p_smaller ? p : q;
  const Polygon& larger = p_smaller ? q : p;
  const Side& side = p_smaller ? p_side : q_side;
  return by_difference(lambert_exchange(smaller, larger, 12),
                       lambert_exchange(smaller, larger, kPoints),
                       rule_error(kPoints, side.radius, gap), 8 * kEpsilon * side.m.area);
}

/// Two slivers: no sums over edges at all.
Exchange area_exchange(const Polygon& p, const Polygon& q, const Side& p_side, const Side& q_side,
                       double gap) {
  constexpr int kPoints = 12;
  const double fine = gauss_exchange(p, q, kPoints);
  return by_difference(gauss_exchange(p, q, 8), fine,
                       rule_error(kPoints, std::max(p_side.radius, q_side.radius), gap),
                       64 * kEpsilon * fine);
}

Exchange in_bounds(const Exchange& exchange, double most) {
  return {std::clamp(exchange.value, 0.0, most), exchange.error};
}

Exchange exchange(const Polygon& given_p, const Polygon& given_q) {
  Polygon first = standard_order(given_p);
  Polygon second = standard_order(given_q);
  if (written_before(second, first)) std::swap(first, second);
  const FacingPair pair = clip_to_front(first, second);
  if (pair.empty()) return {};
  const Vec3 origin = pair.p.outer[0];
  const Side p(pair.p, origin);
  const Side q(pair.q, origin);
  const double most = std::min(p.m.area, q.m.area);
  if (!(most > 0)) return {};
  Exchange result;
  if (!far_exchange(p, q, &result)) result = contour_exchange(p, q);
  const auto doubtful = [&] { return result.error > kDoubtful * result.value; };
  // Where sums over edges lose digits: the two long edges of a sliver cancel, and so do the edges
  // of a huge polygon as a tiny one sees them.
  constexpr double kUneven = 1e4, kLost = 1e-6;
  const bool sliver = p.is_sliver() || q.is_sliver();
  const bool lost = std::max(p.m.area, q.m.area) > kUneven * most &&
                    result.error > kLost * std::max(result.value, 0.0);
  if (!(sliver || lost) || !doubtful()) return in_bounds(result, most);
  const double gap = distance(pair.p, pair.q);
  for (const auto second_opinion : {point_exchange, area_exchange}) {
    if (!doubtful()) break;
    const Exchange other = second_opinion(first, second, p, q, gap);
    const bool met = other.error < std::numeric_limits<double>::infinity();
    if (other.error < result.error)
      result = other;
    else if (met && std::abs(other.value - result.value) <= result.error)
      result = {other.value, 2 * result.error};  // mostly the better one, but nothing proves it
  }
  return in_bounds(result, most);
}

}  // namespace

double reference_exchange(const Polygon& p, const Polygon& q) { return exchange(p, q).value; }

Estimate reference_estimate(const Polygon& p, const Polygon& q) {
  const double area = moments(standard_order(p)).area;
  if (!(area > 0)) return {0, 0};
  const Exchange g = exchange(p, q);
  const double none = g.error > 0 ? 1.0 : 0.0;
  return {std::min(1.0, g.value / area), g.value > 0 ? std::min(1.0, g.error / g.value) : none};
}

double reference_form_factor(const Polygon& p, const Polygon& q) {
  return reference_estimate(p, q).f;
}

}  // namespace host
