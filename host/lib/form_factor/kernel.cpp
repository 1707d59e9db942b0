#include "form_factor/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "form_factor/facing.hpp"
#include "geometry/order.hpp"

namespace host {
namespace {

/// The part of T2 that belongs to one patch, seen along the unit vector u at squared distance `r2`,
/// with `cosine` the other patch's normal times u. A mirrored u changes nothing.
double second_order(const Moments& patch, const Vec3& other_normal, const Vec3& u, double r2,
                    double cosine) {
  const Vec3 mu = patch.second * u;
  const double trace = patch.second[0][0] + patch.second[1][1] + patch.second[2][2];
  return (-2 * trace + 12 * glm::dot(u, mu) - 4 * glm::dot(other_normal, mu) / cosine) / r2;
}

using Kernel = double (*)(const Moments&, const Moments&);

double clipped_exchange(const Polygon& p, const Polygon& q, Kernel kernel) {
  const FacingPair pair = clip_to_front(standard_order(p), standard_order(q));
  if (pair.empty()) return 0;
  const Moments i = moments(pair.p);
  const Moments j = moments(pair.q);
  return std::min({kernel(i, j), i.area, j.area});
}

double form_factor(const Polygon& p, double exchange) {
  return exchange > 0 ? std::min(1.0, exchange / moments(standard_order(p)).area) : 0.0;
}

}  // namespace

double centre_kernel(const Moments& i, const Moments& j) {
  const Vec3 r = j.centroid - i.centroid;
  const double p = glm::dot(i.normal, r);
  const double q = -glm::dot(j.normal, r);
  if (!(p > 0 && q > 0)) return 0;
  const double r2 = glm::dot(r, r);
  return (i.area / r2) * j.area * (p / r2) * q * std::numbers::inv_pi;
}

double second_order(const Moments& i, const Moments& j) {
  const Vec3 r = j.centroid - i.centroid;
  const double r2 = glm::dot(r, r);
  const Vec3 u = r / std::sqrt(r2);
  return second_order(i, j.normal, u, r2, glm::dot(j.normal, u)) +
         second_order(j, i.normal, u, r2, glm::dot(i.normal, u));
}

double bent_kernel(const Moments& i, const Moments& j, double terms) {
  return centre_kernel(i, j) * std::exp(terms / std::hypot(1.0, terms / 1.5));
}

double moment_kernel(const Moments& i, const Moments& j) {
  return centre_kernel(i, j) > 0 ? bent_kernel(i, j, second_order(i, j)) : 0;
}

double centre_kernel_exchange(const Polygon& p, const Polygon& q) {
  return clipped_exchange(p, q, centre_kernel);
}

double moment_kernel_exchange(const Polygon& p, const Polygon& q) {
  return clipped_exchange(p, q, moment_kernel);
}

Estimate centre_kernel_estimate(const Polygon& p, const Polygon& q) {
  return {form_factor(p, centre_kernel_exchange(p, q))};
}

Estimate moment_kernel_estimate(const Polygon& p, const Polygon& q) {
  return {form_factor(p, moment_kernel_exchange(p, q))};
}

}  // namespace host
