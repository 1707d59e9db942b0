// Two lines at distance h, with s and t measured from the feet of their common perpendicular and
// the angle alpha between them, see
//
//   r^2 = s^2 + t^2 - 2 s t cos alpha + h^2 = |s e - t f|^2 + h^2 :
//
// the wanted integral is that of ln(rho^2 + h^2) / (2 sin alpha) over a plane parallelogram, rho
// being the distance from the foot O. Each of its sides makes two right triangles, whose corners
// are O, the foot of O on the side's line, and one of the side's ends. With the legs d (from O to
// the line) and x (along it), phi = atan(x / d) and D^2 = d^2 + h^2, such a triangle has
//
//   2 int ln(rho^2 + h^2) = int over the angle 0..phi of
//                           r^2 (ln r^2 - 1) - h^2 (ln h^2 - 1),  r^2 = D^2 + (d tan)^2
//                   = d x (ln r^2 - 3) + 2 d D atan(x / D) + h^2 J
//   J = int 0..phi ln(1 + (d / h)^2 / cos^2)
//     = 2 phi ln((D + d) / h) + Im [Li2(-w) - Li2(-q w)],  w = exp(2 i phi), q = (h / (D + d))^2 .
//
// The last line expands ln |1 + q w|^2 in powers of w. Its dilogarithms stay in the unit disc, and
// their logarithms need nothing new:
//
//   ln(1 + w) = ln(2 cos phi) + i phi
//   ln(1 + q w) = ln(2 cos phi r / (D + d)) + i (phi - atan(x / D)) .
//
// Over the four corners with their signs, the 3 d x sum to 6 |e| |f| sin alpha.
#include "form_factor/edge_pair_closed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "form_factor/dilogarithm.hpp"

namespace host {
namespace {

template <class Real>
using Vector = glm::vec<3, Real>;

template <class Real>
constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();

/// A sum, and the sum of the sizes of what was added.
template <class Real>
struct Sum {
  Real value = 0;
  Real size = 0;

  void add(Real term) {
    value += term;
    size += std::abs(term);
  }
};

/// The line through a side of the parallelogram.
template <class Real>
struct SideLine {
  Real d;         ///< from O, signed
  Real h;         ///< between the two edges' lines
  Real distance;  ///< D
  Real log_rest;  ///< ln(D + |d|)
  Real log_q;     ///< meaningless for h = 0

  SideLine(Real from_foot, Real height)
      : d(from_foot),
        h(height),
        distance(std::sqrt(d * d + h * h)),
        log_rest(std::log(distance + std::abs(d))),
        log_q(2 * (std::log(h) - log_rest)) {}
};

/// Adds sign (d x ln r^2 + 2 d D atan(x / D) + h^2 J) of a triangle.
template <class Real>
void add_triangle(const SideLine<Real>& side, Real x, Real log_r2, Real sign, Sum<Real>* sum) {
  constexpr Real kPi = std::numbers::pi_v<Real>;
  const Real d = std::abs(side.d);
  const Real d2 = d * d;
  if (!(d2 >= std::numeric_limits<Real>::min())) return;  // nothing, or lost in rounding
  if (side.d < 0) sign = -sign;
  const Real omega = std::atan(x / side.distance);
  sum->add(sign * d * x * log_r2);
  sum->add(2 * sign * d * side.distance * omega);
  const Real h2 = sign * side.h * side.h;
  if (h2 == 0) return;
  const Real phi = std::atan(x / d);
  const Real turn = x < 0 ? 2 * phi + kPi : 2 * phi - kPi;  // of -w
  const Real log_outer = std::numbers::ln2_v<Real> + std::log(d2 / (d2 + x * x)) / 2;
  const Real log_inner = log_outer + log_r2 / 2 - side.log_rest;
  sum->add(-h2 * phi * side.log_q);
  sum->add(h2 * dilogarithm<Real>({0, turn}, {log_outer, phi}).imag());
  sum->add(-h2 * dilogarithm<Real>({side.log_q, turn}, {log_inner, phi - omega}).imag());
}

/// The corners of the parallelogram: from the ends of f to those of e.
template <class Real>
struct Corners {
  std::array<std::array<Vector<Real>, 2>, 2> r;
  std::array<std::array<Real, 2>, 2> log_r2;
  Real reach2 = 0;

  Corners(const ClosedEdge<Real>& e, const ClosedEdge<Real>& f) {
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        r[i][j] = e.ends[i] - f.ends[j];
        const Real r2 = glm::dot(r[i][j], r[i][j]);
        reach2 = std::max(reach2, r2);
        log_r2[i][j] = r2 > 0 ? std::log(r2) : 0;  // always times r or more
      }
  }
};

/// + or - of a corner, in the difference of differences that limits of integration make.
template <class Real>
Real corner_sign(std::size_t i, std::size_t j) {
  return i == j ? Real(1) : Real(-1);
}

template <class Real>
Bounded<Real> skew_integral(const ClosedEdge<Real>& e, const ClosedEdge<Real>& f,
                            const Corners<Real>& corners, const Vector<Real>& cross, Real sine) {
  const Vector<Real> normal = cross / sine;
  const Vector<Real> across_e = glm::cross(normal, e.direction);
  const Vector<Real> across_f = glm::cross(normal, f.direction);
  const Real h = std::abs(glm::dot(corners.r[0][0], normal));
  Sum<Real> sum;
  for (std::size_t k = 0; k < 2; ++k) {
    const SideLine<Real> along_e(-glm::dot(corners.r[0][k], across_e), h);
    const SideLine<Real> along_f(-glm::dot(corners.r[k][0], across_f), h);
    for (std::size_t i = 0; i < 2; ++i) {
      const Real sign = corner_sign<Real>(i, k);
      add_triangle(along_e, glm::dot(corners.r[i][k], e.direction), corners.log_r2[i][k], sign,
                   &sum);
      add_triangle(along_f, -glm::dot(corners.r[k][i], f.direction), corners.log_r2[k][i], sign,
                   &sum);
    }
  }
  return {sum.value / (4 * sine) - Real(1.5) * e.length * f.length,
          kEpsilon<Real> * (4 * sum.size + 16 * corners.reach2) / (4 * sine)};
}

template <class Real>
Vector<Real> across(const Vector<Real>& r, const Vector<Real>& direction) {
  return r - glm::dot(r, direction) * direction;
}

/// The mean length of the vectors between two.
template <class Real>
Real mean_length(const Vector<Real>& from, const Vector<Real>& to) {
  const Vector<Real> middle = (from + to) / Real(2);
  const Vector<Real> step = to - from;
  const Real distance2 = glm::dot(middle, middle);
  const Real distance = std::sqrt(distance2);
  const Real step2 = glm::dot(step, step);
  const Real along = glm::dot(step, middle);
  if (step2 <= Real(1e-4) * distance2)  // else the quotient below loses digits
    return distance2 > 0 ? distance + (step2 - along * along / distance2) / (24 * distance) : 0;
  const Real length = std::sqrt(step2);
  const Vector<Real> direction = step / length;
  const Real h = glm::length(across(middle, direction));
  const auto integral = [h](Real d) {
    const Real slope = h > 0 ? h * h * std::asinh(d / h) : 0;
    return (d * std::hypot(d, h) + slope) / 2;
  };
  return (integral(along / length + length / 2) - integral(along / length - length / 2)) / length;
}

/// Edges along their common bisector: r depends on one difference u of positions, and
/// (u^2 - H^2)/4 ln r^2 + H u atan(u / H) - 3/4 u^2 is the second antiderivative of ln r. What
/// turning both by half the angle neglects is of second order in it. Only H bends sharply, where
/// the turn carries a corner past the other line: there its mean over the turn is taken.
template <class Real>
Bounded<Real> parallel_integral(const ClosedEdge<Real>& e, const ClosedEdge<Real>& f,
                                const Corners<Real>& corners, Real sine) {
  const Vector<Real> direction = glm::normalize(e.direction + f.direction);
  Sum<Real> sum;
  Real turned = 0;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const Vector<Real>& r = corners.r[i][j];
      const Real sign = -corner_sign<Real>(i, j);
      const Real u = glm::dot(r, direction);
      const Real h = glm::length(across(r, direction));
      const Real mean = mean_length(across(r, e.direction), across(r, f.direction));
      const Real log_r2 = corners.log_r2[i][j];
      sum.add(sign * (u * u - h * h) * log_r2 / 4);
      sum.add(sign * mean * u * std::atan2(u, h));
      sum.add(-sign * Real(0.75) * u * u);
      turned += sine * sine * (u * u + h * h) * (1 + std::abs(log_r2));
    }
  return {sum.value, kEpsilon<Real> * (4 * sum.size + 16 * corners.reach2) + turned};
}

}  // namespace

template <class Real>
Bounded<Real> closed_log_integral(const ClosedEdge<Real>& e, const ClosedEdge<Real>& f) {
  constexpr Real kSmallSine = Real(1e-3);  // from here on both ways may be the better one
  const Corners<Real> corners(e, f);
  const Vector<Real> cross = glm::cross(e.direction, f.direction);
  const Real sine = glm::length(cross);
  if (sine >= kSmallSine) return skew_integral(e, f, corners, cross, sine);
  const Bounded<Real> parallel = parallel_integral(e, f, corners, sine);
  if (parallel.error <= kEpsilon<Real> * corners.reach2 / sine) return parallel;
  const Bounded<Real> skew = skew_integral(e, f, corners, cross, sine);
  return parallel.error <= skew.error ? parallel : skew;
}

template Bounded<double> closed_log_integral(const ClosedEdge<double>&, const ClosedEdge<double>&);
template Bounded<long double> closed_log_integral(const ClosedEdge<long double>&,
                                                  const ClosedEdge<long double>&);

}  // namespace host
