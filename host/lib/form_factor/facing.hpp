// The parts of two polygons that can see each other.
#pragma once
#include "geometry/polygon.hpp"

namespace host {

/// p and q, each clipped to the other's front half-space. Both are empty when nothing is left of
/// either, when a polygon has no area, and when the two planes agree within rounding.
struct FacingPair {
  Polygon p;
  Polygon q;
  bool empty() const { return p.outer.empty() || q.outer.empty(); }
};

FacingPair clip_to_front(const Polygon& p, const Polygon& q);

}  // namespace host
