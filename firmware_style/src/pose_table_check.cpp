#include "urad/pose_table.hpp"

namespace urad {

namespace {

/// Where factors can lie, both ends included. 64 bits: strides are judged before they are trusted.
struct Range {
  int64_t low, high;

  void add(int64_t first, int64_t last, int32_t stride) noexcept {
    const int64_t a = first * stride, b = last * stride;
    low += a < b ? a : b;
    high += a < b ? b : a;
  }
};

struct Size {
  int32_t count[2];
};

Size size_of(const urad_surface& surface) noexcept {
  if (surface.grid) return {{surface.grid->count_u, surface.grid->count_v}};
  return {{surface.patch_count, 1}};
}

/// Adds what axis k of the receiver spans. A mirrored axis spans from 0 to the longer side.
bool add_axis(const urad_pose_block& block, int k, const Size& from, const Size& to,
              Range* range) noexcept {
  const urad_pose_axis& axis = block.axis[k];
  int32_t low = axis.offset, high = axis.offset + to.count[k] - 1;
  for (int d = 0; d < 2; ++d) {
    const int32_t factor = d ? axis.from_v : axis.from_u, reach = from.count[d] - 1;
    if (factor < -1 || factor > 1) return false;
    (factor < 0 ? low : high) += factor * reach;
  }
  if (block.mirror[k] > URAD_POSE_ABOUT_HALF) return false;
  if (block.mirror[k] != URAD_POSE_PLAIN && low < 0) {
    const int32_t behind = block.mirror[k] == URAD_POSE_ABOUT_0 ? -low : ~low;
    high = behind > high ? behind : high;
    low = 0;
  }
  range->add(low, high, axis.stride);
  return true;
}

bool fits(const urad_pose_table& table, const urad_pose_block& block, const urad_surface& from,
          const urad_surface& to) noexcept {
  const Size shooters = size_of(from), receivers = size_of(to);
  Range range{block.first, block.first};
  for (int d = 0; d < 2; ++d) range.add(0, shooters.count[d] - 1, block.from_stride[d]);
  for (int k = 0; k < 2; ++k) {
    if (!add_axis(block, k, shooters, receivers, &range)) return false;
  }
  return range.low >= 0 && range.high < table.value_count;
}

}  // namespace

Status pose_table_check(const urad_pose_table* table, const urad_scene* scene) noexcept {
  if (!table || !scene) return Status::bad_argument;
  if (table->abi != URAD_POSE_TABLE_ABI || table->patch_count != scene->patch_count ||
      table->surface_count != scene->surface_count || !table->block_of ||
      (table->block_count && !table->block) || (table->value_count && !table->value_uq32) ||
      table->value_count > URAD_POSE_VALUES_MAX) {
    return Status::bad_scene;
  }
  for (uint32_t a = 0; a < scene->surface_count; ++a) {
    for (uint32_t b = 0; b < scene->surface_count; ++b) {
      const uint16_t at = table->block_of[a * scene->surface_count + b];
      if (at == URAD_POSE_NO_BLOCK) continue;
      if (at >= table->block_count ||
          !fits(*table, table->block[at], scene->surface[a], scene->surface[b])) {
        return Status::bad_scene;
      }
    }
  }
  return Status::ok;
}

}  // namespace urad
