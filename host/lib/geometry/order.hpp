// One way to write a polygon down.
#pragma once
#include "geometry/polygon.hpp"

namespace host {

/// The same polygon, whichever vertex it was written from, whichever way its holes run and in
/// whichever order they stand: every loop starts so that its vertices come first in lexicographic
/// order. Rules that choose points by corner (area_rule.hpp) then choose the same points, to the
/// last bit.
Polygon standard_order(const Polygon& polygon);

/// One order for each unordered pair, the same at every scale: what does not care which of the two
/// comes first is then symmetric bit for bit. Both in standard order.
bool written_before(const Polygon& p, const Polygon& q);

}  // namespace host
