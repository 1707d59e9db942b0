// What is read from a solve at the ends of its ranges, shots by the dozen, and lights that are mixed.
#include <doctest/doctest.h>

#include <cstdint>
#include <limits>

#include "radiosity_scene.hpp"
#include "urad/urad.h"

namespace {

/// A lamp of area 1 and a grey patch of 2^log2_area, which gets half of its light.
struct LampAndPatch {
  test::TableScene scene{2, 1, 0};
  explicit LampAndPatch(int log2_area) {
    scene.set(0, {0, 0, 0}, {1000000, 1000000, 1000000});
    scene.set(1, {0.5, 0.5, 0.5}, {0, 0, 0});
    scene.polygon[1].shape.log2_area_q24 = log2_area * (1 << 24);
    scene.row[0][1] = 0x80000000u;
    scene.pod.log2_power_q24 = 6 << 24;
  }
};

std::int32_t light_on_patch(int log2_area) {
  LampAndPatch room(log2_area);
  test::Solve solve(room.scene);
  REQUIRE(solve.status == urad::Status::ok);
  CHECK(urad::radiosity_get(solve.state, 1, 0) == 0);
  REQUIRE(urad::radiosity_step(&solve.state) == urad::Status::ok);
  return urad::radiosity_get(solve.state, 1, 0);
}

}  // namespace

TEST_CASE("radiosity is power over area, saturates on tiny patches and vanishes on huge ones") {
  CHECK(light_on_patch(0) == doctest::Approx(250000).epsilon(1e-5));
  CHECK(light_on_patch(-6) == doctest::Approx(250000 * 64).epsilon(1e-5));
  CHECK(light_on_patch(17) == 2);
  CHECK(light_on_patch(19) == 0);
  for (const int log2_area : {-14, -36, -40, -60})
    CHECK(light_on_patch(log2_area) == std::numeric_limits<std::int32_t>::max());
  for (const int log2_area : {30, 40, 60}) CHECK(light_on_patch(log2_area) == 0);
}

TEST_CASE("shots by the dozen are the same shots, counted or not, and stop where they should") {
  std::mt19937 random(7);
  test::TableScene scene(6, 4, 0);
  test::furnish(&scene);
  scene.fill_reciprocal(random, 0.9);
  test::Solve one(scene), dozen(scene), uncounted(scene);
  for (int k = 0; k < 12; ++k) REQUIRE(urad::radiosity_step(&one.state) == urad::Status::ok);
  std::uint32_t shots = 99;
  CHECK(urad::radiosity_steps(&dozen.state, 12, 0, &shots) == urad::Status::ok);
  CHECK(shots == 12);
  CHECK(urad_radiosity_steps(&uncounted.state, 12, 0, nullptr) == URAD_OK);
  CHECK(dozen.same_light(one));
  CHECK(uncounted.same_light(one));
  CHECK(urad::radiosity_steps(&dozen.state, 12, 0xFFFFFFFFu, &shots) == urad::Status::ok);
  CHECK(shots == 0);
  scene.fail_after = 6 * 4 + 1;
  CHECK(urad::radiosity_steps(&dozen.state, 100, 0, &shots) == urad::Status::bad_net);
  CHECK(shots < 12);
  CHECK(urad::radiosity_audit(dozen.state, nullptr));
}

TEST_CASE("a scene of no patch or no surface cannot be solved") {
  for (const bool surfaces : {false, true}) {
    LampAndPatch room(0);
    (surfaces ? room.scene.pod.surface_count : room.scene.pod.patch_count) = 0;
    urad::Radiosity state{};
    std::uint32_t memory[64] = {};
    CHECK(urad::radiosity_init(&state, &room.scene.pod, room.scene.source(), 0, 1, memory,
                               sizeof memory) == urad::Status::bad_scene);
  }
}

TEST_CASE("lights mix the same for odd and even numbers of patches") {
  const std::uint16_t low[12] = {1, 2, 3, 40, 50, 60, 700, 800, 900, 9000, 9001, 9002},
                      high[12] = {65535, 1, 0, 65534, 3, 7, 65533, 5, 1, 2, 3, 4};
  urad_light light[2]{};
  light[0].basis = low, light[1].basis = high;
  for (std::size_t c = 0; c < 3; ++c) {
    light[0].colour_uq15[c] = 32768;
    light[1].colour_uq15[c] = std::uint16_t(c == 2 ? 0 : 16384);
  }
  for (std::uint16_t patches = 1; patches <= 4; ++patches) {
    std::uint32_t mixed[12];
    REQUIRE(urad_light_mix(light, 2, patches, mixed) == URAD_OK);
    for (std::size_t k = 0; k < 3u * patches; ++k) {
      const std::uint32_t half = k % 3 == 2 ? 0u : (high[k] + 1u) / 2;
      CHECK(mixed[k] == low[k] + half);
    }
  }
}

TEST_CASE("a lamp of one unit has all of its light to come") {
  test::TableScene scene(2, 1, URAD_SCENE_CLOSED);
  scene.set(0, {0.5, 0.5, 0.5}, {1, 0, 0});
  scene.set(1, {0.5, 0.5, 0.5}, {0, 0, 0});
  scene.row[0][1] = scene.row[1][0] = 0xFFFFFFFFu;
  test::Solve solve(scene);
  REQUIRE(solve.state.remaining == 1);
  CHECK(urad::radiosity_error_uq32(solve.state) == 0xFFFFFFFFu);
}

TEST_CASE("all bounces together are taken for a thousand at most, where nothing absorbs") {
  test::TableScene scene(2, 1, URAD_SCENE_CLOSED);
  for (int s = 0; s < 2; ++s) scene.set(s, {1, 1023.0 / 1024, 0.5}, {1000, 1000, 1000});
  scene.pod.log2_power_q24 = 8 << 24;
  test::Solve solve(scene);
  REQUIRE(solve.status == urad::Status::ok);
  CHECK(urad::radiosity_ambient(solve.state, 0) == doctest::Approx(1000 * 1024).epsilon(1e-4));
  CHECK(urad::radiosity_ambient(solve.state, 1) == doctest::Approx(1000 * 1024).epsilon(1e-4));
  CHECK(urad::radiosity_ambient(solve.state, 2) == doctest::Approx(1000 * 2).epsilon(1e-4));
}
