// visibility_block.hpp -- one ray against one blocker, and what tells beforehand that it misses.
#pragma once
#include "least.hpp"
#include "urad/scene.h"

namespace urad {

/// Scene units by which a ray may miss a blocker and still be stopped.
inline constexpr int32_t kOutline = 2;

constexpr int32_t greatest(int32_t a, int32_t b) noexcept { return a < b ? b : a; }

/// Makes the box of *low and *high hold that of `from` and `to`.
inline void stretch(const urad_point& from, const urad_point& to, urad_point* low,
                    urad_point* high) noexcept {
  *low = {least(low->x, from.x), least(low->y, from.y), least(low->z, from.z)};
  *high = {greatest(high->x, to.x), greatest(high->y, to.y), greatest(high->z, to.z)};
}

/// Corner of a whole grid, in the order of those of a patch.
inline urad_point corner_of(const urad_grid& grid, int k) noexcept {
  const int32_t u = k == 1 || k == 2 ? grid.count_u : 0, v = k >= 2 ? grid.count_v : 0;
  return {grid.origin.x + u * grid.step_u.x + v * grid.step_v.x,
          grid.origin.y + u * grid.step_u.y + v * grid.step_v.y,
          grid.origin.z + u * grid.step_u.z + v * grid.step_v.z};
}

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
