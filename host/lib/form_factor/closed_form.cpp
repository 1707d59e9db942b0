#include "form_factor/closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "form_factor/edge_pair_closed.hpp"
#include "form_factor/facing.hpp"
#include "geometry/order.hpp"

namespace host {
namespace {

constexpr double kWorthMore = 1e-2 * kClosedFormTolerance;  // of error: long double's time

/// Where the coordinates of a pair begin, and their unit: the reach of both polygons.
struct Frame {
  Vec3 origin;
  double unit = 0;

  explicit Frame(const FacingPair& pair) : origin(pair.p.outer[0]) {
    for (const Polygon* polygon : {&pair.p, &pair.q})
      for (const Vec3& x : polygon->outer) unit = std::max(unit, glm::length(x - origin));
  }
};

template <class Real>
std::vector<ClosedEdge<Real>> edges(const Polygon& polygon, const Frame& frame) {
  using Vector = glm::vec<3, Real>;
  const auto in_frame = [&](const Vec3& x) {
    return (Vector(x) - Vector(frame.origin)) / static_cast<Real>(frame.unit);
  };
  std::vector<ClosedEdge<Real>> result;
  for (const Loop& loop : boundary(polygon)) {
    Vector start = in_frame(loop.back());
    for (const Vec3& x : loop) {
      const Vector end = in_frame(x);
      const Real length = glm::length(end - start);
      if (length > 0) result.push_back({{start, end}, (end - start) / length, length});
      start = end;
    }
  }
  return result;
}

template <class Real>
ClosedEdge<Real> turned(const ClosedEdge<Real>& edge) {
  return {{edge.ends[1], edge.ends[0]}, -edge.direction, edge.length};
}

/// A_p F_pq of a clipped pair, in squares of the frame's unit.
template <class Real>
Bounded<double> exchange(const FacingPair& pair, const Frame& frame) {
  constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();
  const std::vector<ClosedEdge<Real>> q_edges = edges<Real>(pair.q, frame);
  Bounded<Real> sum;
  for (const ClosedEdge<Real>& e : edges<Real>(pair.p, frame))
    for (const ClosedEdge<Real>& f : q_edges) {
      const Real cosine = glm::dot(e.direction, f.direction);
      sum.error += 4 * kEpsilon;  // of the cosine, times an integral that is below 2 here
      if (std::abs(cosine) <= kEpsilon) continue;
      const Bounded<Real> term = closed_log_integral(e, cosine < 0 ? turned(f) : f);
      sum.value += cosine * term.value;
      sum.error += std::abs(cosine) * term.error;
    }
  constexpr Real kScale = std::numbers::inv_pi_v<Real> / 2;
  return {static_cast<double>(kScale * sum.value), static_cast<double>(kScale * sum.error)};
}

/// A clipped polygon, and what clipping may have done to it.
struct Part {
  Moments m;
  double radius = 0;  // about the centroid
  double reach = 0;   // of its coordinates
  bool is_cut = false;
  const Polygon& polygon;

  Part(const Polygon& given, const Polygon& clipped)
      : m(moments(clipped)), is_cut(clipped.outer != given.outer), polygon(clipped) {
    for (const Vec3& x : polygon.outer) {
      radius = std::max(radius, glm::length(x - m.centroid));
      reach = std::max(reach, glm::length(x));
    }
  }

  /// How much of A_p F_pq the rounding of new corners may change: light arrives in a strip along
  /// the edges, and what falls on a line is at most that of 4 radii in full sight of the other.
  double rounding(const Part& other) const {
    if (!is_cut) return 0;
    double length = 0;
    for (const Loop& loop : boundary(polygon)) {
      Vec3 start = loop.back();
      for (const Vec3& end : loop) {
        length += std::min(glm::length(end - start), 4 * other.radius);
        start = end;
      }
    }
    return std::numeric_limits<double>::epsilon() * std::max(reach, other.reach) * length;
  }
};

/// What A_p F_pq cannot exceed: either area, and both with cosines of one at the least distance.
double most_exchange(const Part& p, const Part& q) {
  const double most = std::min(p.m.area, q.m.area);
  const double gap = glm::length(q.m.centroid - p.m.centroid) - p.radius - q.radius;
  if (!(gap > 0)) return most;
  return std::min(most, std::numbers::inv_pi * (p.m.area / gap) * (q.m.area / gap));
}

}  // namespace

ClosedForm closed_form(const Polygon& given_p, const Polygon& given_q) {
  Polygon p = standard_order(given_p), q = standard_order(given_q);
  const double area = moments(p).area, other_area = moments(q).area;
  if (written_before(q, p)) std::swap(p, q);
  const FacingPair pair = clip_to_front(p, q);
  if (pair.empty()) return {};
  const Part p_part(p, pair.p);
  const Part q_part(q, pair.q);
  const double most = most_exchange(p_part, q_part);
  if (!(most > 0)) return {};
  const Frame frame(pair);
  const double per_area = frame.unit * (frame.unit / area);
  const double most_f = std::min(1.0, most / area);
  const double clipping = (p_part.rounding(q_part) + q_part.rounding(p_part)) / area;
  const auto factor = [&](const Bounded<double>& g) {
    return ClosedForm{std::clamp(per_area * g.value, 0.0, most_f),
                      std::min(per_area * g.error + clipping, most_f)};
  };
  // By the smaller of the two, so that both directions come from one exchange.
  const double doubt = frame.unit * (frame.unit / std::min(area, other_area));
  const Bounded<double> quick = exchange<double>(pair, frame);
  return factor(doubt * quick.error <= kWorthMore ? quick : exchange<long double>(pair, frame));
}

}  // namespace host
