#include "report/smooth.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.hpp"
#include "hand_made_scene.hpp"

namespace {

using host::CornerMesh;
using host::Facet;
using host::Scene;
using host::Vec3;

constexpr unsigned kSeed = 1996;

std::vector<Vec3> random_radiosity(const Scene& scene) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> b(scene.patches.size());
  for (Vec3& value : b) value = {unit(random), unit(random), unit(random)};
  return b;
}

/// A scene of one surface made of the given polygons.
Scene of_polygons(const std::vector<host::Polygon>& polygons, bool planar) {
  Scene scene;
  scene.materials.resize(1);
  host::Surface surface;
  surface.patch_count = int(polygons.size());
  surface.planar = planar;
  scene.surfaces.push_back(surface);
  for (const host::Polygon& polygon : polygons)
    scene.patches.push_back({polygon, host::moments(polygon), 0});
  return scene;
}

TEST_CASE("a grid of n x n patches has (n+1)^2 corners, and walls share none") {
  for (const int n : {1, 2, 7}) {
    const Scene scene = test::cube(n);
    const CornerMesh mesh = host::merge_corners(scene);
    CHECK(mesh.vertex.size() == std::size_t(6 * (n + 1) * (n + 1)));
    CHECK(mesh.facets.size() == scene.patches.size());
    CHECK(mesh.first.back() == 4 * scene.patches.size());
  }
}

TEST_CASE("corner colours are means over the patches that meet there") {
  const Scene scene = test::cube(3);
  const CornerMesh mesh = host::merge_corners(scene);
  const std::vector<Vec3> b = random_radiosity(scene);
  const std::vector<Vec3> colour = host::smooth_colours(scene, mesh, b);
  const std::size_t* corner = &mesh.corner[mesh.first[4]];  // the middle patch of the first wall
  CHECK(glm::distance(colour[corner[0]], (b[0] + b[1] + b[3] + b[4]) / 4.0) < 1e-15);
  CHECK(glm::distance(colour[corner[2]], (b[4] + b[5] + b[7] + b[8]) / 4.0) < 1e-15);
  const std::size_t* first = &mesh.corner[mesh.first[0]];
  CHECK(glm::distance(colour[first[0]], b[0]) < 1e-15);
  CHECK(glm::distance(colour[first[1]], (b[0] + b[1]) / 2.0) < 1e-15);

  const std::vector<Vec3> even(scene.patches.size(), Vec3(0.3, 0.2, 0.1));
  for (const Vec3& c : host::smooth_colours(scene, mesh, even))
    CHECK(glm::distance(c, even[0]) < 1e-15);
}

TEST_CASE("unequal patches count by their area") {
  const host::Polygon small{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}};
  const host::Polygon large{{{1, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}}, {}};
  const Scene scene = of_polygons({small, large}, true);
  const CornerMesh mesh = host::merge_corners(scene);
  CHECK(mesh.vertex.size() == 6);
  const std::vector<Vec3> colour = host::smooth_colours(scene, mesh, {Vec3(1), Vec3(5)});
  CHECK(colour[mesh.corner[mesh.first[0] + 1]].x == doctest::Approx((1 * 1 + 3 * 5) / 4.0));
}

TEST_CASE(
    "polygon lists find the grid's corners again, turned, at any scale, with rounded coordinates") {
  Scene scene = test::cube(7);
  const std::vector<Vec3> b = random_radiosity(scene);
  const CornerMesh grid = host::merge_corners(scene);
  const std::vector<Vec3> expected = host::smooth_colours(scene, grid, b);
  for (const double scale : {1e-12, 1.0, 1e12}) {
    CAPTURE(scale);
    Scene list = scene;
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<double> rounding(-1e-6, 1e-6);
    const double c = std::cos(0.7), s = std::sin(0.7);
    for (host::Surface& surface : list.surfaces) surface.grid.reset();
    for (host::ScenePatch& patch : list.patches) {
      for (Vec3& x : patch.polygon.outer) {
        x += Vec3(rounding(random), rounding(random), rounding(random));
        x = scale * Vec3(c * x.x - s * x.y, s * x.x + c * x.y, x.z + 3);
      }
      patch.moments = host::moments(patch.polygon);
    }
    const CornerMesh mesh = host::merge_corners(list);
    REQUIRE(mesh.vertex.size() == grid.vertex.size());
    const std::vector<Vec3> colour = host::smooth_colours(list, mesh, b);
    double worst = 0;
    for (std::size_t k = 0; k < mesh.corner.size(); ++k)
      worst = std::max(worst, glm::distance(colour[mesh.corner[k]], expected[grid.corner[k]]));
    CHECK(worst < 2e-5);  // the rounding moves the weights: areas of (1/7)^2 by 1e-5 of themselves
  }
}

TEST_CASE("a surface is smoothed over gentle bends and not over creases") {
  const auto bent = [](double degrees) {
    const double c = std::cos(degrees * 0.0174532925199433),
                 s = std::sin(degrees * 0.0174532925199433);
    const host::Polygon left{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}};
    const host::Polygon right{{{1, 0, 0}, {1 + c, 0, s}, {1 + c, 1, s}, {1, 1, 0}}, {}};
    return host::merge_corners(of_polygons({left, right}, false)).vertex.size();
  };
  CHECK(bent(20) == 6);
  CHECK(bent(45) == 6);
  CHECK(bent(90) == 8);
}

TEST_CASE("colours are continuous across shared edges") {
  const Scene scene = test::cube(4);
  const CornerMesh mesh = host::merge_corners(scene);
  const std::vector<Vec3> colour = host::smooth_colours(scene, mesh, random_radiosity(scene));
  for (int k = 0; k < 3; ++k)
    for (int step = 0; step <= 8; ++step) {
      const double t = 0.125 * step;
      // Patches k and k + 1 of the first wall meet where u = 1 in one and u = 0 in the other.
      const Vec3 left = host::interpolate(mesh.facets[std::size_t(k)], colour, 1, t);
      const Vec3 right = host::interpolate(mesh.facets[std::size_t(k + 1)], colour, 0, t);
      CHECK(glm::distance(left, right) < 1e-15);
    }
}

TEST_CASE(
    "concave patches and holes are drawn as triangles of the same area that keep the corners") {
  host::Polygon concave{{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, {}};
  host::Polygon holed{{{5, 0, 0}, {9, 0, 0}, {9, 4, 0}, {5, 4, 0}},
                      {{{6, 1, 0}, {6, 3, 0}, {8, 3, 0}, {8, 1, 0}}}};
  const Scene scene = of_polygons({concave, holed}, true);
  const CornerMesh mesh = host::merge_corners(scene);
  CHECK(mesh.vertex.size() == 6 + 8);
  std::vector<Vec3> linear;  // a colour that is linear in position comes back exactly
  for (const Vec3& x : mesh.vertex) linear.push_back({x.x, x.y, 2 * x.x - x.y});
  double area[2] = {0, 0};
  for (const Facet& f : mesh.facets) {
    REQUIRE_FALSE(f.quad);
    const Vec3 a = mesh.vertex[f.vertex[0]], b = mesh.vertex[f.vertex[1]],
               c = mesh.vertex[f.vertex[2]];
    area[f.patch] += 0.5 * glm::cross(b - a, c - a).z;
    const Vec3 x = 0.5 * a + 0.3 * b + 0.2 * c;
    CHECK(glm::distance(host::interpolate(f, linear, 0.3, 0.2), {x.x, x.y, 2 * x.x - x.y}) < 1e-14);
  }
  CHECK(area[0] == doctest::Approx(5));
  CHECK(area[1] == doctest::Approx(12));
}

TEST_CASE("a solution of the wrong length is refused") {
  const Scene scene = test::cube(1);
  CHECK_THROWS_AS(host::smooth_colours(scene, host::merge_corners(scene), {Vec3(1)}), host::Error);
}

}  // namespace
