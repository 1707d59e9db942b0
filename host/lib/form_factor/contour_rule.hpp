// Contour against contour: Gauss rules on both, what most textbooks print.
#pragma once
#include "form_factor/estimate.hpp"
#include "geometry/polygon.hpp"

namespace host {

/// F from p to q by n points on every edge of both: 1/(2 pi A_p) sum w w' ln r dx . dx'
/// [Sparrow 1963]. Parts behind the other's plane are cut off first. Edges that touch make it wrong,
/// and infinite where points meet. n in 1..32, else Error.
Estimate contour_estimate(const Polygon& p, const Polygon& q, int n);

}  // namespace host
