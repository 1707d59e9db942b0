// The engine's view of a host scene: owns the tables a urad_scene points to.
#pragma once
#include <memory>

#include "scene/scene.hpp"
#include "urad/scene.h"

namespace host {

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
  /// A single pair (or any list of polygons) without materials: patch k is polygons[k], one surface
  /// each.
  static FixedScene of_polygons(const std::vector<Polygon>& patches,
                                const std::vector<Polygon>& blockers);

 private:
  struct Tables;
  std::shared_ptr<Tables> tables_;
};

}  // namespace host
