// Rays against polygons, by Embree: visibility truth, closedness and pictures.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "scene/scene.hpp"

namespace host {

/// Any planar polygons, opaque from both sides. Queries may run from many threads at once.
class RayScene {
 public:
  struct Hit {
    double distance;      ///< in lengths of the direction
    std::size_t polygon;  ///< index into the polygons given
    bool front;           ///< the lit side was hit
  };

  /// Coordinates are brought to a unit box around the polygons, so that single precision is
  /// relative to the scene.
  explicit RayScene(const std::vector<Blocker>& polygons);

  /// First polygon met by origin + t direction, t > 0, polygons of `skip_surface` and those whose
  /// plane holds the origin left out. Of a two-sided sheet, two polygons back to back, the lit side.
  std::optional<Hit> first_hit(const Vec3& origin, const Vec3& direction, int skip_surface) const;

  /// Whether anything stands between a and b, polygons of the two surfaces left out, and those whose
  /// plane holds a or b to 1e-6 of the scene: a segment that ends on a plane cannot cross it.
  bool blocked(const Vec3& a, const Vec3& b, int surface_a, int surface_b) const;

  struct Tables;

 private:
  std::shared_ptr<const Tables> tables_;
};

}  // namespace host
