// patch.hpp -- one enumerator for both kinds of surface: patches appear when asked for and are
// never stored.
#pragma once
#include "urad/scene.h"
#include "urad/status.hpp"

namespace urad {

/// One patch, valid as long as the scene. Vertices come from patch_vertex().
struct Patch {
  const urad_shape* shape;
  urad_point centroid;
  const urad_surface* surface;
  uint16_t index;         ///< number in the scene
  uint16_t vertex_count;  ///< 4 for a grid patch
  uint16_t u, v;          ///< place in a grid, 0 in a polygon list
};

/// Index of the surface that holds patch `patch`. patch < scene.patch_count (unchecked),
/// log2(surface_count) steps.
uint16_t surface_of(const urad_scene& scene, uint16_t patch) noexcept;

/// The patch with this number. patch < scene.patch_count (unchecked).
Patch patch_at(const urad_scene& scene, uint16_t patch) noexcept;

/// Moves to the next patch of the same surface (unchecked): no division, unlike patch_at().
void patch_advance(Patch* patch) noexcept;

/// Corner k < patch.vertex_count, counter-clockwise from the lit side.
urad_point patch_vertex(const urad_scene& scene, const Patch& patch, uint16_t k) noexcept;

/// Walks every table once: counts, ranges, null pointers, coordinates within URAD_COORDINATE_MAX,
/// centroids between their vertices, unit normals, materials that exist, reflectance <= 1. Call it
/// once on data that is not trusted; the rest of the engine does not check.
Status scene_check(const urad_scene* scene) noexcept;

/// CRC-32 of the fields of a scene, and of the tables they count; pointers are left out.
struct SceneCrc {
  uint32_t fields, tables;
};
SceneCrc scene_crc32(const urad_scene& scene) noexcept;

/// Against what the exporter wrote: the fields, then scene_check(), then the tables, so that no
/// faulty count is followed. Finds every single-bit fault.
Status scene_verify(const urad_scene* scene, const SceneCrc& crc) noexcept;

}  // namespace urad
