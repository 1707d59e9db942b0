// The engine's view of a host scene: owns the tables a urad_scene points to.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/scene.hpp"
#include "urad/scene.h"

namespace host {

/// Codes of a urad_visibility (scene.h), a row a patch.
struct VisibilityTables {
  std::uint8_t bits = 4;
  std::vector<std::uint32_t> row;
  std::vector<std::uint8_t> code;
  std::size_t bytes() const { return 16 + 4 * row.size() + code.size(); }  ///< of flash
};

/// Converts to scene units (|coordinate| <= 2^29; centred, scaled by a power of two) and chooses
/// the units of exitance and power, powers of two, so that neither overflows: total emitted power /
/// (1 - largest reflectance) and brightest exitance / (1 - largest reflectance) stay at or below
/// 2^30 (1 - reflectance counts as 1/256 at least). Throws Error for a scene without patches or
/// size, a patch without area, polygons of more than 64 vertices.
class FixedScene {
 public:
  explicit FixedScene(const Scene& scene);
  const urad_scene& pod() const;
  double units_per_length() const;  ///< scene units per unit of the file
  double exitance_unit() const;     ///< file exitance per integer exitance
  /// One d per patch, or none. Invalidates nothing but pod().log2_scale_q24. Throws Error on a
  /// wrong count. Symmetric repair: G' = d_i G d_j. Empty: none.
  void set_scale(const std::vector<double>& scale);
  /// Visible parts that go out with the scene, instead of rays. Invalidates nothing but
  /// pod().visibility. Throws Error on a wrong count of rows.
  void set_visibility(VisibilityTables tables);
  /// A single pair (or any list of polygons) without materials: patch k is polygons[k], one surface
  /// each.
  static FixedScene of_polygons(const std::vector<Polygon>& patches,
                                const std::vector<Polygon>& blockers);

 private:
  struct Tables;
  std::shared_ptr<Tables> tables_;
};

}  // namespace host
