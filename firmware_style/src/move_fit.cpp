// Blockers and their boxes after geometry has moved.
#include "urad/move.hpp"
#include "visibility_block.hpp"

namespace urad {

namespace {

void stretch(const urad_point& p, const urad_point& q, urad_point* low, urad_point* high) noexcept {
  *low = {least(low->x, p.x), least(low->y, p.y), least(low->z, p.z)};
  *high = {greatest(high->x, q.x), greatest(high->y, q.y), greatest(high->z, q.z)};
}

urad_point corner_of(const urad_grid& grid, int k) noexcept {
  const int32_t u = k == 1 || k == 2 ? grid.count_u : 0, v = k >= 2 ? grid.count_v : 0;
  return {grid.origin.x + u * grid.step_u.x + v * grid.step_v.x,
          grid.origin.y + u * grid.step_u.y + v * grid.step_v.y,
          grid.origin.z + u * grid.step_u.z + v * grid.step_v.z};
}

}  // namespace

void blocker_make(const urad_grid& grid, urad_point* vertex, urad_blocker* blocker) noexcept {
  blocker->normal_q30 = grid.shape.normal_q30;
  blocker->vertex_count = 4;
  blocker->low = blocker->high = grid.origin;
  for (int k = 0; k < 4; ++k) {
    const urad_point p = corner_of(grid, k);
    vertex[blocker->first_vertex + uint32_t(k)] = p;
    stretch(p, p, &blocker->low, &blocker->high);
  }
}

void bounds_fit(urad_bounds* bounds, uint16_t count, const urad_blocker* blocker) noexcept {
  for (uint32_t k = 0; k < count; ++k) {
    urad_bounds& box = bounds[k];
    box.low = blocker[box.first].low, box.high = blocker[box.first].high;
    for (uint32_t b = box.first; b < box.end; ++b)
      stretch(blocker[b].low, blocker[b].high, &box.low, &box.high);
  }
}

}  // namespace urad
