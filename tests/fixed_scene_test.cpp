#include "scene/fixed_scene.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "base/error.hpp"
#include "scene/builtin.hpp"

using host::Vec3;

namespace {

Vec3 vec(const urad_point& p) { return {p.x, p.y, p.z}; }

urad_point centroid(const urad_grid& g, int u, int v) {
  const auto at = [&](int32_t o, int32_t su, int32_t sv) {
    return o + u * su + v * sv + su / 2 + sv / 2;
  };
  return {at(g.origin.x, g.step_u.x, g.step_v.x), at(g.origin.y, g.step_u.y, g.step_v.y),
          at(g.origin.z, g.step_u.z, g.step_v.z)};
}

void check_range(const urad_point& p) {
  for (const int32_t x : {p.x, p.y, p.z}) REQUIRE(std::abs(x) <= URAD_COORDINATE_MAX);
}

void check_shape(const urad_shape& shape, const host::Moments& m, double units) {
  const double trace = m.second[0][0] + m.second[1][1] + m.second[2][2];
  REQUIRE(std::abs(glm::length(vec(shape.normal_q30)) / 0x1p30 - 1) < 2e-9);
  REQUIRE(glm::length(vec(shape.normal_q30) / 0x1p30 - m.normal) < 2e-9);
  REQUIRE(std::exp2(shape.log2_area_q24 / 0x1p24) ==
          doctest::Approx(m.area * units * units).epsilon(3e-8));
  REQUIRE(std::exp2(shape.log2_spread_q24 / 0x1p24) ==
          doctest::Approx(trace * units * units).epsilon(3e-8));
  const double expected[6] = {m.second[0][0], m.second[1][1], m.second[2][2],
                              m.second[0][1], m.second[0][2], m.second[1][2]};
  for (int k = 0; k < 6; ++k)
    REQUIRE(std::abs(shape.spread_q15[k] - expected[k] / trace * 0x1p15) <= 1.0);
  REQUIRE(std::abs(shape.fill_uq15 - m.area / (m.area + 12 * trace) * 0x1p15) <= 0.5);
}

}  // namespace

TEST_CASE("every patch of both built-in scenes is where the host has it") {
  for (const char* name : {"cube7", "cornell"}) {
    CAPTURE(name);
    const host::Scene scene = host::load_scene(name);
    const host::FixedScene fixed(scene);
    const urad_scene& pod = fixed.pod();
    const double units = fixed.units_per_length();
    CHECK(std::exp2(std::round(std::log2(units))) == units);
    REQUIRE(pod.abi == (pod.bounds_count ? URAD_SCENE_ABI_SIGHT : URAD_SCENE_ABI));
    REQUIRE(pod.patch_count == scene.patches.size());
    REQUIRE(pod.surface_count == scene.surfaces.size());
    REQUIRE(pod.blocker_count == scene.blockers.size());
    CHECK(bool(pod.flags & URAD_SCENE_CONVEX) == scene.convex);
    CHECK(bool(pod.flags & URAD_SCENE_CLOSED) == scene.closed);
    CHECK(pod.log2_scale_q24 == nullptr);

    std::vector<Vec3> places;  // centroids in scene units
    for (std::size_t s = 0; s < pod.surface_count; ++s) {
      const urad_surface& surface = pod.surface[s];
      REQUIRE((surface.grid == nullptr) != (surface.polygon == nullptr));
      REQUIRE(surface.first_patch == places.size());
      REQUIRE((surface.flags & URAD_SURFACE_PLANAR) != 0);
      for (int k = 0; k < surface.patch_count; ++k) {
        const host::Moments& m = scene.patches[places.size()].moments;
        if (surface.grid) {
          check_shape(surface.grid->shape, m, units);
          places.push_back(
              vec(centroid(*surface.grid, k % surface.grid->count_u, k / surface.grid->count_u)));
        } else {
          const urad_polygon& polygon = surface.polygon[k];
          check_shape(polygon.shape, m, units);
          REQUIRE(polygon.first_vertex + polygon.vertex_count <= pod.vertex_count);
          places.push_back(vec(polygon.centroid));
        }
        check_range({int32_t(places.back().x), int32_t(places.back().y), int32_t(places.back().z)});
      }
    }
    REQUIRE(places.size() == scene.patches.size());
    const Vec3 shift = places[0] - units * scene.patches[0].moments.centroid;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Vec3 expected = units * scene.patches[k].moments.centroid + shift;
      REQUIRE(glm::length(places[k] - expected) < 32);  // of 2^30 across
    }
    for (std::size_t v = 0; v < pod.vertex_count; ++v) check_range(pod.vertex[v]);
    std::multiset<int> surfaces;  // the engine's blockers are in the order of their boxes
    for (const host::Blocker& blocker : scene.blockers) surfaces.insert(blocker.surface);
    for (std::size_t b = 0; b < pod.blocker_count; ++b) {
      const urad_blocker& blocker = pod.blocker[b];
      const auto found = surfaces.find(blocker.surface);
      REQUIRE(found != surfaces.end());
      surfaces.erase(found);
      for (uint32_t v = blocker.first_vertex; v < blocker.first_vertex + blocker.vertex_count;
           ++v) {
        const Vec3 x = vec(pod.vertex[v]);
        CHECK(glm::all(glm::lessThanEqual(vec(blocker.low), x)));
        CHECK(glm::all(glm::lessThanEqual(x, vec(blocker.high))));
      }
    }
  }
}

TEST_CASE("opposite walls and the two halves of a wall are mirror images, bit for bit") {
  const host::FixedScene fixed(host::load_scene("cube7"));
  const urad_surface* wall = fixed.pod().surface;
  const urad_grid &floor = *wall[0].grid, &ceiling = *wall[1].grid;
  for (int u = 0; u < 7; ++u)
    for (int v = 0; v < 7; ++v) {
      const urad_point a = centroid(floor, u, v), b = centroid(ceiling, v, u),
                       c = centroid(floor, 6 - u, 6 - v);
      CHECK(vec(a) == Vec3(b.x, -b.y, b.z));
      CHECK(vec(a) == Vec3(-c.x, c.y, -c.z));
    }
}

TEST_CASE("units leave room for all reflected light and use the range") {
  for (const double reflectance : {0.0, 0.5, 0.99, 1.0}) {
    CAPTURE(reflectance);
    host::Scene scene = host::load_scene("cube7");
    for (host::Material& m : scene.materials) m.reflectance = Vec3(reflectance);
    for (host::Material& m : scene.materials) m.exitance *= 12345.678;
    const host::FixedScene fixed(scene);
    const double gain = reflectance < 0.99 ? 1 / (1 - reflectance) : reflectance < 1 ? 100 : 256;
    int32_t exitance = 0;
    for (std::size_t k = 0; k < fixed.pod().material_count; ++k)
      exitance = std::max(exitance, fixed.pod().material[k].exitance[0]);
    CHECK(exitance * gain <= 0x1p30 * 1.0001);
    CHECK(exitance * gain > 0x1p28);
    CHECK(exitance * fixed.exitance_unit() == doctest::Approx(12345.678).epsilon(1e-6));
    const double area = fixed.units_per_length() * fixed.units_per_length();
    const double power = exitance * area * std::exp2(fixed.pod().log2_power_q24 / 0x1p24);
    CHECK(power * gain <= 0x1p30 * 1.0001);
    CHECK(power * gain > 0x1p26);  // a third of the sum of channels, a power of two below the limit
  }
}

TEST_CASE("scale and place do not change the bits that describe shape") {
  const auto polygons = [](double scale, const Vec3& shift) {
    std::vector<host::Polygon> all = {
        {{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 1, 0}}, {}},
        {{{0, 0, 3}, {0, 2, 3}, {2, 2, 3}, {2, 0, 3}}, {{{0.5, 0.5, 3}, {1, 0.5, 3}, {1, 1, 3}}}}};
    for (host::Polygon& p : all) {
      for (Vec3& x : p.outer) x = scale * (x + shift);
      for (host::Loop& hole : p.holes)
        for (Vec3& x : hole) x = scale * (x + shift);
    }
    return host::FixedScene::of_polygons(all, {});
  };
  const host::FixedScene a = polygons(1, Vec3(0)), b = polygons(0x1p-30, Vec3(8, -4, 16));
  REQUIRE(a.pod().surface_count == 2);
  REQUIRE(a.pod().vertex_count == b.pod().vertex_count);
  CHECK(a.pod().vertex_count == 4 + 4 + 3 + 2);  // a bridged hole repeats two vertices
  for (std::size_t v = 0; v < a.pod().vertex_count; ++v)
    CHECK(vec(a.pod().vertex[v]) == vec(b.pod().vertex[v]));
  for (std::size_t s = 0; s < 2; ++s) {
    const urad_shape &x = a.pod().surface[s].polygon[0].shape,
                     &y = b.pod().surface[s].polygon[0].shape;
    CHECK(x.log2_area_q24 == y.log2_area_q24);
    CHECK(std::abs(x.log2_spread_q24 - y.log2_spread_q24) <= 1);
    CHECK(x.fill_uq15 == y.fill_uq15);
  }
}

TEST_CASE("what the engine cannot hold is refused in words") {
  host::Polygon round;
  for (int k = 0; k < 65; ++k) round.outer.push_back({std::cos(k * 0.09), std::sin(k * 0.09), 0});
  CHECK_THROWS_WITH_AS(host::FixedScene::of_polygons({round}, {}), doctest::Contains("64"),
                       host::Error);
  CHECK_THROWS_AS(host::FixedScene::of_polygons({}, {}), host::Error);
  CHECK_THROWS_AS(host::FixedScene::of_polygons({{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {}}}, {}),
                  host::Error);
  host::FixedScene cube(host::load_scene("cube7"));
  CHECK_THROWS_WITH_AS(cube.set_scale({1, 2}), doctest::Contains("294"), host::Error);
  cube.set_scale(std::vector<double>(294, 2.0));
  REQUIRE(cube.pod().log2_scale_q24 != nullptr);
  CHECK(cube.pod().log2_scale_q24[293] == 1 << 24);
  cube.set_scale({});
  CHECK(cube.pod().log2_scale_q24 == nullptr);
}
