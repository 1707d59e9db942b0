// Rays and blockers at the ends of their ranges: more blockers than a list holds, loops that turn
// back and forth, vertices given twice, rays along a blocker's plane.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "../firmware_style/src/visibility_block.hpp"
#include "../firmware_style/src/visibility_sample.hpp"
#include "hand_made_scene.hpp"
#include "polygon_scene.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/form_factor.hpp"
#include "urad/visibility.hpp"

using host::Polygon;
using host::Vec3;

namespace {

Polygon square(double half, double z, bool up, const Vec3& at = Vec3(0)) {
  Polygon result{{at + Vec3(-half, -half, z), at + Vec3(half, -half, z), at + Vec3(half, half, z),
                  at + Vec3(-half, half, z)},
                 {}};
  if (!up) std::swap(result.outer[1], result.outer[3]);
  return result;
}

/// Two squares that face each other, and what stands between them.
host::FixedScene between(const std::vector<Polygon>& blockers) {
  return host::FixedScene::of_polygons({square(1, 0, true), square(1, 4, false)}, blockers);
}

/// The same with walls that are grids: of those a source lists blockers for a whole run.
host::FixedScene walls(const std::vector<Polygon>& blockers) {
  host::Scene scene;
  test::add_wall(&scene, "below", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2, Vec3(0.5), Vec3(0));
  test::add_wall(&scene, "above", {-1, -1, 4}, {0, 2, 0}, {2, 0, 0}, 2, Vec3(0.5), Vec3(1));
  for (const Polygon& blocker : blockers) scene.blockers.push_back({blocker, -1});
  return host::FixedScene(scene);
}

/// The visible fraction of 256 rays, with every way of sparing tests or with none.
double fraction(const host::FixedScene& scene, bool reject) {
  urad_counters counters{};
  return urad::visible_fraction_uq16(scene.pod(), urad::patch_at(scene.pod(), 0),
                                     urad::patch_at(scene.pod(), 1), 256, true, &counters, reject) /
         65536.0;
}

}  // namespace

TEST_CASE("forty blockers are more than a list holds, and none is forgotten") {
  std::vector<Polygon> blockers;
  blockers.reserve(40);
  for (int k = 0; k < 40; ++k) {
    const int column = k % 7, row = k / 7;
    blockers.push_back(
        square(0.1, 1.5 + 0.01 * k, true, {0.24 * column - 0.72, 0.2 * row - 0.5, 0}));
  }
  const host::FixedScene scene = between(blockers);
  const double seen = fraction(scene, true);
  CHECK(seen > 0.2);
  CHECK(seen < 0.6);
  CHECK(fraction(scene, false) == seen);
  // By the source, with each skip off: the same factors.
  const host::FixedScene room = walls(blockers);
  std::vector<std::array<std::uint32_t, 4>> rows;
  for (const std::uint32_t off :
       {0u, std::uint32_t(urad::skip_off_unseen), std::uint32_t(urad::skip_off_order),
        std::uint32_t(urad::skip_off_blockers)}) {
    urad_counters counters{};
    urad::PairSource source{&room.pod(), nullptr, urad::Kernel::moment, 256, off, &counters};
    rows.emplace_back();
    REQUIRE(urad::pair_fill(&source, 0, 1, 4, 4, rows.back().data()) == URAD_OK);
    CHECK(rows.back() == rows.front());
    for (const std::uint32_t f : rows.back()) CHECK(f > 0);
  }
}

TEST_CASE("a vertex given twice changes no ray") {
  Polygon once = square(0.5, 2, true), twice = once;
  twice.outer.insert(twice.outer.begin() + 2, twice.outer[2]);
  CHECK(twice.outer.size() == 5);
  const double seen = fraction(between({once}), true);
  CHECK(seen > 0.3);
  CHECK(seen < 0.7);
  CHECK(fraction(between({twice}), true) == seen);
}

TEST_CASE("a blocker that turns back and forth, as a comb does, shuts no pair before its rays") {
  Polygon comb{{{-2, -2, 2}, {2, -2, 2}}, {}};
  for (int tooth = 4; tooth >= 0; --tooth) {
    const double x = -1.6 + 0.8 * tooth;
    comb.outer.push_back({x + 0.4, 2, 2});
    comb.outer.push_back({x - 0.1, 2, 2});
    comb.outer.push_back({x - 0.1, -1.5, 2});
    comb.outer.push_back({x - 0.4, -1.5, 2});
  }
  const host::FixedScene scene = between({comb});
  const double seen = fraction(scene, true);
  CHECK(seen > 0.2);
  CHECK(seen < 0.6);
  CHECK(fraction(scene, false) == seen);
}

TEST_CASE(
    "a ray within a blocker's plane is stopped where the blocker stands beside it, and not "
    "elsewhere") {
  test::PolygonScene polygons(0);
  polygons.add_blocker({{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}});
  urad_scene scene = polygons.pod();
  urad_blocker blocker = scene.blocker[0];
  blocker.low = {-50, -50, 0}, blocker.high = {50, 50, 0};
  // Its ends are known to lie on either side, whatever their rounding says.
  CHECK(urad::stands_across(scene, blocker, {-100, 0, 0}, {100, 0, 0}, 1, -1));
  CHECK_FALSE(urad::stands_across(scene, blocker, {-100, 60, 0}, {100, 60, 0}, 1, -1));
  // Grazing, the outline is as wide as a unit across the plane moves the point along it; a ray that
  // keeps beside the blocker's box passes all the same.
  CHECK_FALSE(urad::stands_across(scene, blocker, {100, 0, 1}, {1100, 0, -1}, 1, -1));
  CHECK(urad::stands_across(scene, blocker, {0, 0, 900}, {9, 0, -900}, 0, 0));
}

TEST_CASE("points on a pentagon tilted about one axis lie in its plane") {
  for (const bool about_x : {true, false}) {
    test::PolygonScene polygons(0);
    std::vector<test::Vec> loop;
    for (int k = 0; k < 5; ++k) {
      const double a = 1000 * std::cos(1.2566370614 * k), b = 1000 * std::sin(1.2566370614 * k);
      loop.push_back(about_x ? test::Vec(a, b, 0.5 * b) : test::Vec(a, b, 0.5 * a));
    }
    polygons.add(loop);
    const urad_scene& scene = polygons.pod();
    const urad::Patch patch = urad::patch_at(scene, 0);
    const urad::PatchSampler sampler(scene, patch);
    int points = 0;
    for (std::uint32_t x = 0x08000000u; x < 0x80000000u; x += 0x10000000u)
      for (std::uint32_t y = 0x08000000u; y < 0x80000000u; y += 0x10000000u) {
        urad_point p{};
        if (!sampler.point(x, y, &p)) continue;
        ++points;
        CHECK(std::fabs(p.z - 0.5 * (about_x ? p.y : p.x)) <= 1.5);
      }
    CHECK(points > 32);
  }
}
