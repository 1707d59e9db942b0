#include "urad/patch.hpp"

#include "urad/vec.hpp"

namespace urad {

namespace {

/// origin + u step_u + v step_v. Corners lie within the scene's box, so 32 bits hold every sum.
urad_point grid_corner(const urad_grid& grid, int32_t u, int32_t v) noexcept {
  return {grid.origin.x + u * grid.step_u.x + v * grid.step_v.x,
          grid.origin.y + u * grid.step_u.y + v * grid.step_v.y,
          grid.origin.z + u * grid.step_u.z + v * grid.step_v.z};
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
  const urad_grid& grid = *patch->surface->grid;
  const urad_point corner = grid_corner(grid, patch->u, patch->v);
  const auto middle = [](int32_t at, int32_t step_u, int32_t step_v) {
    return at + round_shift(step_u + step_v, 1);
  };
  patch->centroid = {middle(corner.x, grid.step_u.x, grid.step_v.x),
                     middle(corner.y, grid.step_u.y, grid.step_v.y),
                     middle(corner.z, grid.step_u.z, grid.step_v.z)};
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
  const urad_grid& grid = *patch->surface->grid;
  if (++patch->u == grid.count_u) {
    patch->u = 0, ++patch->v;
    return place_in_grid(patch);
  }
  const urad_point& c = patch->centroid;
  patch->centroid = {c.x + grid.step_u.x, c.y + grid.step_u.y, c.z + grid.step_u.z};
}

urad_point patch_vertex(const urad_scene& scene, const Patch& patch, uint16_t k) noexcept {
  if (!patch.surface->grid) {
    return scene
        .vertex[patch.surface->polygon[patch.index - patch.surface->first_patch].first_vertex + k];
  }
  const int32_t u = patch.u + (k == 1 || k == 2), v = patch.v + (k >= 2);
  return grid_corner(*patch.surface->grid, u, v);
}

}  // namespace urad
