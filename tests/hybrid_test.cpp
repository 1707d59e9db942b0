// The hybrid source: what is seen from cells or rays, how much from the kernel; near pairs on
// convex scenes.
#include "urad/hybrid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "form_factor/kernel.hpp"
#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/hemicube_table.hpp"
#include "urad/visibility.hpp"

namespace {

constexpr auto kCells = urad::make_hemicube_table<32>();

struct Sources {
  explicit Sources(const urad_scene& pod, uint16_t rows, uint32_t near_rho_uq16, uint8_t flags)
      : scene(pod) {
    const size_t bytes =
        urad::hemicube_bytes(32, rows, scene.patch_count, flags & urad::hemicube_coverage);
    memory.resize(bytes / 4 + 1);
    REQUIRE(urad::hemicube_init(&hemicube, &scene, urad::hemicube_table(kCells), rows, flags,
                                memory.data(), bytes, &counters) == urad::Status::ok);
    REQUIRE(urad::hybrid_init(&hybrid, &hemicube, urad::Kernel::moment, nullptr, 32,
                              near_rho_uq16) == urad::Status::ok);
  }

  std::vector<uint32_t> row(urad_fill fill, void* context, uint16_t shooter) {
    std::vector<uint32_t> f_uq32(scene.patch_count);
    for (uint16_t s = 0; s < scene.surface_count; ++s) {
      const urad_surface& to = scene.surface[s];
      REQUIRE(fill(context, shooter, s, to.first_patch, to.patch_count, &f_uq32[to.first_patch]) ==
              URAD_OK);
    }
    return f_uq32;
  }
  std::vector<uint32_t> hybrid_row(uint16_t shooter) {
    return row(urad::hybrid_fill, &hybrid, shooter);
  }
  std::vector<uint32_t> hemicube_row(uint16_t shooter) {
    hemicube.shooter = -1;
    return row(urad::hemicube_fill, &hemicube, shooter);
  }
  std::vector<uint32_t> kernel_row(uint16_t shooter) {
    urad_counters unused{};
    urad::PairSource pairs{&scene, nullptr, urad::Kernel::moment, 0, 0, &unused};
    return row(urad::pair_fill, &pairs, shooter);
  }

  const urad_scene& scene;
  urad_counters counters{};
  std::vector<uint32_t> memory;
  urad::HemicubeSource hemicube{};
  urad::HybridSource hybrid{};
};

uint64_t sum_of(const std::vector<uint32_t>& row) {
  uint64_t sum = 0;
  for (const uint32_t f : row) sum += f;
  return sum;
}

/// Mean of the factor over `from` by that of its centre, to second order: the moment kernel of
/// `from` and a point, by the centre kernel.
double over_shooter(const host::Moments& from, host::Moments to) {
  to.second = glm::dmat3(0);
  return host::moment_kernel(from, to) / host::centre_kernel(from, to);
}

TEST_CASE(
    "cube7: near pairs are the kernel's, far pairs the hemicube's over the shooter, rows keep "
    "their sum") {
  const host::Scene cube = host::load_scene("cube7");
  const host::FixedScene fixed(cube);
  const urad_scene& scene = fixed.pod();
  Sources sources(scene, 0, urad::kThreePatches_uq16, urad::hemicube_turned);
  for (uint16_t shooter = 0; shooter < scene.patch_count; shooter = uint16_t(shooter + 13)) {
    const std::vector<uint32_t> hybrid = sources.hybrid_row(shooter),
                                kernel = sources.kernel_row(shooter);
    const std::vector<uint32_t> hemicube = sources.hemicube_row(shooter);
    sources.hybrid.shooter = -1;  // its row was overwritten by the line above
    const urad::Patch from = urad::patch_at(scene, shooter);
    std::vector<double> expected(scene.patch_count);
    double far_hybrid = 0, far_expected = 0;
    for (uint16_t k = 0; k < scene.patch_count; ++k) {
      if (urad::patch_at(scene, k).surface != from.surface &&
          !urad::closer_than(from, urad::patch_at(scene, k), urad::kThreePatches_uq16)) {
        expected[k] =
            hemicube[k] * over_shooter(cube.patches[shooter].moments, cube.patches[k].moments);
        far_hybrid += hybrid[k], far_expected += expected[k];
      }
    }
    int near = 0;
    for (uint16_t k = 0; k < scene.patch_count; ++k) {
      const urad::Patch to = urad::patch_at(scene, k);
      if (to.surface == from.surface) {
        CHECK(hybrid[k] == 0);
      } else if (urad::closer_than(from, to, urad::kThreePatches_uq16)) {
        ++near;
        CHECK(hybrid[k] == kernel[k]);
      } else {
        CHECK(std::fabs(hybrid[k] - expected[k] * (far_hybrid / far_expected)) <
              2 + 1e-5 * hybrid[k]);
      }
    }
    CHECK(near < scene.patch_count / 6);
    CHECK(std::llabs(int64_t(sum_of(hybrid)) - (int64_t{1} << 32)) < scene.patch_count);
  }
  CHECK(sources.counters.evaluated + sources.counters.skipped_same == 2 * 23 * 293);
}

TEST_CASE(
    "cornell: kernel factor times the visible cells, rays for what covers no cell, never more than "
    "unoccluded") {
  const host::FixedScene fixed(host::load_scene("cornell"));
  const urad_scene& scene = fixed.pod();
  REQUIRE((scene.flags & URAD_SCENE_CONVEX) == 0);
  Sources sources(scene, 32, 0, urad::hemicube_turned | urad::hemicube_coverage);
  int partly = 0, hidden = 0, uncovered = 0, shooters = 0;
  for (uint16_t shooter = 0; shooter < scene.patch_count; shooter = uint16_t(shooter + 37)) {
    ++shooters;
    const std::vector<uint32_t> hybrid = sources.hybrid_row(shooter),
                                kernel = sources.kernel_row(shooter);
    for (uint16_t k = 0; k < scene.patch_count; ++k) {
      CHECK(hybrid[k] <= kernel[k]);
      if (kernel[k] == 0) continue;
      const double covered = sources.hemicube.coverage_uq32[k];
      double fraction;
      if (covered > 0) {
        fraction = sources.hemicube.visible_uq32[k] / covered;
      } else {
        ++uncovered;
        urad_counters unused{};
        fraction = urad::visible_fraction_uq16(scene, urad::patch_at(scene, shooter),
                                               urad::patch_at(scene, k), 32, true, &unused) /
                   65536.0;
      }
      partly += fraction > 0 && fraction < 1;
      hidden += fraction == 0;
      CHECK(std::fabs(hybrid[k] - kernel[k] * fraction) <= kernel[k] * 0x1p-16 + 1);
    }
  }
  MESSAGE(partly, " pairs partly visible, ", hidden, " hidden, ", uncovered, " without a cell");
  CHECK(partly > 0);
  CHECK(hidden > 0);
  const urad_counters& c = sources.counters;
  CHECK(c.evaluated + c.skipped_same + c.skipped_facing ==
        uint32_t(shooters * (scene.patch_count - 1)));
}

TEST_CASE("a hybrid that looks at every pair behind a wall finds what it skips") {
  const host::FixedScene fixed(host::load_scene("cornell"));
  const urad_scene& scene = fixed.pod();
  Sources sources(scene, 32, 0, urad::hemicube_turned | urad::hemicube_coverage);
  for (uint16_t shooter = 0; shooter < scene.patch_count; shooter = uint16_t(shooter + 61)) {
    sources.hybrid.skips_off = 0;
    sources.hybrid.shooter = -1;
    const std::vector<uint32_t> skipped = sources.hybrid_row(shooter);
    sources.hybrid.skips_off = urad::skip_off_behind;
    sources.hybrid.shooter = -1;
    CHECK(sources.hybrid_row(shooter) == skipped);
  }
  CHECK(sources.counters.skipped_behind > 0);
}

TEST_CASE("a repair scales the factors of a hybrid, up to 1") {
  for (const char* name : {"cube7", "cornell"}) {
    CAPTURE(name);
    host::FixedScene fixed(host::load_scene(name));
    const urad_scene& scene = fixed.pod();
    const bool convex = scene.flags & URAD_SCENE_CONVEX;
    const uint8_t flags = urad::hemicube_turned | (convex ? 0 : urad::hemicube_coverage);
    Sources sources(scene, 32, 0, flags);
    const std::vector<uint32_t> plain = sources.hybrid_row(5);
    const auto brightest =
        std::size_t(std::max_element(plain.begin(), plain.end()) - plain.begin());
    std::vector<double> scale(scene.patch_count, 1.5);
    scale[5] = 0.5, scale[brightest] = 1e6;
    fixed.set_scale(scale);
    Sources repaired(scene, 32, 0, flags);
    const std::vector<uint32_t> scaled = repaired.hybrid_row(5);
    for (std::size_t k = 0; k < plain.size(); ++k) {
      if (k == brightest) continue;
      CHECK(std::fabs(scaled[k] - 0.75 * plain[k]) <= 1 + 2e-5 * plain[k]);
    }
    // A fraction of all that is seen: saturated factors stay below it.
    CHECK(scaled[brightest] > 0xFFFF0000u * 0.5);
  }
}

TEST_CASE("bad arguments are refused") {
  const host::FixedScene cube(host::load_scene("cube7")), box(host::load_scene("cornell"));
  urad_counters counters{};
  const urad::HemicubeTable table = urad::hemicube_table(kCells);
  urad::HemicubeSource hemicube{};
  std::vector<uint32_t> memory(20000);
  const size_t bytes = memory.size() * 4;
  const auto init = [&](const urad_scene* scene, urad::HemicubeTable t, uint16_t rows, size_t room,
                        void* at) {
    return urad::hemicube_init(&hemicube, scene, t, rows, 0, at, room, &counters);
  };
  CHECK(init(nullptr, table, 0, bytes, memory.data()) == urad::Status::bad_argument);
  CHECK(init(&cube.pod(), table, 0, bytes, nullptr) == urad::Status::bad_argument);
  CHECK(init(&cube.pod(), {31, table.top, table.side}, 0, bytes, memory.data()) ==
        urad::Status::bad_argument);
  CHECK(init(&cube.pod(), {130, table.top, table.side}, 0, bytes, memory.data()) ==
        urad::Status::bad_argument);
  CHECK(init(&cube.pod(), table, 33, bytes, memory.data()) == urad::Status::bad_argument);
  CHECK(init(&box.pod(), table, 0, bytes, memory.data()) == urad::Status::bad_argument);
  CHECK(init(&cube.pod(), table, 0, bytes - 2, reinterpret_cast<char*>(memory.data()) + 2) ==
        urad::Status::out_of_memory);
  const size_t exact = urad::hemicube_bytes(32, 0, cube.pod().patch_count, false, 4);
  CHECK(init(&cube.pod(), table, 0, exact - 1, memory.data()) == urad::Status::out_of_memory);
  CHECK(hemicube.scene == nullptr);
  CHECK(std::all_of(memory.begin(), memory.end(), [](uint32_t x) { return x == 0; }));
  REQUIRE(init(&cube.pod(), table, 0, exact, memory.data()) == urad::Status::ok);

  uint32_t f_uq32[400];
  CHECK(urad::hemicube_fill(&hemicube, 294, 1, 49, 49, f_uq32) == URAD_BAD_ARGUMENT);
  CHECK(urad::hemicube_fill(&hemicube, 0, 6, 49, 49, f_uq32) == URAD_BAD_ARGUMENT);
  CHECK(urad::hemicube_fill(&hemicube, 0, 1, 49, 50, f_uq32) == URAD_BAD_ARGUMENT);
  CHECK(urad::hemicube_items(&hemicube, 0, 0, 0) == urad::Status::bad_argument);

  urad::HybridSource hybrid{};
  CHECK(urad::hybrid_init(&hybrid, nullptr, urad::Kernel::moment, nullptr, 16, 0) ==
        urad::Status::bad_argument);
  CHECK(urad::hybrid_init(&hybrid, &hemicube, urad::Kernel::moment, nullptr, 0, 0) ==
        urad::Status::bad_argument);
  CHECK(urad::hybrid_init(&hybrid, &hemicube, urad::Kernel::moment, nullptr, 1025, 0) ==
        urad::Status::bad_argument);
  for (const uint16_t rays : {uint16_t{1}, uint16_t{1024}})
    CHECK(urad::hybrid_init(&hybrid, &hemicube, urad::Kernel::moment, nullptr, rays, 0) ==
          urad::Status::ok);
  REQUIRE(urad::hybrid_init(&hybrid, &hemicube, urad::Kernel::moment, nullptr, 16, 0) ==
          urad::Status::ok);
  CHECK(urad::hybrid_fill(&hybrid, 294, 1, 49, 49, f_uq32) == URAD_BAD_ARGUMENT);
  CHECK(urad::hybrid_fill(&hybrid, 0, 1, 48, 2, f_uq32) == URAD_BAD_ARGUMENT);

  urad::HemicubeSource blind{};
  REQUIRE(urad::hemicube_init(&blind, &box.pod(), table, 1, 0, memory.data(), bytes, &counters) ==
          urad::Status::ok);
  CHECK(urad::hybrid_init(&hybrid, &blind, urad::Kernel::moment, nullptr, 16, 0) ==
        urad::Status::bad_argument);
}

}  // namespace

TEST_CASE("far pairs are never scaled beyond 4, and none beyond the whole") {
  const auto facing = [](double side, double x, double height) {
    const double low = x - side / 2, high = x + side / 2, half = side / 2;
    return host::FixedScene::of_polygons(
        {{{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}}, {}},
         {{{low, -half, height}, {low, half, height}, {high, half, height}, {high, -half, height}},
          {}}},
        {});
  };
  // As if far: over its extent a square sees a fifth of what its centre sees of one as near as this.
  {
    const host::FixedScene scene = facing(1, 0, 0.2);
    Sources sources(scene.pod(), 32, 16u << 16, urad::hemicube_turned | urad::hemicube_coverage);
    const std::uint32_t seen = sources.hemicube_row(0)[1], hybrid = sources.hybrid_row(0)[1];
    CHECK(hybrid < 0.99 * seen);
    CHECK(hybrid > 0.8 * seen);
  }
  // One that is almost all it sees, and more over its extent than from its centre.
  {
    const host::FixedScene scene = facing(4, 1, 0.01);
    Sources sources(scene.pod(), 32, 0xFFFFFFFFu, urad::hemicube_turned | urad::hemicube_coverage);
    const std::uint32_t seen = sources.hemicube_row(0)[1], hybrid = sources.hybrid_row(0)[1];
    CHECK(seen > 0xFE000000u);
    CHECK(std::fabs(double(hybrid) - seen) < 16);
  }
}
