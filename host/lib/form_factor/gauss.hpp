// Area against area: the product Gauss rule on both patches.
#pragma once
#include "form_factor/estimate.hpp"
#include "geometry/polygon.hpp"

namespace host {

/// A_p F_pq by n^2 x n^2 evaluations of cos cos / (pi r^2) between convex quadrilaterals (per pair
/// of pieces for other polygons). Far pairs only: touching patches converge like 1/n. n in 1..32,
/// else Error.
double gauss_exchange(const Polygon& p, const Polygon& q, int n);

Estimate gauss_estimate(const Polygon& p, const Polygon& q, int n);

}  // namespace host
