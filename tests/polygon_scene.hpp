// Scenes of single polygons in scene units and hemicubes over them, for tests of the item buffer.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "urad/hemicube.hpp"
#include "urad/hemicube_table.hpp"

namespace test {

using Vec = glm::dvec3;

inline Vec to_vec(const urad_point& p) { return {p.x, p.y, p.z}; }

/// A scene of single polygons, one surface each, owned by the test. Patch k is the k-th polygon
/// added.
class PolygonScene {
 public:
  explicit PolygonScene(uint16_t flags) { pod_.flags = flags; }

  /// A planar loop in scene units, counter-clockwise from the lit side.
  void add(const std::vector<Vec>& loop) {
    urad_polygon polygon{};
    polygon.shape.normal_q30 = normal_of(loop);
    polygon.first_vertex = uint32_t(vertices_.size());
    polygon.vertex_count = uint16_t(loop.size());
    Vec sum{0};
    for (const Vec& v : loop) {
      vertices_.push_back(
          {int32_t(std::lround(v.x)), int32_t(std::lround(v.y)), int32_t(std::lround(v.z))});
      sum += v;
    }
    sum /= double(loop.size());
    polygon.centroid = {int32_t(std::lround(sum.x)), int32_t(std::lround(sum.y)),
                        int32_t(std::lround(sum.z))};
    polygons_.push_back(polygon);
  }

  /// A blocker that belongs to no surface.
  void add_blocker(const std::vector<Vec>& loop) {
    urad_blocker blocker{};
    blocker.normal_q30 = normal_of(loop);
    blocker.first_vertex = uint32_t(vertices_.size());
    blocker.vertex_count = uint16_t(loop.size());
    blocker.surface = 0xFFFF;
    for (const Vec& v : loop) {
      vertices_.push_back(
          {int32_t(std::lround(v.x)), int32_t(std::lround(v.y)), int32_t(std::lround(v.z))});
    }
    blockers_.push_back(blocker);
  }

  const urad_scene& pod() {
    surfaces_.clear();
    for (size_t k = 0; k < polygons_.size(); ++k) {
      surfaces_.push_back({uint16_t(k), 1, 0, URAD_SURFACE_PLANAR, nullptr, &polygons_[k]});
    }
    pod_.abi = URAD_SCENE_ABI;
    pod_.patch_count = pod_.surface_count = uint16_t(polygons_.size());
    pod_.material_count = 1;
    pod_.material = &material_;
    pod_.surface = surfaces_.data();
    pod_.blocker_count = uint16_t(blockers_.size());
    pod_.blocker = blockers_.data();
    pod_.vertex_count = uint32_t(vertices_.size());
    pod_.vertex = vertices_.data();
    return pod_;
  }

 private:
  static urad_point normal_of(const std::vector<Vec>& loop) {
    Vec n{0};
    for (size_t k = 1; k + 1 < loop.size(); ++k)
      n += glm::cross(loop[k] - loop[0], loop[k + 1] - loop[0]);
    n = glm::normalize(n) * 0x1p30;
    return {int32_t(std::lround(n.x)), int32_t(std::lround(n.y)), int32_t(std::lround(n.z))};
  }

  urad_scene pod_{};
  urad_material material_{};
  std::vector<urad_polygon> polygons_;
  std::vector<urad_blocker> blockers_;
  std::vector<urad_surface> surfaces_;
  std::vector<urad_point> vertices_;
};

struct Tables {
  explicit Tables(int resolution) : top(size_t(resolution * resolution / 4)), side(top.size()) {
    std::vector<double> scratch(urad::hemicube_scratch(resolution));
    urad::fill_hemicube_cells(resolution, scratch.data(), top.data(), side.data());
    view = {uint16_t(resolution), top.data(), side.data()};
  }
  std::vector<uint32_t> top, side;
  urad::HemicubeTable view;
};

/// A hemicube with memory of exactly the size asked for.
struct Hemicube {
  Hemicube(const urad_scene& scene, const Tables& tables, uint16_t rows, uint8_t flags) {
    uint16_t vertices = 4;
    for (int s = 0; s < scene.surface_count; ++s) {
      const urad_surface& surface = scene.surface[s];
      for (int k = 0; surface.polygon && k < surface.patch_count; ++k) {
        vertices = std::max(vertices, surface.polygon[k].vertex_count);
      }
    }
    for (int b = 0; b < scene.blocker_count; ++b)
      vertices = std::max(vertices, scene.blocker[b].vertex_count);
    const size_t bytes = urad::hemicube_bytes(tables.view.resolution, rows, scene.patch_count,
                                              flags & urad::hemicube_coverage, vertices);
    memory.resize((bytes + 3) / 4);
    REQUIRE(urad::hemicube_init(&source, &scene, tables.view, rows, flags, memory.data(), bytes,
                                &counters) == urad::Status::ok);
  }
  std::vector<uint32_t> row(uint16_t shooter) {
    REQUIRE(urad::hemicube_render(&source, shooter) == urad::Status::ok);
    return {source.visible_uq32, source.visible_uq32 + source.scene->patch_count};
  }
  urad_counters counters{};
  std::vector<uint32_t> memory;
  urad::HemicubeSource source{};
};

}  // namespace test
