#include "form_factor/facing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace host {
namespace {

double largest_coordinate(const Polygon& polygon) {
  double largest = 0;
  for (const Vec3& x : polygon.outer)
    largest = std::max({largest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  return largest;
}

struct Reach {
  double distance = 0;  // of the furthest vertex from the plane's centroid
  double height = 0;    // of the furthest vertex from the plane, either side
};

Reach reach(const Moments& plane, const Polygon& polygon) {
  Reach result;
  for (const Vec3& x : polygon.outer) {
    const Vec3 r = x - plane.centroid;
    result.distance = std::max(result.distance, glm::length(r));
    result.height = std::max(result.height, std::abs(glm::dot(plane.normal, r)));
  }
  return result;
}

/// How far rounded coordinates of size `coordinate` leave the plane of a polygon undetermined at
/// `distance` from its centroid: the rounding itself, and its lever over the polygon's width.
double plane_rounding(const Moments& m, double coordinate, double distance) {
  const double trace = m.second[0][0] + m.second[1][1] + m.second[2][2];
  const double width = m.area / std::sqrt(12 * trace);
  return 4 * std::numeric_limits<double>::epsilon() * coordinate * (1 + distance / width);
}

bool planes_agree(const Polygon& p, const Moments& mp, const Polygon& q, const Moments& mq) {
  const double coordinate = std::max(largest_coordinate(p), largest_coordinate(q));
  const Reach q_from_p = reach(mp, q);
  const Reach p_from_q = reach(mq, p);
  return q_from_p.height <= plane_rounding(mp, coordinate, q_from_p.distance) &&
         p_from_q.height <= plane_rounding(mq, coordinate, p_from_q.distance);
}

}  // namespace

FacingPair clip_to_front(const Polygon& p, const Polygon& q) {
  const Moments mp = moments(p);
  const Moments mq = moments(q);
  if (mp.area <= 0 || mq.area <= 0 || planes_agree(p, mp, q, mq)) return {};
  FacingPair pair{clip(p, plane_of(q)), clip(q, plane_of(p))};
  if (pair.empty()) return {};
  return pair;
}

}  // namespace host
