// A second opinion on form factors: contour integral in long double, outer edges bisected until two
// rules agree. It shares neither code, precision nor the choice of nodes with the reference;
// touching and slivers only make it slow.
#pragma once
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/polygon.hpp"

namespace slow {

using Real = long double;
using Vector = glm::vec<3, Real>;

/// int over the segment a b of ln |x - y| dy.
inline Real log_integral(const Vector& x, const Vector& a, const Vector& b) {
  const Real length = glm::length(b - a);
  const Vector direction = (b - a) / length;
  const Real u = glm::dot(x - a, direction);
  const Real v = length - u;
  const Real h = glm::length(glm::cross(x - a, direction));
  const Real a2 = u * u + h * h;
  const Real b2 = v * v + h * h;
  return (a2 > 0 ? u * std::log(a2) / 2 : 0) + (b2 > 0 ? v * std::log(b2) / 2 : 0) +
         h * std::atan2(h * length, h * h - u * v) - length;
}

template <class Function>
Real bisected(const Function& f, Real low, Real high, Real whole, Real tolerance, int depth) {
  using Rule = boost::math::quadrature::gauss<Real, 15>;
  const Real middle = (low + high) / 2;
  const Real left = Rule::integrate(f, low, middle);
  const Real right = Rule::integrate(f, middle, high);
  if (depth == 0 || std::abs(left + right - whole) < tolerance) return left + right;
  return bisected(f, low, middle, left, tolerance, depth - 1) +
         bisected(f, middle, high, right, tolerance, depth - 1);
}

/// A_p F_pq of two polygons without holes, each wholly in front of the other, of about unit size.
inline double exchange(const host::Polygon& p, const host::Polygon& q) {
  const auto corner = [](const host::Loop& loop, std::size_t k) {
    return Vector(loop[k % loop.size()]);
  };
  Real sum = 0;
  for (std::size_t i = 0; i < p.outer.size(); ++i) {
    const Vector start = corner(p.outer, i);
    const Vector edge = corner(p.outer, i + 1) - start;
    const Real length = glm::length(edge);
    if (!(length > 0)) continue;
    const Vector direction = edge / length;
    const auto integrand = [&](Real t) {
      Real total = 0;
      for (std::size_t j = 0; j < q.outer.size(); ++j) {
        const Vector a = corner(q.outer, j);
        const Vector b = corner(q.outer, j + 1);
        if (a != b)
          total += glm::dot(direction, b - a) / glm::length(b - a) *
                   log_integral(start + t * direction, a, b);
      }
      return total;
    };
    std::vector<Real> cuts = {0, length};
    for (const host::Vec3& x : q.outer)
      cuts.push_back(std::clamp<Real>(glm::dot(Vector(x) - start, direction), 0, length));
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
      if (cuts[k] < cuts[k + 1])
        sum += bisected(integrand, cuts[k], cuts[k + 1], Real(1e9), Real(1e-17), 32);
  }
  return static_cast<double>(sum / (2 * std::numbers::pi_v<Real>));
}

}  // namespace slow
