#include "legacy/centre_hemicube.hpp"

#include <fmt/format.h>

#include <cmath>
#include <mutex>
#include <numbers>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "scene/ray_scene.hpp"

namespace host {

namespace {

struct Cell {
  Vec3 direction;  // x, y along the patch, z along its normal
  double delta;
};

/// Rows of cells of the five faces, one after the other.
std::vector<std::vector<Cell>> cells_of(int resolution) {
  std::vector<std::vector<Cell>> rows;
  const double step = 2.0 / resolution, area = step * step / std::numbers::pi;
  const auto middle = [&](int k) { return -1 + (k + 0.5) * step; };
  const auto delta = [&](const Vec3& d) {
    const double squared = glm::dot(d, d);
    return area * d.z / (squared * squared);
  };
  for (int v = 0; v < resolution; ++v) {
    auto& row = rows.emplace_back();
    for (int u = 0; u < resolution; ++u) {
      const Vec3 d(middle(u), middle(v), 1);
      row.push_back({d, delta(d)});
    }
  }
  for (int face = 0; face < 4; ++face) {
    for (int v = resolution / 2; v < resolution; ++v) {
      auto& row = rows.emplace_back();
      for (int u = 0; u < resolution; ++u) {
        const double side = face % 2 ? -1 : 1, along = middle(u), height = middle(v);
        const Vec3 d = face < 2 ? Vec3(side, along, height) : Vec3(along, side, height);
        row.push_back({d, delta(d)});
      }
    }
  }
  return rows;
}

}  // namespace

Eigen::MatrixXd centre_hemicube(const Scene& scene, int resolution, int threads,
                                HemicubeCount* count) {
  if (resolution < 2 || resolution % 2)
    throw Error(
        fmt::format("a hemicube's resolution should be even and above 1, not {}", resolution));
  const auto rows = cells_of(resolution);
  std::vector<Blocker> polygons;
  for (const ScenePatch& patch : scene.patches) polygons.push_back({patch.polygon, patch.surface});
  const RayScene rays(polygons);
  const auto n = Eigen::Index(scene.patches.size());
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(n, n);
  *count = {};
  for (const auto& row : rows)
    for (const Cell& cell : row) count->row_of_cells += cell.delta;
  std::mutex lock;
  parallel_for(scene.patches.size(), threads, [&](std::size_t i) {
    const ScenePatch& patch = scene.patches[i];
    const Vec3 z = patch.moments.normal;
    const Vec3 edge = patch.polygon.outer[1] - patch.polygon.outer[0];
    const Vec3 x = glm::normalize(edge - glm::dot(edge, z) * z), y = glm::cross(z, x);
    HemicubeCount own;
    for (const auto& row : rows) {
      std::size_t last = scene.patches.size();
      for (const Cell& cell : row) {
        ++own.rays;
        const Vec3& d = cell.direction;
        const auto hit =
            rays.first_hit(patch.moments.centroid, d.x * x + d.y * y + d.z * z, patch.surface);
        if (!hit || !hit->front) continue;
        f(Eigen::Index(i), Eigen::Index(hit->polygon)) += cell.delta;
        own.sums += hit->polygon != last;
        last = hit->polygon;
      }
    }
    const std::lock_guard<std::mutex> guard(lock);
    count->rays += own.rays;
    count->sums += own.sums;
  });
  return f;
}

}  // namespace host
