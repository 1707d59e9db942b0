// visibility_block.hpp -- one ray against one blocker, and what tells beforehand that it misses.
#pragma once
#include "urad/scene.h"

namespace urad {

/// Scene units by which a ray may miss a blocker and still be stopped.
inline constexpr int32_t kOutline = 2;

constexpr int32_t least(int32_t a, int32_t b) noexcept { return a < b ? a : b; }
constexpr int32_t greatest(int32_t a, int32_t b) noexcept { return a < b ? b : a; }

constexpr bool apart(int32_t a, int32_t b, int32_t low, int32_t high, int32_t slack) noexcept {
  return greatest(a, b) < low - slack || least(a, b) > high + slack;
}

/// Whether the box around two points lies beside another, by more than kOutline.
constexpr bool boxes_apart(const urad_point& a, const urad_point& b, const urad_point& low,
                           const urad_point& high) noexcept {
  return apart(a.x, b.x, low.x, high.x, kOutline) || apart(a.y, b.y, low.y, high.y, kOutline) ||
         apart(a.z, b.z, low.z, high.z, kOutline);
}

/// Whether the blocker stands across the segment from a to b. side_a, side_b: the side of its plane
/// that the end is known to lie on, whatever the rounding of the point says; 0: what the point says,
/// and an end on the plane is not blocked.
bool stands_across(const urad_scene& scene, const urad_blocker& blocker, const urad_point& a,
                   const urad_point& b, int side_a, int side_b) noexcept;

}  // namespace urad
