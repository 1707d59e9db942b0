// Blockers and their boxes after geometry has moved.
#include "urad/move.hpp"
#include "visibility_block.hpp"

namespace urad {

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
