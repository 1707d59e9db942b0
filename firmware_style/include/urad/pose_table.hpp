// pose_table.hpp -- a source that loads form factors from a table of relative poses: no arithmetic
// of a pair is left.
#pragma once
#include "urad/pose_table.h"
#include "urad/source.h"
#include "urad/status.hpp"

namespace urad {

/// A source (source.h) of factors made on the host. Visibility and repair are in the values: the
/// scene's blockers and its log2_scale are not looked at. What it keeps of the last shooter saves
/// finding it again for every run.
struct PoseSource {
  const urad_scene* scene;
  const urad_pose_table* table;
  urad_counters* counters;     ///< never null
  uint16_t shooter = 0xFFFF;   ///< the last one; 0xFFFF: none yet
  uint16_t surface = 0;        ///< its surface
  uint16_t place[2] = {0, 0};  ///< its place on that surface
};

/// Walks the table once: that it belongs to a scene of this shape, and that no pair's factor lies
/// outside its values. Call it on data that is not trusted; the scene has passed scene_check().
Status pose_table_check(const urad_pose_table* table, const urad_scene* scene) noexcept;

/// urad_fill for a PoseSource: a load per factor. 5 instructions per receiver, 70 per row of
/// a grid and 200 per run on a Cortex-M0, counted.
urad_status pose_fill(void* pose_source, uint16_t shooter, uint16_t surface, uint16_t first,
                      uint16_t count, uint32_t* f_uq32) noexcept;

}  // namespace urad
