#include "urad/patch.hpp"

#include "urad/vec.hpp"

namespace urad {

namespace {

/// origin + u/2 step_u + v/2 step_v, rounded symmetrically.
urad_point grid_point(const urad_grid& grid, int32_t twice_u, int32_t twice_v) noexcept {
  const auto along = [=](int32_t origin, int32_t step_u, int32_t step_v) {
    return int32_t(origin + round_shift(int64_t{step_u} * twice_u + int64_t{step_v} * twice_v, 1));
  };
  return {along(grid.origin.x, grid.step_u.x, grid.step_v.x),
          along(grid.origin.y, grid.step_u.y, grid.step_v.y),
          along(grid.origin.z, grid.step_u.z, grid.step_v.z)};
}

/// Sixteen steps of long division: chips without a divider have no helper linked in. divisor > 0.
struct Quotient {
  uint16_t value, rest;
};
Quotient divide(uint16_t dividend, uint16_t divisor) noexcept {
  uint32_t rest = 0, value = 0;
  for (int bit = 15; bit >= 0; --bit) {
    rest = rest << 1 | (dividend >> bit & 1u);
    value <<= 1;
    if (rest >= divisor) rest -= divisor, value |= 1u;
  }
  return {uint16_t(value), uint16_t(rest)};
}

void place_in_grid(Patch* patch) noexcept {
  patch->centroid = grid_point(*patch->surface->grid, 2 * patch->u + 1, 2 * patch->v + 1);
}

void place_in_list(Patch* patch) noexcept {
  const urad_polygon& polygon = patch->surface->polygon[patch->index - patch->surface->first_patch];
  patch->shape = &polygon.shape;
  patch->centroid = polygon.centroid;
  patch->vertex_count = polygon.vertex_count;
}

}  // namespace

uint16_t surface_of(const urad_scene& scene, uint16_t patch) noexcept {
  uint16_t low = 0, high = scene.surface_count;
  while (high - low > 1) {
    const uint16_t middle = uint16_t((low + high) >> 1);
    (scene.surface[middle].first_patch <= patch ? low : high) = middle;
  }
  return low;
}

Patch patch_at(const urad_scene& scene, uint16_t patch) noexcept {
  const urad_surface& surface = scene.surface[surface_of(scene, patch)];
  Patch result{nullptr, {0, 0, 0}, &surface, patch, 4, 0, 0};
  if (surface.grid) {
    const Quotient at = divide(uint16_t(patch - surface.first_patch), surface.grid->count_u);
    result.shape = &surface.grid->shape;
    result.u = at.rest;
    result.v = at.value;
    place_in_grid(&result);
  } else {
    place_in_list(&result);
  }
  return result;
}

void patch_advance(Patch* patch) noexcept {
  ++patch->index;
  if (!patch->surface->grid) return place_in_list(patch);
  if (++patch->u == patch->surface->grid->count_u) patch->u = 0, ++patch->v;
  place_in_grid(patch);
}

urad_point patch_vertex(const urad_scene& scene, const Patch& patch, uint16_t k) noexcept {
  if (!patch.surface->grid) {
    return scene
        .vertex[patch.surface->polygon[patch.index - patch.surface->first_patch].first_vertex + k];
  }
  const int32_t u = patch.u + (k == 1 || k == 2), v = patch.v + (k >= 2);
  return grid_point(*patch.surface->grid, 2 * u, 2 * v);
}

}  // namespace urad
