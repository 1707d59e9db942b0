// move_shaft.hpp -- whether anything in a box can pass between two others [Haines & Wallace 1991].
#pragma once
#include "urad/scene.h"

namespace urad {

/// A box in units of 2^16 scene units, rounded outwards, so that what it says of the real one is
/// certain and products of differences fit 32 bits.
struct CoarseBox {
  int32_t low[3], high[3];
};

/// Around low .. high and what lies kOutline beyond.
CoarseBox coarse_box(const urad_point& low, const urad_point& high) noexcept;

/// False when the convex hull of i and j, the shaft of all segments between them, misses `box` in one
/// of the three upright projections. There the hull of two rectangles has edges between corners of
/// one kind only; the corner of `box` nearest to such an edge tells.
bool shaft_meets(const CoarseBox& i, const CoarseBox& j, const CoarseBox& box) noexcept;

}  // namespace urad
