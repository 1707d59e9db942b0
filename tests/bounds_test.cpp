// Boxes around blockers, and what is told of blockers without a ray: never another answer.
#include "scene/bounds.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "../firmware_style/src/visibility_walk.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/form_factor.hpp"
#include "urad/urad.h"
#include "urad/visibility.hpp"

namespace {

using host::Polygon;
using host::Vec3;

constexpr unsigned kSeed = 1996;

/// A loop of `corners` about `centre`, turned at random; concave when `dent` is less than 1.
Polygon random_polygon(std::mt19937_64& random, const Vec3& centre, double size, int corners,
                       double dent) {
  std::normal_distribution<double> normal;
  const Vec3 n = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
  const Vec3 u = glm::normalize(glm::cross(n, std::abs(n.x) < 0.7 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 v = glm::cross(n, u);
  Polygon polygon;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * M_PI * k / corners, radius = size * (k % 2 ? dent : 1);
    polygon.outer.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return polygon;
}

Vec3 random_place(std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-1, 1);
  return {place(random), place(random), place(random)};
}

/// Patches and blockers anywhere, some across each other's planes.
host::FixedScene random_scene(std::mt19937_64& random, int blockers) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Polygon> patches, between;
  for (int k = 0; k < 12; ++k)
    patches.push_back(
        random_polygon(random, random_place(random), 0.05 + 0.3 * unit(random), k % 3 + 3, 1));
  for (int k = 0; k < blockers; ++k)
    between.push_back(random_polygon(random, 0.6 * random_place(random),
                                     (k % 3 ? 0.2 : 0.9) * unit(random), k % 5 + 3,
                                     k % 4 ? 1 : 0.5));
  return host::FixedScene::of_polygons(patches, between);
}

bool beside(const urad_point& low, const urad_point& high, const urad_point& box_low,
            const urad_point& box_high) {
  return high.x < box_low.x || low.x > box_high.x || high.y < box_low.y || low.y > box_high.y ||
         high.z < box_low.z || low.z > box_high.z;
}

}  // namespace

TEST_CASE(
    "a walk past boxes comes to every blocker in reach, in order, and leaves most others out") {
  MESSAGE("seed ", kSeed);
  std::mt19937_64 random(kSeed);
  std::vector<Polygon> blockers;
  blockers.reserve(300);
  for (int k = 0; k < 300; ++k)
    blockers.push_back(random_polygon(random, random_place(random), 0.05, 4, 1));
  const host::FixedScene fixed = host::FixedScene::of_polygons({blockers[0]}, blockers);
  const urad_scene& scene = fixed.pod();
  REQUIRE(scene.abi == URAD_SCENE_ABI_SIGHT);
  REQUIRE(urad::scene_check(&scene) == urad::Status::ok);
  std::size_t looks = 0, queries = 0;
  for (; queries < 500; ++queries) {
    const urad_point& at = scene.vertex[random() % scene.vertex_count];
    const std::int32_t half = 1 << (20 + random() % 9);
    const urad_point low{at.x - half, at.y - half, at.z - half},
        high{at.x + half, at.y + half, at.z + half};
    std::vector<int> visited;
    urad::walk_blockers(
        scene,
        [&](const urad_point& l, const urad_point& h) {
          ++looks;
          return beside(low, high, l, h);
        },
        [&](std::uint16_t blocker) {
          visited.push_back(blocker);
          return true;
        });
    CHECK(std::is_sorted(visited.begin(), visited.end()));
    const std::set<int> unique(visited.begin(), visited.end());
    CHECK(unique.size() == visited.size());
    looks += visited.size();
    for (int b = 0; b < scene.blocker_count; ++b) {
      if (!beside(low, high, scene.blocker[b].low, scene.blocker[b].high))
        CHECK(unique.count(b) == 1);
    }
  }
  MESSAGE(fmt::format("{:.1f}", double(looks) / double(queries)), " of ", scene.blocker_count,
          " looks a query");
  CHECK(looks < queries * scene.blocker_count / 3);
}

TEST_CASE("bounds, shadows and lists spare rays and tests, and leave every fraction as it is") {
  MESSAGE("seed ", kSeed);
  std::mt19937_64 random(kSeed + 1);
  urad_counters with{}, without{}, all{};
  int open = 0, shut = 0, part = 0;
  for (int set = 0; set < 24; ++set) {
    const host::FixedScene fixed = random_scene(random, set % 3 == 0 ? 70 : 3 + set % 9);
    urad_scene plain = fixed.pod();
    plain.abi = URAD_SCENE_ABI;  // the boxes are not looked at
    const urad_scene& scene = fixed.pod();
    for (std::uint16_t i = 0; i < scene.patch_count; ++i) {
      for (std::uint16_t j = 0; j < scene.patch_count; ++j) {
        if (i == j) continue;
        const urad::Patch a = urad::patch_at(scene, i), b = urad::patch_at(scene, j);
        const std::uint32_t f = urad::visible_fraction_uq16(scene, a, b, 16, true, &with);
        CHECK(f == urad::visible_fraction_uq16(plain, a, b, 16, true, &without));
        CHECK(f == urad::visible_fraction_uq16(scene, a, b, 16, true, &all, false));
        CHECK(f == urad::visible_fraction_uq16(scene, b, a, 16, true, &without));
        const urad::AdaptiveRays plan{16, 2, 0};
        CHECK(urad::adaptive_fraction_uq16(scene, a, b, plan, 1u << 30, &without) ==
              urad::adaptive_fraction_uq16(scene, a, b, plan, 1u << 30, &without, false));
        ++(f == 0 ? shut : f == urad::kAllVisible_uq16 ? open : part);
      }
    }
  }
  MESSAGE(open, " open, ", shut, " shut, ", part, " in part; rays ", with.rays, " of ", all.rays,
          ", tests ", with.ray_tests, " of ", all.ray_tests, ", shut unseen ", with.shut_unseen);
  CHECK(open > 100);
  CHECK(shut > 100);
  CHECK(part > 100);
  CHECK(with.blocked == all.blocked);
  CHECK(with.shut_unseen > 100);
  CHECK(with.rays + with.rays_spared == all.rays + all.rays_spared);
  CHECK(with.rays < all.rays * 3 / 4);
  CHECK(with.ray_tests < all.ray_tests / 3);
  CHECK(with.blockers_kept + with.blockers_rejected == all.blockers_kept);
}

TEST_CASE("the blocker of the last pair is asked first, from run to run") {
  // Twenty small sheets that most rays pass, and behind them one that nearly all meet.
  std::mt19937_64 random(kSeed + 2);
  std::vector<Polygon> patches, blockers;
  const auto square = [](double x, double y, double z, double half) {
    return Polygon{{{x - half, y - half, z},
                    {x + half, y - half, z},
                    {x + half, y + half, z},
                    {x - half, y + half, z}},
                   {}};
  };
  patches.push_back(square(0, 0, 0, 0.5));
  for (int k = 0; k < 9; ++k) {
    const int column = k % 3 - 1, row = k / 3 - 1;
    Polygon above = square(0.3 * column, 0.3 * row, 2, 0.14);
    std::reverse(above.outer.begin(), above.outer.end());
    patches.push_back(above);
  }
  for (int k = 0; k < 20; ++k)
    blockers.push_back(square(0.1 * k - 1, 0.1 * (k % 5) - 0.2, 0.9 + 0.01 * k, 0.02));
  blockers.push_back(square(0.05, 0, 1.5, 0.4));
  const host::FixedScene fixed = host::FixedScene::of_polygons(patches, blockers);
  std::uint32_t tests[2] = {0, 0};
  for (const bool keep : {false, true}) {
    urad_counters counters{};
    urad::PairSource source{&fixed.pod(), nullptr, urad::Kernel::moment, 64, 0, &counters};
    for (std::uint16_t j = 1; j < fixed.pod().patch_count; ++j) {
      std::uint32_t f = 0;
      REQUIRE(urad::pair_fill(&source, 0, j, j, 1, &f) == URAD_OK);
      if (!keep) source.last_blocker = 0xFFFF;
    }
    tests[keep] = counters.ray_tests;
  }
  MESSAGE("ray tests ", tests[1], " instead of ", tests[0]);
  CHECK(tests[1] < tests[0]);
}

TEST_CASE("boxes that do not hold what they say are refused; a scene of the first ABI has none") {
  std::mt19937_64 random(kSeed + 3);
  const host::FixedScene fixed = random_scene(random, 9);
  std::vector<urad_bounds> bounds(fixed.pod().bounds,
                                  fixed.pod().bounds + fixed.pod().bounds_count);
  REQUIRE(bounds.size() > 2);
  urad_scene scene = fixed.pod();
  scene.bounds = bounds.data();
  REQUIRE(urad_scene_check(&scene) == URAD_OK);
  std::uint32_t crc32[2];
  REQUIRE(urad_scene_crc32(&scene, crc32) == URAD_OK);
  const auto refused = [&](auto change) {
    const std::vector<urad_bounds> good = bounds;
    change(bounds);
    const bool found = urad_scene_check(&scene) == URAD_BAD_SCENE &&
                       urad_scene_verify(&scene, crc32) == URAD_BAD_SCENE;
    bounds = good;
    return found;
  };
  using Boxes = std::vector<urad_bounds>;
  CHECK(refused([](Boxes& b) { b[0].end = b[0].first; }));
  CHECK(refused([](Boxes& b) { ++b[0].end; }));
  CHECK(refused([](Boxes& b) { b[1].next = 1; }));
  CHECK(refused([](Boxes& b) { b.back().next = std::uint16_t(b.size() + 1); }));
  CHECK(refused([](Boxes& b) { ++b[0].low.x; }));
  CHECK(refused([](Boxes& b) { --b[1].high.z; }));
  CHECK(refused([](Boxes& b) { b[0].next = 1; }));
  scene.bounds = nullptr;
  CHECK(urad_scene_check(&scene) == URAD_BAD_SCENE);
  scene.abi = URAD_SCENE_ABI;
  CHECK(urad_scene_check(&scene) == URAD_OK);
  CHECK(urad_scene_verify(&scene, crc32) == URAD_BAD_SCENE);
  scene.abi = URAD_SCENE_ABI_SIGHT + 1;
  CHECK(urad_scene_check(&scene) == URAD_BAD_SCENE);
}
