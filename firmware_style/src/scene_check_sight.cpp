#include "scene_check_sight.hpp"

#include "visibility_row.hpp"

namespace urad {

namespace {

bool holds(const urad_bounds& box, const urad_point& low, const urad_point& high) noexcept {
  return box.low.x <= low.x && box.low.y <= low.y && box.low.z <= low.z && box.high.x >= high.x &&
         box.high.y >= high.y && box.high.z >= high.z;
}

/// Box k against its blockers, its parts and the box after it.
bool good_bounds(const urad_scene& scene, uint16_t k) noexcept {
  const urad_bounds& box = scene.bounds[k];
  if (box.first >= box.end || box.end > scene.blocker_count) return false;
  if (box.next <= k || box.next > scene.bounds_count) return false;
  for (uint16_t b = box.first; b < box.end; ++b) {
    if (!holds(box, scene.blocker[b].low, scene.blocker[b].high)) return false;
  }
  if (k + 1 < box.next) {
    const urad_bounds& part = scene.bounds[k + 1];
    if (part.first < box.first || part.end > box.end || part.next > box.next) return false;
  }
  if (box.next == scene.bounds_count) return true;
  return scene.bounds[box.next].first >= box.end;
}

bool good_row(const urad_visibility& table, uint16_t shooter) noexcept {
  const uint32_t start = table.row[shooter] & ~URAD_VISIBILITY_RUNS;
  if (start >= table.byte_count) return false;
  const uint32_t left = table.byte_count - start;
  if (!(table.row[shooter] & URAD_VISIBILITY_RUNS))
    return (uint32_t{table.patch_count} * table.bits + 7) >> 3 <= left;
  const VisibilityRow row(table, shooter, 0);
  uint32_t patches = 0;
  for (uint32_t k = 0; k < left && patches < table.patch_count; ++k)
    patches += row.length(table.code[start + k]);
  return patches == table.patch_count;
}

bool good(const urad_visibility& table, uint16_t patch_count) noexcept {
  if (table.patch_count != patch_count || (table.bits != 1 && table.bits != 4)) return false;
  if (!table.row || !table.code) return false;
  for (uint16_t k = 0; k < patch_count; ++k) {
    if (!good_row(table, k)) return false;
  }
  return true;
}

}  // namespace

bool good_sight(const urad_scene& scene) noexcept {
  if (scene.bounds_count && !scene.bounds) return false;
  for (uint16_t k = 0; k < scene.bounds_count; ++k) {
    if (!good_bounds(scene, k)) return false;
  }
  return !scene.visibility || good(*scene.visibility, scene.patch_count);
}

}  // namespace urad
