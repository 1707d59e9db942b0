#include "scene_check_sight.hpp"
#include "urad/patch.hpp"
#include "urad/vec.hpp"

namespace urad {

namespace {

constexpr uint32_t kCoordinateMax = URAD_COORDINATE_MAX;
constexpr int32_t kLog2Max = 64 << 24;

bool inside(const urad_point& p) noexcept {
  return magnitude(p.x) <= kCoordinateMax && magnitude(p.y) <= kCoordinateMax &&
         magnitude(p.z) <= kCoordinateMax;
}

/// |n| = 1 within 2^-20.
bool unit(const urad_point& n) noexcept {
  constexpr uint32_t one = uint32_t{1} << 30;
  if (magnitude(n.x) > one || magnitude(n.y) > one || magnitude(n.z) > one) return false;
  const int64_t off = dot(n, n) - (int64_t{1} << 60);
  return magnitude(off) <= uint64_t{1} << 40;
}

/// M_ab^2 <= M_aa M_bb as in every matrix of second moments, but for its rounding. Then no |M v| is
/// above |v|, which keeps the terms of the moment kernel in 32 bits.
bool mixed(int32_t ab, int32_t aa, int32_t bb) noexcept {
  constexpr int32_t slack = 2;
  const int32_t least = int32_t(magnitude(ab)) - slack;
  return least <= 0 || least * least <= (aa + slack) * (bb + slack);
}

bool good(const urad_shape& shape) noexcept {
  if (!unit(shape.normal_q30)) return false;
  if (magnitude(shape.log2_area_q24) > uint32_t(kLog2Max)) return false;
  if (magnitude(shape.log2_spread_q24) > uint32_t(kLog2Max)) return false;
  const int32_t trace = shape.spread_q15[0] + shape.spread_q15[1] + shape.spread_q15[2];
  if (trace < 32768 - 8 || trace > 32768 + 8) return false;
  const int16_t* m = shape.spread_q15;
  return m[0] >= 0 && m[1] >= 0 && m[2] >= 0 && mixed(m[3], m[0], m[1]) &&
         mixed(m[4], m[0], m[2]) && mixed(m[5], m[1], m[2]) && shape.fill_uq15 <= 32768;
}

/// The far corner is computed in 64 bits, so that steps and counts cannot wrap before they are
/// judged.
bool good(const urad_grid& grid, uint16_t patch_count) noexcept {
  if (grid.count_u == 0 || grid.count_v == 0) return false;
  if (uint32_t{grid.count_u} * grid.count_v != patch_count) return false;
  if (!inside(grid.origin) || !good(grid.shape)) return false;
  const auto reaches = [&](int32_t origin, int32_t step_u, int32_t step_v) {
    const int64_t u = wide_mul(step_u, grid.count_u), v = wide_mul(step_v, grid.count_v);
    const int64_t limit = kCoordinateMax;
    const auto fits = [=](int64_t x) { return x <= limit && x >= -limit; };
    return fits(origin + u) && fits(origin + v) && fits(origin + u + v);
  };
  return reaches(grid.origin.x, grid.step_u.x, grid.step_v.x) &&
         reaches(grid.origin.y, grid.step_u.y, grid.step_v.y) &&
         reaches(grid.origin.z, grid.step_u.z, grid.step_v.z);
}

bool loop_in_table(const urad_scene& scene, uint32_t first, uint16_t count) noexcept {
  return scene.vertex && count >= 3 && count <= URAD_POLYGON_MAX_VERTICES &&
         first < scene.vertex_count && count <= scene.vertex_count - first;
}

/// A mean lies between what it is the mean of, and by a unit past it where both are rounded: frames
/// of exact sums are made to hold the vertices, and hold the centroid by this.
bool between_vertices(const urad_scene& scene, const urad_polygon& polygon) noexcept {
  const auto between = [&](int32_t urad_point::*axis) {
    const int32_t mean = polygon.centroid.*axis;
    bool low = false, high = false;
    for (uint16_t k = 0; k < polygon.vertex_count; ++k) {
      const int32_t x = scene.vertex[polygon.first_vertex + k].*axis;
      low = low || x <= mean + 1;
      high = high || x >= mean - 1;
    }
    return low && high;
  };
  return between(&urad_point::x) && between(&urad_point::y) && between(&urad_point::z);
}

/// Looked at before any patch: lists are only read when their lengths add up.
bool counts_add_up(const urad_scene& scene) noexcept {
  uint32_t patches = 0;
  for (uint16_t s = 0; s < scene.surface_count; ++s) {
    const urad_surface& surface = scene.surface[s];
    if (surface.first_patch != patches || surface.patch_count == 0) return false;
    patches += surface.patch_count;
  }
  return patches == scene.patch_count;
}

bool good(const urad_scene& scene, const urad_surface& surface) noexcept {
  if (surface.material >= scene.material_count) return false;
  if ((surface.grid != nullptr) == (surface.polygon != nullptr)) return false;
  if (surface.grid) return good(*surface.grid, surface.patch_count);
  for (uint16_t k = 0; k < surface.patch_count; ++k) {
    const urad_polygon& polygon = surface.polygon[k];
    if (!good(polygon.shape) || !inside(polygon.centroid)) return false;
    if (!loop_in_table(scene, polygon.first_vertex, polygon.vertex_count)) return false;
    if (!between_vertices(scene, polygon)) return false;
  }
  return true;
}

bool good(const urad_material& material) noexcept {
  for (int c = 0; c < 3; ++c) {
    if (material.reflectance_uq15[c] > 32768) return false;
    if (material.exitance[c] < 0 || material.exitance[c] > int32_t{1} << 30) return false;
  }
  return true;
}

bool good(const urad_scene& scene, const urad_blocker& blocker) noexcept {
  return unit(blocker.normal_q30) && inside(blocker.low) && inside(blocker.high) &&
         loop_in_table(scene, blocker.first_vertex, blocker.vertex_count) &&
         (blocker.surface == 0xFFFF || blocker.surface < scene.surface_count);
}

}  // namespace

Status scene_check(const urad_scene* scene) noexcept {
  if (!scene) return Status::bad_scene;
  const bool sight = scene->abi == URAD_SCENE_ABI_SIGHT;
  if ((scene->abi != URAD_SCENE_ABI && !sight) || scene->patch_count == 0 || !scene->surface ||
      !scene->material) {
    return Status::bad_scene;
  }
  if ((scene->blocker_count && !scene->blocker) || (scene->vertex_count && !scene->vertex))
    return Status::bad_scene;
  if (magnitude(scene->log2_power_q24) > uint32_t(kLog2Max)) return Status::bad_scene;
  if (!counts_add_up(*scene)) return Status::bad_scene;
  for (uint16_t s = 0; s < scene->surface_count; ++s) {
    if (!good(*scene, scene->surface[s])) return Status::bad_scene;
  }
  for (uint16_t m = 0; m < scene->material_count; ++m) {
    if (!good(scene->material[m])) return Status::bad_scene;
  }
  for (uint32_t v = 0; v < scene->vertex_count; ++v) {
    if (!inside(scene->vertex[v])) return Status::bad_scene;
  }
  for (uint16_t b = 0; b < scene->blocker_count; ++b) {
    if (!good(*scene, scene->blocker[b])) return Status::bad_scene;
  }
  if (sight && !good_sight(*scene)) return Status::bad_scene;
  if (scene->log2_scale_q24) {
    for (uint16_t k = 0; k < scene->patch_count; ++k) {
      if (magnitude(scene->log2_scale_q24[k]) > uint32_t{8} << 24) return Status::bad_scene;
    }
  }
  return Status::ok;
}

}  // namespace urad
