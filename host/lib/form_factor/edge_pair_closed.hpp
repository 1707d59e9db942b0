// The integral under the double contour form of a form factor, in closed form.
#pragma once
#include <array>
#include <glm/glm.hpp>

namespace host {

/// A straight edge in coordinates of about unit size; length > 0.
template <class Real>
struct ClosedEdge {
  std::array<glm::vec<3, Real>, 2> ends;
  glm::vec<3, Real> direction;
  Real length;
};

/// A value and a bound of its absolute error, rounding of what cancels included.
template <class Real>
struct Bounded {
  Real value = 0;
  Real error = 0;
};

/// int over e, int over f of ln r, through dilogarithms [Schroeder & Hanrahan 1993], for edges that
/// make a sharp angle (turn one round). Real: double or long double.
///
/// The error is about epsilon reach^2 / sine of the angle, and for edges almost parallel, which are
/// taken as parallel, that of the turn.
template <class Real>
Bounded<Real> closed_log_integral(const ClosedEdge<Real>& e, const ClosedEdge<Real>& f);

extern template Bounded<double> closed_log_integral(const ClosedEdge<double>&,
                                                    const ClosedEdge<double>&);
extern template Bounded<long double> closed_log_integral(const ClosedEdge<long double>&,
                                                         const ClosedEdge<long double>&);

}  // namespace host
