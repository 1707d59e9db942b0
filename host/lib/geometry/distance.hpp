// How far apart two polygons are.
#pragma once
#include "geometry/polygon.hpp"

namespace host {

/// Least distance between points of two planar polygons that do not pierce each other; their edges
/// and interiors count, holes do not. Good to rounding of the coordinates.
double distance(const Polygon& p, const Polygon& q);

}  // namespace host
