#include "urad/pose_table.hpp"

#include "urad/patch.hpp"

namespace urad {

namespace {

struct Place {
  uint16_t u, v;
};

Place place_of(const urad_scene& scene, const urad_surface& surface, uint16_t patch) noexcept {
  if (patch == surface.first_patch) return {0, 0};
  if (!surface.grid) return {uint16_t(patch - surface.first_patch), 0};
  const Patch found = patch_at(scene, patch);
  return {found.u, found.v};
}

/// Position of the receiver's place 0 along an axis.
int32_t start_of(const urad_pose_axis& axis, const uint16_t* shooter) noexcept {
  return axis.offset + axis.from_u * shooter[0] + axis.from_v * shooter[1];
}

int32_t mirrored(int32_t position, uint8_t mirror) noexcept {
  if (position >= 0 || mirror == URAD_POSE_PLAIN) return position;
  return mirror == URAD_POSE_ABOUT_0 ? -position : ~position;
}

/// count >= 1 values from value[at] on.
[[gnu::always_inline]] inline void load(const uint32_t* value, int32_t at, int32_t stride,
                                        uint32_t count, uint32_t* f_uq32) noexcept {
  const uint32_t* const end = f_uq32 + count;
  for (value += at;; value += stride) {
    *f_uq32++ = *value;
    if (f_uq32 == end) return;  // before value leaves the table
  }
}

/// A run within one row of receivers: down to the mirror, then up from it.
void load_row(const uint32_t* value, int32_t at, const urad_pose_axis& axis, uint8_t mirror,
              int32_t position, uint32_t count, uint32_t* f_uq32) noexcept {
  if (position < 0 && mirror != URAD_POSE_PLAIN) {
    const uint32_t before = uint32_t(-position), falling = before < count ? before : count;
    load(value, at + mirrored(position, mirror) * axis.stride, -axis.stride, falling, f_uq32);
    position += int32_t(falling);
    f_uq32 += falling;
    count -= falling;
  }
  if (count) load(value, at + position * axis.stride, axis.stride, count, f_uq32);
}

/// Nothing to load: why, and the zeros.
urad_status no_light(PoseSource* source, uint16_t shooter, uint16_t surface, uint16_t first,
                     uint16_t count, uint32_t* f_uq32) noexcept {
  urad_counters& counters = *source->counters;
  if (source->surface == surface) {
    counters.skipped_same += count - uint32_t(shooter >= first && shooter - first < count);
  } else {
    counters.skipped_facing += count;
  }
  for (uint16_t k = 0; k < count; ++k) f_uq32[k] = 0;
  return URAD_OK;
}

void find_shooter(PoseSource* source, uint16_t shooter) noexcept {
  const urad_scene& scene = *source->scene;
  source->shooter = shooter;
  source->surface = surface_of(scene, shooter);
  const Place place = place_of(scene, scene.surface[source->surface], shooter);
  source->place[0] = place.u;
  source->place[1] = place.v;
}

}  // namespace

urad_status pose_fill(void* pose_source, uint16_t shooter, uint16_t surface, uint16_t first,
                      uint16_t count, uint32_t* f_uq32) noexcept {
  auto* const source = static_cast<PoseSource*>(pose_source);
  const urad_pose_table& table = *source->table;
  if (shooter != source->shooter) find_shooter(source, shooter);
  const uint32_t block_at =
      table.block_of[uint32_t{source->surface} * table.surface_count + surface];
  if (block_at == URAD_POSE_NO_BLOCK)
    return no_light(source, shooter, surface, first, count, f_uq32);

  const urad_surface& to = source->scene->surface[surface];
  const urad_pose_block& block = table.block[block_at];
  const uint16_t* const from = source->place;
  const int32_t base =
      int32_t(block.first) + from[0] * block.from_stride[0] + from[1] * block.from_stride[1];
  const int32_t x = start_of(block.axis[0], from), y = start_of(block.axis[1], from);
  const uint32_t width = to.grid ? to.grid->count_u : to.patch_count;
  Place at = place_of(*source->scene, to, first);
  for (uint32_t left = count, run; left; left -= run) {
    run = width - at.u < left ? width - at.u : left;
    const int32_t row = mirrored(y + at.v, block.mirror[1]) * block.axis[1].stride;
    load_row(table.value_uq32, base + row, block.axis[0], block.mirror[0], x + at.u, run, f_uq32);
    f_uq32 += run;
    at = {0, uint16_t(at.v + 1)};
  }
  const uint32_t pairs = count - uint32_t(shooter >= first && shooter - first < count);
  source->counters->evaluated += pairs;
  source->counters->poses += pairs;
  return URAD_OK;
}

}  // namespace urad
