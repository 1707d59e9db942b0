// One loop for a polygon with holes.
#pragma once
#include "geometry/polygon.hpp"

namespace host {

/// Outer loop and holes joined by bridges: edges that are walked once in each direction, so that
/// area, moments and contour integrals are those of the polygon. Without holes: the outer loop as
/// it is. Holes run clockwise in the result whatever their direction was. n vertices in h loops
/// give n + 2 (h - 1).
Loop bridge_holes(const Polygon& polygon);

}  // namespace host
