// Form factors of planar polygons in closed form: a second truth, which shares only the clipper and
// the moments with the reference.
//
//   A_p F_pq = 1/(2 pi) sum over edges e of p, f of q of  cos(e, f) int_e int_f ln r
//   [Schroeder & Hanrahan 1993]
//
// with every integral through dilogarithms (edge_pair_closed.hpp) and no quadrature anywhere.
#pragma once
#include <algorithm>

#include "form_factor/estimate.hpp"
#include "geometry/polygon.hpp"

namespace host {

/// Largest absolute error of a closed-form factor that is still an answer.
constexpr double kClosedFormTolerance = 1e-9;

struct ClosedForm {
  double f = 0;      ///< from p to q, 0..1
  double error = 0;  ///< bound of its absolute error, from the sizes of what cancels
  bool ill_conditioned() const { return !(error <= kClosedFormTolerance); }
  /// With the error as a part of f, at most 1.
  Estimate estimate() const { return {f, error > 0 ? error / std::max(error, f) : 0}; }
};

/// F from p to q, each clipped to the other's front half-space. In double, and once more in long
/// double where the error of double comes near the tolerance: almost parallel edges, and patches
/// small against their distance. Patches of about 1e-6 of their distance defeat both, and are
/// ill_conditioned(). Any scale; never NaN for finite vertices.
ClosedForm closed_form(const Polygon& p, const Polygon& q);

}  // namespace host
