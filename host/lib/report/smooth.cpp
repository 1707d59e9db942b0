#include "report/smooth.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "base/error.hpp"
#include "geometry/triangulate.hpp"

namespace host {
namespace {

constexpr double kToleranceOfEdge = 1e-4;  // files carry 5 or more digits
constexpr double kCreaseCosine = 0.5;      // 60 degrees

using Key = std::array<std::int64_t, 3>;

template <class Function>
void for_each_corner(const Polygon& polygon, Function&& fn) {
  for (const Vec3& x : polygon.outer) fn(x);
  for (const Loop& hole : polygon.holes)
    for (const Vec3& x : hole) fn(x);
}

double shortest_edge(const Scene& scene, const Surface& surface) {
  double shortest = std::numeric_limits<double>::infinity();
  const auto scan = [&](const Loop& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const double length = glm::distance(loop[k], loop[(k + 1) % loop.size()]);
      if (length > 0 && length < shortest) shortest = length;
    }
  };
  for (int k = 0; k < surface.patch_count; ++k) {
    const Polygon& polygon = scene.patches[std::size_t(surface.first_patch + k)].polygon;
    scan(polygon.outer);
    for (const Loop& hole : polygon.holes) scan(hole);
  }
  return std::isfinite(shortest) ? shortest : 1;
}

/// Vertices of one surface, found by lattice index (grid) or by position (list).
class Merger {
 public:
  Merger(const Scene& scene, const Surface& surface, std::vector<Vec3>* vertices)
      : surface_(surface), vertices_(*vertices) {
    if (surface.grid) return;
    tolerance_ = kToleranceOfEdge * shortest_edge(scene, surface);
    if (surface.patch_count > 0)
      origin_ = scene.patches[std::size_t(surface.first_patch)].moments.centroid;
  }

  std::size_t add(const Vec3& x, const Vec3& normal) {
    return surface_.grid ? add_lattice(x) : add_position(x, normal);
  }

 private:
  struct Candidate {
    std::size_t vertex;
    Vec3 normal;
  };

  std::size_t create(const Key& key, const Vec3& x, const Vec3& normal) {
    vertices_.push_back(x);
    cells_[key].push_back({vertices_.size() - 1, normal});
    return vertices_.size() - 1;
  }

  std::size_t add_lattice(const Vec3& x) {
    const Grid& g = *surface_.grid;
    const Vec3 d = x - g.origin;
    const double uu = glm::dot(g.step_u, g.step_u), vv = glm::dot(g.step_v, g.step_v);
    const double uv = glm::dot(g.step_u, g.step_v), det = uu * vv - uv * uv;
    const double du = glm::dot(d, g.step_u), dv = glm::dot(d, g.step_v);
    const Key key{std::llround((du * vv - dv * uv) / det), std::llround((dv * uu - du * uv) / det),
                  0};
    const auto found = cells_.find(key);
    return found == cells_.end() ? create(key, x, Vec3(0)) : found->second.front().vertex;
  }

  std::size_t add_position(const Vec3& x, const Vec3& normal) {
    // Cells twice the tolerance wide: a match lies in the point's own cell or in one next to it.
    const Vec3 at = (x - origin_) / (2 * tolerance_);
    const Key home{std::llround(at.x), std::llround(at.y), std::llround(at.z)};
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = cells_.find({home[0] + i, home[1] + j, home[2] + k});
          if (found == cells_.end()) continue;
          for (const Candidate& c : found->second)
            if (glm::distance(vertices_[c.vertex], x) <= tolerance_ &&
                (surface_.planar || glm::dot(c.normal, normal) >= kCreaseCosine))
              return c.vertex;
        }
    return create(home, x, normal);
  }

  const Surface& surface_;
  std::vector<Vec3>& vertices_;
  double tolerance_ = 0;
  Vec3 origin_{0};
  std::map<Key, std::vector<Candidate>> cells_;
};

/// The corner of `patch` at a point that triangulate() copied from it.
std::size_t corner_at(const CornerMesh& mesh, std::size_t patch, const Loop& corners,
                      const Vec3& x) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < corners.size(); ++k)
    if (glm::distance(corners[k], x) < glm::distance(corners[best], x)) best = k;
  return mesh.corner[mesh.first[patch] + best];
}

void add_facets(const ScenePatch& patch, std::size_t number, CornerMesh* mesh) {
  if (is_convex_quad(patch.polygon)) {
    const std::size_t* c = &mesh->corner[mesh->first[number]];
    mesh->facets.push_back({{c[0], c[1], c[2], c[3]}, number, true});
    return;
  }
  Loop corners;
  for_each_corner(patch.polygon, [&](const Vec3& x) { corners.push_back(x); });
  for (const Triangle& t : triangulate(patch.polygon)) {
    const std::size_t last = corner_at(*mesh, number, corners, t[2]);
    mesh->facets.push_back({{corner_at(*mesh, number, corners, t[0]),
                             corner_at(*mesh, number, corners, t[1]), last, last},
                            number,
                            false});
  }
}

}  // namespace

CornerMesh merge_corners(const Scene& scene) {
  CornerMesh mesh;
  mesh.first.push_back(0);
  for (const Surface& surface : scene.surfaces) {
    Merger merger(scene, surface, &mesh.vertex);
    for (int k = 0; k < surface.patch_count; ++k) {
      const std::size_t number = std::size_t(surface.first_patch + k);
      const ScenePatch& patch = scene.patches[number];
      for_each_corner(patch.polygon, [&](const Vec3& x) {
        mesh.corner.push_back(merger.add(x, patch.moments.normal));
      });
      mesh.first.push_back(mesh.corner.size());
      add_facets(patch, number, &mesh);
    }
  }
  return mesh;
}

std::vector<Vec3> smooth_colours(const Scene& scene, const CornerMesh& mesh,
                                 const std::vector<Vec3>& radiosity) {
  if (radiosity.size() != scene.patches.size())
    throw Error(fmt::format("scene {}: {} patches, but the solution holds {} radiosities",
                            scene.name, scene.patches.size(), radiosity.size()));
  std::vector<Vec3> colour(mesh.vertex.size(), Vec3(0));
  std::vector<double> weight(mesh.vertex.size(), 0);
  for (std::size_t patch = 0; patch < radiosity.size(); ++patch) {
    const double area = scene.patches[patch].moments.area;
    for (std::size_t k = mesh.first[patch]; k < mesh.first[patch + 1]; ++k) {
      colour[mesh.corner[k]] += area * radiosity[patch];
      weight[mesh.corner[k]] += area;
    }
  }
  for (std::size_t k = 0; k < colour.size(); ++k)
    if (weight[k] > 0) colour[k] /= weight[k];
  return colour;
}

}  // namespace host
