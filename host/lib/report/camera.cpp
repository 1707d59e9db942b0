#include "report/camera.hpp"

#include <cmath>
#include <numbers>

namespace host {

Bounds bounds_of(const Scene& scene) {
  Bounds bounds;
  for (const ScenePatch& patch : scene.patches)
    for (const Vec3& x : patch.polygon.outer) bounds.add(x);
  for (const Blocker& blocker : scene.blockers)
    for (const Vec3& x : blocker.polygon.outer) bounds.add(x);
  return bounds;
}

Camera camera_of(const Scene& scene) {
  Camera camera = scene.camera;
  if (camera.eye != camera.target) return camera;
  const Bounds bounds = bounds_of(scene);
  const Vec3 from = glm::normalize(Vec3(0.45, 0.4, 1));
  const double half = glm::radians(0.5 * camera.field_of_view);
  camera.target = bounds.middle();
  camera.eye = bounds.middle() + 1.02 * bounds.radius() / std::sin(half) * from;
  return camera;
}

bool outside_room(const CornerMesh& mesh, const Vec3& eye) {
  double solid_angle = 0;  // positive for patches that show their lit side
  const auto add = [&](std::size_t i, std::size_t j,
                       std::size_t k) {  // [Van Oosterom, Strackee 1983]
    const Vec3 a = mesh.vertex[i] - eye, b = mesh.vertex[j] - eye, c = mesh.vertex[k] - eye;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = glm::dot(a, glm::cross(b, c));
    const double rest =
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
    if (volume != 0 || rest != 0) solid_angle -= 2 * std::atan2(volume, rest);
  };
  for (const Facet& f : mesh.facets) {
    add(f.vertex[0], f.vertex[1], f.vertex[2]);
    if (f.quad) add(f.vertex[0], f.vertex[2], f.vertex[3]);
  }
  return solid_angle < 2 * std::numbers::pi;
}

}  // namespace host
