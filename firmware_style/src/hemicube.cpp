#include "urad/hemicube.hpp"

#include "hemicube_raster.hpp"
#include "urad/vec.hpp"
#include "visibility_sample.hpp"

namespace urad {

namespace raster {

urad_point direction(const Eye& eye, const urad_point& x) noexcept {
  const urad_point d = x - eye.at;  // components up to 2^30
  const int down = 1 + top_bit(magnitude(d.x) | magnitude(d.y) | magnitude(d.z));
  const auto along = [&](int k) { return int32_t(round_shift(dot(d, eye.frame.axis[k]), down)); };
  return {along(0), along(1), along(2)};
}

namespace {

/// Normal and offset of a plane in the frame. False when the eye lies in the plane, which is then
/// seen edge-on.
bool view_plane(const Eye& eye, const urad_point& normal_q30, const urad_point& on_plane,
                View* view) noexcept {
  view->offset_q30 = dot(normal_q30, on_plane - eye.at);
  if (magnitude(round_shift(view->offset_q30, 30)) <= uint32_t(kPlaneTolerance)) return false;
  const auto along = [&](int k) {
    return int32_t(round_shift(dot(normal_q30, eye.frame.axis[k]), 30));
  };
  view->normal_q30 = {along(0), along(1), along(2)};
  return true;
}

/// What is to be drawn in one walk over the scene: one band of one face or, without an item buffer,
/// all faces.
struct Walk {
  const HemicubeSource& source;
  Eye eye;
  const urad_surface* own;  // planar surface of the shooter; null: none
  uint16_t shooter;
  int first_face, end_face, first_row, end_row;
  unsigned drawn;  // faces that something was drawn on
  Band touched;    // rows of this walk that something was drawn on

  /// Faces of this walk that a polygon with these vertices may touch, as bits.
  unsigned reach(const urad_point* corner, int corners) const noexcept {
    unsigned faces = 0;
    for (int face = first_face; face < end_face; ++face) {
      unsigned shared = anywhere;
      for (int k = 0; k < corners && shared; ++k) shared &= outside(face, to_face(face, corner[k]));
      if (!shared) faces |= 1u << face;
    }
    return faces;
  }

  void draw(const View& view) noexcept {
    const int resolution = source.table.resolution, words = (resolution + 31) >> 5;
    const unsigned faces = reach(view.corner, view.corners);
    for (int face = first_face; face < end_face; ++face) {
      if (!(faces >> face & 1u)) continue;
      const Band band{face, first_row, end_row};
      const Band rows = scan(view, band, resolution, words, source.mask);
      const uint32_t cells = paint(source, view, band, rows);
      source.counters->cells += cells;
      if (cells == 0) continue;
      drawn |= 1u << face;
      touched.first = rows.first < touched.first ? rows.first : touched.first;
      touched.end = rows.end > touched.end ? rows.end : touched.end;
    }
  }

  bool surface_in_reach(const urad_surface& surface) const noexcept {
    if (&surface == own) return false;
    if (!surface.grid) return true;
    const urad_grid& grid = *surface.grid;
    const auto at = [&](int32_t u, int32_t v) {
      return direction(eye, {grid.origin.x + u * grid.step_u.x + v * grid.step_v.x,
                             grid.origin.y + u * grid.step_u.y + v * grid.step_v.y,
                             grid.origin.z + u * grid.step_u.z + v * grid.step_v.z});
    };
    const urad_point corner[4] = {at(0, 0), at(grid.count_u, 0), at(grid.count_u, grid.count_v),
                                  at(0, grid.count_v)};
    return reach(corner, 4) != 0;
  }

  void draw_patch(const Patch& patch) noexcept {
    View view{source.corner, patch.vertex_count, patch.index, patch.index, {}, 0};
    if (patch.index == shooter) return;
    if (!view_plane(eye, patch.shape->normal_q30, patch.centroid, &view)) return;
    if (view.offset_q30 > 0) {  // its dark side
      if (source.rows == 0) return;
      view.item = view.patch = kNoItem;
    }
    for (uint16_t k = 0; k < patch.vertex_count; ++k) {
      source.corner[k] = direction(eye, patch_vertex(*source.scene, patch, k));
    }
    draw(view);
  }

  void draw_blocker(const urad_blocker& blocker) noexcept {
    const urad_point* vertex = source.scene->vertex + blocker.first_vertex;
    View view{source.corner, blocker.vertex_count, kNoItem, kNoItem, {}, 0};
    if (!view_plane(eye, blocker.normal_q30, vertex[0], &view)) return;
    for (uint16_t k = 0; k < blocker.vertex_count; ++k)
      source.corner[k] = direction(eye, vertex[k]);
    draw(view);
  }

  void run() noexcept {
    const urad_scene& scene = *source.scene;
    for (uint16_t s = 0; s < scene.surface_count; ++s) {
      const urad_surface& surface = scene.surface[s];
      if (!surface_in_reach(surface)) continue;
      Patch patch = patch_at(scene, surface.first_patch);
      for (uint16_t k = 1; k < surface.patch_count; ++k, patch_advance(&patch)) draw_patch(patch);
      draw_patch(patch);
    }
    if (source.rows == 0) return;
    for (uint16_t b = 0; b < scene.blocker_count; ++b) {
      if (scene.blocker[b].surface == 0xFFFF) draw_blocker(scene.blocker[b]);
    }
  }
};

/// Where the half cube stands: on the centre, or on the middle of a quarter of the patch.
urad_point eye_on(const urad_scene& scene, const Patch& patch, int eye, int eyes) noexcept {
  urad_point point = patch.centroid;
  if (eyes == 1) return point;
  const PatchSampler sampler(scene, patch);
  const uint32_t x = eye & 1 ? 0x60000000u : 0x20000000u, y = eye & 2 ? 0x60000000u : 0x20000000u;
  return sampler.point(x, y, &point) ? point : patch.centroid;
}

Walk walk_from(const HemicubeSource& source, uint16_t shooter, int eye = 0, int eyes = 1) noexcept {
  const Patch patch = patch_at(*source.scene, shooter);
  const Eye from{eye_on(*source.scene, patch, eye, eyes),
                 hemicube_frame(patch.shape->normal_q30, shooter, source.flags & hemicube_turned)};
  const bool planar = patch.surface->flags & URAD_SURFACE_PLANAR;
  return {source, from, planar ? patch.surface : nullptr, shooter, 0,
          5,      0,    source.table.resolution,          0,       {0, 0, 0}};
}

/// Rounded vertices leave seams that one cell in a million falls into: its share goes to the
/// greatest receiver. A sum that is off by more than 2^-8 is left alone: the scene is not as closed
/// as it says.
void close_seams(const HemicubeSource& source) noexcept {
  uint64_t sum = 0;
  uint16_t greatest = 0;
  for (uint16_t k = 0; k < source.scene->patch_count; ++k) {
    sum += source.visible_uq32[k];
    if (source.visible_uq32[k] > source.visible_uq32[greatest]) greatest = k;
  }
  const int64_t missing = (int64_t{1} << 32) - int64_t(sum);
  if (magnitude(missing) >= uint64_t{1} << 24 ||
      int64_t{source.visible_uq32[greatest]} + missing > 0xFFFFFFFF)
    return;
  source.visible_uq32[greatest] += uint32_t(missing);
}

}  // namespace

}  // namespace raster

Status hemicube_init(HemicubeSource* source, const urad_scene* scene, const HemicubeTable& table,
                     uint16_t rows, uint8_t flags, void* memory, size_t bytes,
                     urad_counters* counters) noexcept {
  if (!source || !scene || !table.top || !table.side || !memory || !counters)
    return Status::bad_argument;
  const uint16_t resolution = table.resolution;
  if (resolution < kHemicubeMinResolution || resolution > kHemicubeMaxResolution ||
      (resolution & 1)) {
    return Status::bad_argument;
  }
  if (rows > resolution || (rows == 0 && !(scene->flags & URAD_SCENE_CONVEX)))
    return Status::bad_argument;

  uint16_t corners = 4;
  for (uint16_t s = 0; s < scene->surface_count; ++s) {
    const urad_surface& surface = scene->surface[s];
    for (uint16_t k = 0; !surface.grid && k < surface.patch_count; ++k) {
      if (surface.polygon[k].vertex_count > corners) corners = surface.polygon[k].vertex_count;
    }
  }
  for (uint16_t b = 0; b < scene->blocker_count; ++b) {
    if (scene->blocker[b].vertex_count > corners) corners = scene->blocker[b].vertex_count;
  }
  const bool coverage = flags & hemicube_coverage;
  if (bytes < hemicube_bytes(resolution, rows, scene->patch_count, coverage, corners))
    return Status::out_of_memory;
  if (reinterpret_cast<uintptr_t>(memory) & 3u) return Status::out_of_memory;

  uint32_t* next = static_cast<uint32_t*>(memory);
  const auto take = [&next](size_t words) {
    uint32_t* const start = next;
    next += words;
    return start;
  };
  const size_t cells = size_t{rows} * resolution, mask_rows = rows ? rows : resolution;
  HemicubeSource s{scene,   table,   rows,    flags,   -1,      nullptr, nullptr,
                   nullptr, nullptr, nullptr, nullptr, corners, counters};
  s.visible_uq32 = take(scene->patch_count);
  if (coverage) s.coverage_uq32 = take(scene->patch_count);
  s.depth = take(cells);
  s.mask = take(mask_rows * ((size_t{resolution} + 31) >> 5));
  s.corner = reinterpret_cast<urad_point*>(take(size_t{3} * corners));
  s.item = reinterpret_cast<uint16_t*>(next);
  for (uint32_t* p = s.mask; p != reinterpret_cast<uint32_t*>(s.corner); ++p) *p = 0;
  for (size_t k = 0; k < cells; ++k) s.depth[k] = 0, s.item[k] = kNoItem;
  *source = s;
  return Status::ok;
}

Status hemicube_items(HemicubeSource* source, uint16_t shooter, int face,
                      uint16_t first_row) noexcept {
  if (!source || source->rows == 0 || shooter >= source->scene->patch_count || face < 0 ||
      face > 4 || first_row >= source->table.resolution) {
    return Status::bad_argument;
  }
  source->shooter = -1;
  source->used = true;
  const int end = first_row + source->rows, resolution = source->table.resolution;
  for (int k = 0; k < source->rows * resolution; ++k)
    source->depth[k] = 0, source->item[k] = kNoItem;
  raster::Walk walk = raster::walk_from(*source, shooter);
  walk.first_face = face, walk.end_face = face + 1;
  walk.first_row = first_row, walk.end_row = end < resolution ? end : resolution;
  walk.run();
  return Status::ok;
}

Status hemicube_render(HemicubeSource* source, uint16_t shooter) noexcept {
  if (!source || shooter >= source->scene->patch_count) return Status::bad_argument;
  if (source->shooter == shooter) return Status::ok;
  const int resolution = source->table.resolution;
  const bool all_rows = source->flags & hemicube_all_rows;
  for (uint16_t k = 0; k < source->scene->patch_count; ++k) {
    source->visible_uq32[k] = 0;
    if (source->coverage_uq32) source->coverage_uq32[k] = 0;
  }
  for (int k = 0; source->used && k < source->rows * resolution; ++k)
    source->depth[k] = 0, source->item[k] = kNoItem;
  source->used = false;

  const int eyes = source->flags & hemicube_four_eyes ? 4 : 1;
  unsigned drawn = 0;
  for (int eye = 0; eye < eyes; ++eye) {
    raster::Walk walk = raster::walk_from(*source, shooter, eye, eyes);
    if (source->rows == 0) {
      walk.run();
    } else {
      for (int face = 0; face < 5; ++face) {
        walk.first_face = face, walk.end_face = face + 1;
        for (int row = face == 0 ? 0 : resolution >> 1; row < resolution; row += source->rows) {
          walk.first_row = row;
          walk.end_row = row + source->rows < resolution ? row + source->rows : resolution;
          const raster::Band band{face, walk.first_row, walk.end_row};
          walk.touched = {face, band.end, band.first};
          walk.run();
          if (all_rows) walk.touched = band, walk.drawn |= 1u << face;
          const int rows =
              walk.touched.end > walk.touched.first ? walk.touched.end - walk.touched.first : 0;
          if (rows) raster::harvest(*source, band, walk.touched);
          source->counters->rows += uint32_t(rows);
          source->counters->rows_empty += uint32_t(band.end - band.first - rows);
        }
      }
    }
    drawn |= walk.drawn;
  }
  for (int face = 0; face < 5; ++face)
    ++(drawn >> face & 1u ? source->counters->faces : source->counters->faces_empty);
  if (source->scene->flags & URAD_SCENE_CLOSED) raster::close_seams(*source);
  if (source->rows == 0 && source->coverage_uq32) {
    for (uint16_t k = 0; k < source->scene->patch_count; ++k)
      source->coverage_uq32[k] = source->visible_uq32[k];
  }
  source->shooter = shooter;
  return Status::ok;
}

urad_status hemicube_fill(void* hemicube_source, uint16_t shooter, uint16_t surface, uint16_t first,
                          uint16_t count, uint32_t* f_uq32) noexcept {
  HemicubeSource* source = static_cast<HemicubeSource*>(hemicube_source);
  if (!source || !f_uq32 || surface >= source->scene->surface_count) return URAD_BAD_ARGUMENT;
  const urad_surface& receivers = source->scene->surface[surface];
  if (first < receivers.first_patch ||
      first + count > receivers.first_patch + receivers.patch_count) {
    return URAD_BAD_ARGUMENT;
  }
  const Status status = hemicube_render(source, shooter);
  if (status != Status::ok) return urad_status(status);
  const bool own =
      shooter >= receivers.first_patch && shooter < receivers.first_patch + receivers.patch_count;
  const bool same = own && (receivers.flags & URAD_SURFACE_PLANAR);
  for (uint16_t k = 0; k < count; ++k) {
    f_uq32[k] = source->visible_uq32[first + k];
    if (first + k != shooter)
      ++(same ? source->counters->skipped_same : source->counters->evaluated);
  }
  return URAD_OK;
}

}  // namespace urad
