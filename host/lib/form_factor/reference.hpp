// Exact form factors of planar polygons: the truth that every other method is measured against.
//
//   G = A_p F_pq = 1/(2 pi) sum over edges e of p, f of q of  (e.f)/(|e||f|) int_e int_f ln r
//   [Stokes]
//
// over both polygons clipped to each other's front half-space. Nothing is shadowed by a third
// polygon.
#pragma once
#include "form_factor/estimate.hpp"
#include "geometry/polygon.hpp"

namespace host {

/// Exchange A_p F_pq, 0 <= G <= min(A_p, A_q), in the square of the length unit. Bit-equal when p
/// and q change places and when both are scaled by a power of two. Survives repeated vertices,
/// slivers, touching, coplanar and nearly coplanar polygons: never NaN for finite vertices.
double reference_exchange(const Polygon& p, const Polygon& q);

/// F from p to q: reference_exchange / A_p; 0 for a polygon without area.
double reference_form_factor(const Polygon& p, const Polygon& q);

/// The same with an estimate of the relative error: rounding of what cancels and the tolerance of
/// the quadrature.
Estimate reference_estimate(const Polygon& p, const Polygon& q);

}  // namespace host
