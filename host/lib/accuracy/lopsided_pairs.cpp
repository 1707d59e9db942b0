#include "accuracy/lopsided_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "network/random_direction.hpp"

namespace host {

namespace {

/// Corners at random angles and radii about the centre; of a symmetric one every other corner is
/// opposite an earlier one.
Polygon shape(const PatchKind& kind, double size, const Vec3& centre, Random& random) {
  const glm::dmat3 axes = random_rotation(random);
  const double stretch = random.log_uniform(0.3, 1);
  Polygon polygon;
  for (int k = 0; k < kind.corners; ++k) {
    if (kind.symmetric && k >= kind.corners / 2) {
      const Vec3 opposite = polygon.outer[std::size_t(k - kind.corners / 2)];
      polygon.outer.push_back(2.0 * centre - opposite);
      continue;
    }
    const double angle = 2 * std::numbers::pi * (k + random.uniform(-0.3, 0.3)) / kind.corners;
    const double radius = size * (k == 0 ? random.uniform(kind.least_radius, kind.most_radius)
                                         : random.uniform(0.5, 1));
    polygon.outer.push_back(
        centre + radius * (std::cos(angle) * axes[0] + stretch * std::sin(angle) * axes[1]));
  }
  return polygon;
}

}  // namespace

double squared_size(const Moments& moments) {
  return moments.second[0][0] + moments.second[1][1] + moments.second[2][2];
}

bool wholly_in_front(const Polygon& polygon, const Moments& plane) {
  return std::all_of(polygon.outer.begin(), polygon.outer.end(),
                     [&](const Vec3& x) { return glm::dot(plane.normal, x - plane.centroid) > 0; });
}

PolygonPair draw_pair(const PatchKind& kind, double least_rho, double most_rho, Random& random) {
  for (;;) {
    const double size =
        random.log_uniform(0.5, 3) * std::sqrt(random.log_uniform(least_rho, most_rho));
    const Polygon p = shape(kind, size, Vec3(0), random);
    const double other_size = size * random.log_uniform(0.2, 1);
    const Vec3 centre = random_direction(random);
    const Polygon q = shape(kind, other_size, centre, random);
    const Moments i = moments(p), j = moments(q);
    const Vec3 r = j.centroid - i.centroid;
    const double rho = (squared_size(i) + squared_size(j)) / glm::dot(r, r);
    if (rho < least_rho || rho >= most_rho || !wholly_in_front(q, i) || !wholly_in_front(p, j))
      continue;
    return {p, q};
  }
}

}  // namespace host
