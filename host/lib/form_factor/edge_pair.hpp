// The integral under the double contour form of a form factor.
#pragma once
#include "geometry/polygon.hpp"

namespace host {

/// A straight edge: start, unit direction, length > 0.
struct Edge {
  Vec3 start;
  Vec3 direction;
  double length;
};

/// int over e, int over f of ln(r / unit): exact to about 1e-16 |e| |f| for any two edges, also
/// where they touch, cross, coincide or are nearly parallel. `unit` only keeps the logarithm small;
/// it cancels over closed contours.
double log_distance_integral(const Edge& e, const Edge& f, double unit);

}  // namespace host
