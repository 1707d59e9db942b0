// The patches of a scene with each quantity in a row of its own, the way SIMD lanes load them.
#pragma once
#include <cstdint>
#include <vector>

#include "urad/scene.h"

namespace host {

/// What urad::pair_kernel() reads of a patch, and its repair. One row per quantity, patch by patch, and kPadding
/// copies of the last patch at the end, so that a vector may start at any patch.
class PatchLanes {
 public:
  static constexpr std::size_t kPadding = 64;  ///< greatest vector, in lanes of 32 bits
  enum Row {
    centroid = 0,    ///< 3 rows, scene units
    normal = 3,      ///< 3 rows, Q2.30
    spread = 6,      ///< 6 rows, Q0.15, in the order of urad_shape
    log2_area = 12,  ///< Q7.24
    log2_spread,     ///< Q7.24
    log2_scale,      ///< Q7.24, symmetric repair, 0 where the scene has none
    fill,            ///< Q0.15
    row_count
  };

  /// `scene` has passed scene_check().
  explicit PatchLanes(const urad_scene& scene);

  const std::int32_t* row(int row) const { return values_.data() + std::size_t(row) * stride_; }

 private:
  std::size_t stride_;
  std::vector<std::int32_t> values_;
};

}  // namespace host
