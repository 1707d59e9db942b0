// A room as one surface, a list of polygons that lie in no plane together: the factors of the same room
// in six grids, by every method.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hand_made_scene.hpp"
#include "method/engine_source.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/hemicube_table.hpp"
#include "urad/hybrid.hpp"
#include "weights/cube7.h"
#include "weights/legacy_linear50.h"

namespace {

host::NetChoice nets_of(const std::string& method) {
  if (method == "legacy") return {nullptr, nullptr, nullptr, &urad_legacy_linear50};
  return {[](const std::string&) -> const urad_net* { return &urad_cube7; }};
}

/// All walls of a scene as one surface.
host::Scene one_list(host::Scene scene) {
  host::Surface all = scene.surfaces[0];
  all.grid.reset();
  all.planar = false;
  all.first_patch = 0;
  all.patch_count = int(scene.patches.size());
  for (host::ScenePatch& patch : scene.patches) patch.surface = 0;
  for (host::Blocker& blocker : scene.blockers) blocker.surface = -1;
  scene.surfaces = {all};
  return scene;
}

/// The cube with a plate in its middle, both sides of which are dark and block.
host::Scene with_plate(int count) {
  host::Scene scene = test::cube(count);
  scene.convex = scene.closed = false;
  host::Blocker plate;
  plate.polygon.outer = {{0.3, 0.3, 0.5}, {0.7, 0.3, 0.5}, {0.7, 0.7, 0.5}, {0.3, 0.7, 0.5}};
  scene.blockers.push_back(plate);
  return scene;
}

/// The greatest difference between rows of two scenes with the same patches.
double worst_difference(const host::Scene& a, const host::Scene& b, const std::string& method) {
  const host::FixedScene fixed_a(a), fixed_b(b);
  const host::MethodSpec spec = host::parse_method(method);
  const host::NetChoice nets = nets_of(method);
  host::EngineOptions options;
  options.rays = 256;
  const host::EngineSource source_a(fixed_a, spec, nets, options),
      source_b(fixed_b, spec, nets, options);
  const std::size_t n = a.patches.size();
  std::vector<std::uint32_t> row_a(n), row_b(n);
  double worst = 0;
  for (std::uint16_t shooter = 0; shooter < n; shooter += 5) {
    source_a.row(shooter, row_a.data());
    source_b.row(shooter, row_b.data());
    CHECK(row_b[shooter] == 0);
    for (std::size_t j = 0; j < n; ++j)
      worst = std::max(worst, std::fabs(double(row_a[j]) - double(row_b[j])) / 0x1p32);
  }
  return worst;
}

}  // namespace

TEST_CASE("a convex room as one list: the factors of its six walls") {
  const host::Scene walls = test::cube(3), list = one_list(walls);
  for (const char* method :
       {"fixed-kernel", "fixed-moment", "fixed-lambert:2", "net", "auto", "legacy", "hybrid:32"}) {
    CAPTURE(method);
    CHECK(worst_difference(walls, list, method) <= 2e-6);
  }
  CHECK(worst_difference(walls, list, "hemicube:32") <= 1e-3);  // a cell on an edge of two patches
}

TEST_CASE("a room with a plate in it as one list: the factors of its six walls") {
  const host::Scene walls = with_plate(3), list = one_list(walls);
  for (const char* method : {"fixed-moment", "net", "auto", "legacy"}) {
    CAPTURE(method);
    CHECK(worst_difference(walls, list, method) <= 2e-6);
  }
  for (const char* method : {"hemicube:32", "hybrid:32"}) {
    CAPTURE(method);
    CHECK(worst_difference(walls, list, method) <= 2e-3);
  }
}

TEST_CASE("without an item buffer, what a patch covers is what is seen of it") {
  const host::FixedScene room(one_list(test::cube(3)));
  const urad_scene& scene = room.pod();
  constexpr auto kCells = urad::make_hemicube_table<32>();
  const std::size_t bytes = urad::hemicube_bytes(32, 0, scene.patch_count, true, 4);
  std::vector<std::uint32_t> memory(bytes / 4 + 1);
  urad::HemicubeSource source{};
  urad_counters counters{};
  REQUIRE(urad::hemicube_init(&source, &scene, urad::hemicube_table(kCells), 0,
                              urad::hemicube_coverage, memory.data(), bytes,
                              &counters) == urad::Status::ok);
  for (std::uint16_t shooter = 0; shooter < 54; shooter += 10) {
    REQUIRE(urad::hemicube_render(&source, shooter) == urad::Status::ok);
    CHECK(std::equal(source.visible_uq32, source.visible_uq32 + 54, source.coverage_uq32));
    CHECK(*std::max_element(source.visible_uq32, source.visible_uq32 + 54) > 1u << 26);
  }
}

TEST_CASE("a run with the shooter in it, or behind it, counts one pair less, or all") {
  const host::FixedScene list(one_list(test::cube(3))), walls(test::cube(3));
  for (const bool grids : {false, true}) {
    CAPTURE(grids);
    const urad_scene& scene = grids ? walls.pod() : list.pod();
    urad_counters counters{};
    urad::PairSource pairs{&scene, nullptr, urad::Kernel::moment, 0, 0, &counters};
    std::uint32_t f[9];
    const auto asked = [&](std::uint16_t shooter, std::uint16_t first) {
      counters = {};
      REQUIRE(urad::pair_fill(&pairs, shooter, 0, first, 4, f) == URAD_OK);
      return counters.evaluated + counters.skipped_same + counters.skipped_facing;
    };
    CHECK(asked(3, 0) == 3);
    CHECK(asked(0, 4) == 4);
    CHECK(asked(8, 4) == 4);
    CHECK(asked(4, 4) == 3);
  }
}
