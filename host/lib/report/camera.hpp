// Where a picture is taken from.
#pragma once
#include <limits>

#include "report/smooth.hpp"

namespace host {

/// Axis-aligned bounds.
struct Bounds {
  Vec3 low{std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity()};
  void add(const Vec3& x) { low = glm::min(low, x), high = glm::max(high, x); }
  Vec3 middle() const { return 0.5 * (low + high); }
  double radius() const { return 0.5 * glm::distance(low, high); }
};

/// Bounds of all patches and blockers.
Bounds bounds_of(const Scene& scene);

/// The scene's camera, or one that frames the scene when eye and target are the same point.
Camera camera_of(const Scene& scene);

/// Whether `eye` stands outside the room, so that walls seen from behind must not hide it:
/// generalised winding number [Jacobson, Kavan, Sorkine-Hornung 2013] of the patches below 1/2.
bool outside_room(const CornerMesh& mesh, const Vec3& eye);

}  // namespace host
