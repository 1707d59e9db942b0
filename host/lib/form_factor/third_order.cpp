#include "form_factor/third_order.hpp"

#include <cmath>

#include "geometry/planar.hpp"

namespace host {
namespace {

using Cubic = std::array<double, 4>;

/// The symmetric product of three vectors.
Cubic product(const Vec2& a, const Vec2& b, const Vec2& c) {
  return {a.x * b.x * c.x, (a.x * b.x * c.y + a.x * b.y * c.x + a.y * b.x * c.x) / 3,
          (a.x * b.y * c.y + a.y * b.x * c.y + a.y * b.y * c.x) / 3, a.y * b.y * c.y};
}

/// R^3 times the part of T3 that belongs to one patch.
double third_of(const ThirdMoments& third, const Vec3& w, const Vec3& m) {
  const auto& [t000, t001, t011, t111] = third.value;
  const Vec2 along(glm::dot(third.axis[0], w), glm::dot(third.axis[1], w));
  const Vec2 slope = Vec2(glm::dot(third.axis[0], m), glm::dot(third.axis[1], m)) / glm::dot(m, w);
  const double xx = along.x * along.x, xy = 2 * along.x * along.y, yy = along.y * along.y;
  const Vec2 twice(t000 * xx + t001 * xy + t011 * yy, t001 * xx + t011 * xy + t111 * yy);
  const Vec2 trace(t000 + t011, t001 + t111);
  return glm::dot(32.0 * twice - 12.0 * trace, along) - glm::dot(12.0 * twice - 2.0 * trace, slope);
}

}  // namespace

ThirdMoments third_moments(const Polygon& polygon, const Moments& moments) {
  ThirdMoments third;
  const Vec3& n = moments.normal;
  const Vec3 beside = std::fabs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  third.axis[0] = glm::normalize(glm::cross(beside, n));
  third.axis[1] = glm::cross(n, third.axis[0]);
  const auto flat = [&](const Vec3& x) {
    const Vec3 u = x - moments.centroid;
    return Vec2(glm::dot(third.axis[0], u), glm::dot(third.axis[1], u));
  };
  for (const Loop& loop : boundary(polygon))
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 a = flat(loop[k]), b = flat(loop[(k + 1) % loop.size()]);
      // A signed triangle with a corner at the centroid [integral of a^p b^q over barycentric
      // coordinates: 2 A p! q! / (p + q + 2)!].
      const double share = 0.5 * orientation({0, 0}, a, b) / (10 * moments.area);
      const Cubic parts[] = {product(a, a, a), product(a, a, b), product(a, b, b),
                             product(b, b, b)};
      for (const Cubic& part : parts)
        for (std::size_t c = 0; c < part.size(); ++c) third.value[c] += share * part[c];
    }
  return third;
}

double third_order(const Moments& i, const ThirdMoments& third_i, const Moments& j,
                   const ThirdMoments& third_j) {
  const Vec3 r = j.centroid - i.centroid;
  const double distance = glm::length(r);
  const Vec3 w = r / distance;
  return (third_of(third_i, w, j.normal) + third_of(third_j, -w, i.normal)) /
         (distance * distance * distance);
}

}  // namespace host
