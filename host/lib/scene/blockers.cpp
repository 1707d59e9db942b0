#include "scene/blockers.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "base/parallel.hpp"
#include "scene/ray_scene.hpp"
#include "scene/sample.hpp"

namespace host {
namespace {

constexpr double kSideTolerance = 1e-5;  // of the distance: what six printed decimals leave open

// Every corner once: neighbours share them.
std::vector<Vec3> corners(const Scene& scene) {
  std::vector<Vec3> points;
  for (const ScenePatch& patch : scene.patches)
    points.insert(points.end(), patch.polygon.outer.begin(), patch.polygon.outer.end());
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

bool has_both_sides(const Polygon& polygon, const std::vector<Vec3>& points) {
  const Moments plane = moments(polygon);
  double rounding = 0;  // of the coordinates themselves
  for (const Vec3& x : polygon.outer) rounding = std::max(rounding, glm::length(x));
  rounding *= 16 * std::numeric_limits<double>::epsilon();
  bool before = false, behind = false;
  for (const Vec3& x : points) {
    const Vec3 d = x - plane.centroid;
    const double height = glm::dot(plane.normal, d);
    const double tolerance = kSideTolerance * glm::length(d) + rounding;
    before = before || height > tolerance;
    behind = behind || height < -tolerance;
    if (before && behind) return true;
  }
  return false;
}

// The same for both sides of a sheet.
std::vector<std::array<double, 3>> sorted_corners(const Polygon& polygon) {
  std::vector<std::array<double, 3>> corners;
  const auto add = [&](const Loop& loop) {
    for (const Vec3& x : loop) corners.push_back({x.x, x.y, x.z});
  };
  add(polygon.outer);
  for (const Loop& hole : polygon.holes) add(hole);
  std::sort(corners.begin(), corners.end());
  return corners;
}

// Cosine-weighted direction about the normal.
Vec3 hemisphere(const Vec3& normal, double s, double t) {
  const Vec3 other = std::abs(normal.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 x = glm::normalize(glm::cross(normal, other));
  const Vec3 y = glm::cross(normal, x);
  const double radius = std::sqrt(s), angle = 2 * std::numbers::pi * t;
  return radius * (std::cos(angle) * x + std::sin(angle) * y) + std::sqrt(1 - s) * normal;
}

}  // namespace

std::vector<Blocker> find_blockers(const Scene& scene, const std::vector<Blocker>& polygons) {
  const std::vector<Vec3> points = corners(scene);
  std::vector<char> blocks(polygons.size());
  parallel_for(polygons.size(), 0,
               [&](std::size_t k) { blocks[k] = has_both_sides(polygons[k].polygon, points); });
  std::vector<Blocker> found;
  std::set<std::vector<std::array<double, 3>>> known;
  for (std::size_t k = 0; k < polygons.size(); ++k)
    if (blocks[k] && known.insert(sorted_corners(polygons[k].polygon)).second)
      found.push_back(polygons[k]);
  return found;
}

bool is_closed(const Scene& scene, const std::vector<Blocker>& polygons) {
  const RayScene rays(polygons);
  const auto count = std::uint32_t(std::clamp<std::size_t>(
      (std::size_t{1} << 20) / std::max<std::size_t>(scene.patches.size(), 1), 16, 256));
  std::atomic<bool> open{false};
  parallel_for(scene.patches.size(), 0, [&](std::size_t k) {
    const ScenePatch& patch = scene.patches[k];
    const PolygonSampler point(patch.polygon);
    for (std::uint32_t ray = 0; ray < count && !open; ++ray) {
      const Vec3 origin = point((ray + 0.5) / count, radical_inverse(ray + 1, 2));
      const Vec3 direction = hemisphere(patch.moments.normal, radical_inverse(ray + 1, 3),
                                        radical_inverse(ray + 1, 5));
      const auto hit = rays.first_hit(origin, direction, patch.surface);
      if (!hit || !hit->front) open = true;
    }
  });
  return !open;
}

}  // namespace host
