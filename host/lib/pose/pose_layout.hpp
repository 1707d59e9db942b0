// Which pairs of a scene share a factor, and where each lies in the table: everything but the
// factors themselves.
#pragma once
#include <cstdint>
#include <vector>

#include "scene/fixed_scene.hpp"
#include "scene/scene.hpp"
#include "urad/pose_table.h"

namespace host {

/// Larger tables are refused: 4 MiB of factors.
inline constexpr std::size_t kMostPoseValues = std::size_t{1} << 20;
inline constexpr std::size_t kMostPosePatches = 4096;

/// One of the factors of a table: from patch p to patch q of one pair that has it.
struct PoseFactor {
  std::uint16_t from = 0, to = 0;
  bool occluded = false;  ///< a blocker can stand between their surfaces: the pair shares with none
};

struct PoseLayout {
  std::size_t patches = 0, surfaces = 0;
  std::vector<std::uint16_t> block_of;
  std::vector<urad_pose_block> block;
  std::vector<std::uint32_t> factor_at;  ///< [values] index into factor
  std::vector<PoseFactor> factor;        ///< distinct ones; the first is "no light"
  std::size_t classes = 0;               ///< poses, reflections and both directions counted once
  double difference = 0;                 ///< bound on F between pairs that share a factor

  std::size_t values() const { return factor_at.size(); }
  /// Flash of the table on a 32-bit chip.
  std::size_t bytes() const;
};

/// Finds equal poses on the engine's scene. `scene` and `fixed` are the same scene. Throws Error
/// above the limits.
PoseLayout pose_layout(const Scene& scene, const FixedScene& fixed);

}  // namespace host
