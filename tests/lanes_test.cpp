// SIMD lanes on the host: the engine's integers, bit for bit, on every instruction set of the machine.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <hwy/highway.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <random>

#include "base/file.hpp"
#include "lanes/lane_rows.hpp"
#include "lanes/pair_lanes.hpp"
#include "random_room.hpp"
#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"
#include "weights/cornell.h"
#include "weights/cube7.h"
#include "weights/general.h"

namespace {

/// Calls test() under each instruction set that this machine has.
template <class Test>
void on_every_target(Test test) {
  for (std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS; targets;
       targets &= targets - 1) {
    const std::int64_t one = targets & -targets;
    hwy::SetSupportedTargetsForTest(one);
    CAPTURE(hwy::TargetName(one));
    test();
  }
  hwy::SetSupportedTargetsForTest(0);
}

host::Scene random_room(unsigned seed) {
  std::mt19937 random(seed);
  const test::RandomRoom room = test::random_room(random, 1);
  const std::string folder = fmt::format("{}/lanes_{}", URAD_SCRATCH_DIR, seed);
  std::filesystem::create_directories(folder);
  host::write_file_atomically(folder + "/room.obj", room.obj);
  host::write_file_atomically(folder + "/room.mtl", room.mtl);
  return host::load_scene(folder + "/room.obj");
}

/// Rows as a chip makes them, run by run.
std::vector<std::uint32_t> engine_rows(const urad::PairSource& pairs, urad_counters* counters) {
  const urad_scene& scene = *pairs.scene;
  urad::PairSource source = pairs;
  source.counters = counters;
  std::vector<std::uint32_t> f(std::size_t{scene.patch_count} * scene.patch_count);
  for (std::uint16_t i = 0; i < scene.patch_count; ++i)
    for (std::uint16_t s = 0; s < scene.surface_count; ++s) {
      const urad_surface& to = scene.surface[s];
      REQUIRE(urad::pair_fill(&source, i, s, to.first_patch, to.patch_count,
                              &f[std::size_t{i} * scene.patch_count + to.first_patch]) == URAD_OK);
    }
  return f;
}

void same_as_engine(const urad::PairSource& asked) {
  using Ways = std::array<std::uint32_t, urad::kWays>;
  urad::PairSource pairs = asked;
  REQUIRE(host::has_lanes(pairs));
  urad_counters expected_counters{};
  Ways expected_ways{};
  pairs.ways = expected_ways.data();
  const std::vector<std::uint32_t> expected = engine_rows(pairs, &expected_counters);
  on_every_target([&] {
    std::vector<std::uint32_t> f(expected.size(), 7);
    urad_counters counters{};
    Ways ways{};
    pairs.ways = ways.data();
    host::lane_rows(pairs, 2, f, &counters);
    CHECK(f == expected);
    CHECK(ways == expected_ways);
    CHECK(std::memcmp(&counters, &expected_counters, sizeof counters) == 0);
  });
}

void same_as_engine(const host::Scene& scene, const urad_net* net, urad::Kernel kernel) {
  const host::FixedScene fixed(scene);
  same_as_engine({&fixed.pod(), net, kernel, 16, 0, nullptr});
}

}  // namespace

TEST_CASE("rows of the cube and of random rooms are the engine's") {
  const host::Scene cube = host::load_scene("cube7");
  same_as_engine(cube, nullptr, urad::Kernel::centre);
  same_as_engine(cube, nullptr, urad::Kernel::moment);
  same_as_engine(cube, &urad_cube7, urad::Kernel::moment);
  for (const unsigned seed : {21u, 22u}) {
    CAPTURE(seed);
    same_as_engine(random_room(seed), &urad_general, urad::Kernel::moment);
  }
}

TEST_CASE("rows by auto and by exact sums, each pair once, are the engine's") {
  for (const unsigned seed : {23u, 24u}) {
    CAPTURE(seed);
    const host::Scene room = random_room(seed);
    const host::FixedScene fixed(room);
    urad::PairSource pairs{&fixed.pod(), &urad_general, urad::Kernel::moment, 16, 0, nullptr};
    pairs.points = 1;
    same_as_engine(pairs);
    pairs.points = 0;
    pairs.log2_error_q8 = urad::kPercentError_q8;
    pairs.exchange = urad::cheapest_of_source;
    same_as_engine(pairs);
  }
}

TEST_CASE("polygon lists: any two patches in front of each other, by two networks") {
  const host::Scene scene = host::load_scene("cornell", {3, 0});
  const host::FixedScene fixed(scene);
  const urad_scene& pod = fixed.pod();
  const host::PatchLanes patches(pod);
  urad_net open = urad_cornell;
  open.near_rho_uq16 = 0;
  const urad_net* const nets[] = {&urad_general, &open};
  on_every_target([&] {
    int same = 0, different = 0;
    host::LaneFactors lanes;
    for (const urad_net* net : nets)
      for (std::uint16_t i = 0; i < pod.patch_count; i = std::uint16_t(i + 7)) {
        host::lane_factors(patches, i, 0, pod.patch_count, urad::Kernel::moment, net, &lanes);
        const urad::Patch from = urad::patch_at(pod, i);
        for (std::uint16_t j = 0; j < pod.patch_count; ++j) {
          if (i == j || (net->near_rho_uq16 && lanes.rho_uq16[j] > net->near_rho_uq16)) continue;
          urad_counters counters{};
          const urad::Patch to = urad::patch_at(pod, j);
          const std::int32_t engine =
              urad::exchange_in_front_q24(pod, from, to, urad::Kernel::moment, net, 0, &counters);
          const bool equal =
              lanes.from_uq32[j] == urad::form_factor_uq32(engine, from.shape->log2_area_q24) &&
              lanes.to_uq32[j] == urad::form_factor_uq32(engine, to.shape->log2_area_q24);
          ++(equal ? same : different);
        }
      }
    CHECK(different == 0);
    CHECK(same > 1000);
  });
}
