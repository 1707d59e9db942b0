// Exact point-to-polygon factors, and their mean over N x N points of a patch.
#pragma once
#include "form_factor/estimate.hpp"
#include "geometry/polygon.hpp"

namespace host {

/// Form factor from a surface element at x with unit normal n to `polygon`, clipped at the
/// element's horizon and seen from the polygon's lit side only [Lambert 1760]: sum of n . unit(r_k
/// x r_k+1) * angle(r_k, r_k+1) / (2 pi).
double point_form_factor(const Vec3& x, const Vec3& n, const Polygon& polygon);

/// A_p F_pq by n x n Gauss points on p (a convex quadrilateral; n x n on each piece of anything
/// else), exact over q. Not symmetric. n in 1..32, else Error.
double lambert_exchange(const Polygon& p, const Polygon& q, int n);

Estimate lambert_estimate(const Polygon& p, const Polygon& q, int n);

}  // namespace host
