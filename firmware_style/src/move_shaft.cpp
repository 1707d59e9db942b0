#include "move_shaft.hpp"

#include "urad/q.hpp"
#include "visibility_block.hpp"

namespace urad {

namespace {

constexpr int kCoarse = 16;  // bits dropped: |coordinate| <= 2^13 + 1

/// Whether an edge between like corners of the rectangles of i and j, seen along the third axis,
/// leaves the whole of `box` outside. right, up: which corners.
bool edge_parts(const CoarseBox& i, const CoarseBox& j, const CoarseBox& box, int a, int b,
                bool right, bool up) noexcept {
  const auto along = [](const CoarseBox& of, int axis, bool high) {
    return high ? of.high[axis] : of.low[axis];
  };
  const int32_t p = along(i, a, right), q = along(i, b, up);
  const int32_t u = along(j, a, right) - p, v = along(j, b, up) - q;
  // An edge of the hull goes outwards along one axis and inwards along the other.
  if (u == 0 || v == 0 || ((u > 0) == right) == ((v > 0) == up)) return false;
  const int32_t x = along(box, a, !right) - p, y = along(box, b, !up) - q;
  const int32_t size_u = u < 0 ? -u : u, size_v = v < 0 ? -v : v;
  return size_v * (right ? x : -x) + size_u * (up ? y : -y) > 0;
}

}  // namespace

CoarseBox coarse_box(const urad_point& low, const urad_point& high) noexcept {
  const auto down = [](int32_t x) { return shift_down(x - kOutline, kCoarse); };
  const auto up = [](int32_t x) { return shift_down(x + kOutline, kCoarse) + 1; };
  return {{down(low.x), down(low.y), down(low.z)}, {up(high.x), up(high.y), up(high.z)}};
}

bool shaft_meets(const CoarseBox& i, const CoarseBox& j, const CoarseBox& box) noexcept {
  for (int a = 0; a < 3; ++a) {
    if (greatest(i.high[a], j.high[a]) < box.low[a]) return false;
    if (least(i.low[a], j.low[a]) > box.high[a]) return false;
  }
  for (int a = 0; a < 3; ++a) {
    const int b = a == 2 ? 0 : a + 1;
    for (int corner = 0; corner < 4; ++corner) {
      if (edge_parts(i, j, box, a, b, corner & 1, corner & 2)) return false;
    }
  }
  return true;
}

}  // namespace urad
