// The pose table of a scene: equal poses found, their factors by the reference, ready for the
// engine and for export.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pose/pose_layout.hpp"

namespace host {

/// Exchange of two patches of the scene as light meets it: occluded where `occluded` asks for it.
using PoseExchange = std::function<double(std::size_t i, std::size_t j, bool occluded)>;

class PoseTable {
 public:
  /// Factors are exchange / area of the shooter, rounded to UQ0.32.
  PoseTable(const Scene& scene, PoseLayout layout, const PoseExchange& exchange, int threads);
  /// Points into this object, which may be moved but not copied.
  const urad_pose_table& pod() const { return pod_; }
  const PoseLayout& layout() const { return layout_; }
  PoseTable(PoseTable&&) = default;
  PoseTable(const PoseTable&) = delete;

 private:
  PoseLayout layout_;
  std::vector<std::uint32_t> value_uq32_;
  urad_pose_table pod_{};
};

/// With the reference factor, times the visible fraction by `rays` pairs of points where blockers
/// may stand between. Throws Error above the limits of pose_layout().
PoseTable make_pose_table(const Scene& scene, const FixedScene& fixed, int threads,
                          int rays = 1024);

/// The table as a C99 and C++17 header of static const arrays; `urad_NAME_poses` is the
/// urad_pose_table. Same input, same bytes.
std::string poses_to_c(const PoseTable& table, const std::string& name, const std::string& command);

}  // namespace host
