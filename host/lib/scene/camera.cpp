#include "scene/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/ray_scene.hpp"

namespace host {
namespace {

constexpr std::array<Vec3, 6> kViews = {Vec3(0, 0, -1), Vec3(0, 0, 1),  Vec3(-1, 0, 0),
                                        Vec3(1, 0, 0),  Vec3(0, -1, 0), Vec3(0, 1, 0)};
constexpr int kRaysPerSide = 16;

Vec3 up_of(const Vec3& view) { return view.y == 0 ? Vec3(0, 1, 0) : Vec3(0, 0, -1); }

// How many of a raster of parallel rays from outside the box meet a lit side first.
int lit_rays(const RayScene& rays, const Vec3& centre, const Vec3& half, const Vec3& view) {
  const Vec3 up = up_of(view), right = glm::cross(view, up);
  int lit = 0;
  for (int row = 0; row < kRaysPerSide; ++row)
    for (int column = 0; column < kRaysPerSide; ++column) {
      const double s = 2 * (column + 0.5) / kRaysPerSide - 1,
                   t = 2 * (row + 0.5) / kRaysPerSide - 1;
      const Vec3 start = centre + half * (s * right + t * up - 1.5 * view);
      const auto hit = rays.first_hit(start, view * glm::length(half), -1);
      if (hit && hit->front) ++lit;
    }
  return lit;
}

}  // namespace

Camera default_camera(const std::vector<Blocker>& polygons, bool closed) {
  Vec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const Blocker& blocker : polygons)
    for (const Vec3& x : blocker.polygon.outer) low = glm::min(low, x), high = glm::max(high, x);
  const Vec3 centre = 0.5 * (low + high), half = 0.5 * (high - low);

  Vec3 view = kViews[0];
  if (!closed) {
    const RayScene rays(polygons);
    int most = -1;
    for (const Vec3& candidate : kViews) {
      const int lit = lit_rays(rays, centre, half, candidate);
      if (lit > most) most = lit, view = candidate;
    }
  } else if (half.x > 1.5 * half.z) {
    view = kViews[2];  // along the length of the room
  }
  Camera camera;
  camera.up = up_of(view);
  camera.target = centre;
  const double depth = glm::dot(half, glm::abs(view));
  if (closed) {
    camera.field_of_view = 75;
    camera.eye = centre - 0.95 * depth * view;
  } else {
    camera.field_of_view = 40;
    const Vec3 across = half * (1.0 - glm::abs(view));
    const double widest = std::max({across.x, across.y, across.z});
    const double distance =
        1.05 * widest / std::tan(0.5 * camera.field_of_view * 3.14159265358979 / 180);
    camera.eye = centre - (depth + distance) * view;
  }
  return camera;
}

}  // namespace host
