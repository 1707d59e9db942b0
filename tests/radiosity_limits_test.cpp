// Solves at the limits of their 32 bits: what would leave them is not promised, not shot, or said.
#include <doctest/doctest.h>

#include <cstdint>
#include <limits>

#include "radiosity_scene.hpp"
#include "urad/urad.h"

namespace {

using test::Solve;
using test::TableScene;
using urad::Status;

/// A large white patch and three of a quarter of its size, in red alone. log2 of power units per
/// exitance on the large one: 8.
struct LargeAndSmall {
  TableScene scene{4, 1, 0};
  LargeAndSmall(std::int32_t large, std::int32_t small) {
    for (int s = 0; s < 4; ++s) scene.set(s, {1, 0, 0}, {s ? 4 * small : large, 0, 0});
    for (std::size_t k = 1; k < 4; ++k) {
      scene.polygon[k].shape.log2_area_q24 = -2 * (1 << 24);
      scene.row[0][k] = 0x40000000u;
    }
    scene.pod.log2_power_q24 = 8 << 24;
  }
  /// What the first shot takes from the large patch, by what it had.
  double shot(unsigned flags) {
    Solve solve(scene, flags);
    REQUIRE(solve.status == Status::ok);
    REQUIRE(urad::radiosity_step(&solve.state) == Status::ok);
    CHECK(urad::radiosity_audit(solve.state, nullptr));
    return double(solve.state.shot[0]) / (256.0 * scene.material[0].exitance[0]);
  }
};

}  // namespace

TEST_CASE("a patch shoots ahead what will come back to it, unless that leaves the range") {
  constexpr std::int32_t kLarge = 5 << 19;  // 5/8 of the limit
  const auto small = [](double of_limit) { return std::int32_t(of_limit * 0x1p22); };
  CHECK(LargeAndSmall(kLarge, small(0.06)).shot(URAD_OVERSHOOT) > 1.1);
  CHECK(LargeAndSmall(kLarge, small(0.06)).shot(0) == 1);
  // Both together would pass the limit.
  CHECK(LargeAndSmall(kLarge, small(0.14)).shot(URAD_OVERSHOOT) == 1);
  // What comes back is half of the limit by itself.
  CHECK(LargeAndSmall(kLarge, small(0.5)).shot(URAD_OVERSHOOT) == 1);
}

TEST_CASE("power that two mirrors throw to and fro stops the solve before its sum wraps") {
  TableScene room(2, 1, URAD_SCENE_CLOSED);
  room.set(0, {1, 1, 1}, {7 << 17, 0, 0});
  room.set(1, {1, 1, 1}, {0, 0, 0});
  room.row[0][1] = room.row[1][0] = 0xFFFFFFFFu;
  room.pod.log2_power_q24 = 10 << 24;  // 7/8 of the limit
  Solve solve(room);
  REQUIRE(solve.status == Status::ok);
  CHECK(urad::radiosity_step(&solve.state) == Status::ok);
  Status last = Status::ok;
  int shots = 1;
  for (; last == Status::ok && shots < 10; ++shots) last = urad::radiosity_step(&solve.state);
  CHECK((last == Status::overflow || last == Status::diverges));
  CHECK(shots < 5);
  CHECK(urad::radiosity_audit(solve.state, nullptr));
}

TEST_CASE("a shot of power that would pass 31 bits is refused, and nothing is shot") {
  // What has been shot so far, and what is to be shot with half of it more, must fit.
  TableScene room(3, 1, 0);
  room.set(0, {0.9, 1, 1}, {7 << 17, 0, 0});
  room.set(1, {0.9, 1, 1}, {0, 0, 0});
  room.set(2, {0.9, 0, 0}, {6 << 17, 0, 0});
  room.row[0][1] = room.row[1][0] = 0xFFFFFFFFu;
  room.pod.log2_power_q24 = 10 << 24;
  Solve solve(room);
  REQUIRE(solve.status == Status::ok);
  Status last = Status::ok;
  std::int64_t shot = 0;
  while (last == Status::ok) {
    shot = solve.state.shot[0];
    last = urad::radiosity_step(&solve.state);
  }
  CHECK(last == Status::overflow);
  CHECK(solve.state.shot[0] == shot);
  CHECK(shot + 3 * (std::int64_t{solve.state.unshot[0]} / 2) > INT32_MAX);
  CHECK(urad::radiosity_audit(solve.state, nullptr));
  CHECK(urad::radiosity_done(solve.state, 0));
}

TEST_CASE("light that is to be taken away saturates below as it does above") {
  TableScene room(2, 1, 0);
  room.set(0, {0, 0, 0}, {1 << 20, 0, 0});
  room.set(1, {0.5, 0.5, 0.5}, {0, 0, 0});
  room.row[0][1] = 0x80000000u;
  for (auto& polygon : room.polygon) polygon.shape.log2_area_q24 = -20 * (1 << 24);
  room.pod.log2_power_q24 = 29 << 24;
  Solve solve(room);
  REQUIRE(solve.status == Status::ok);
  std::int32_t kept[6];
  REQUIRE(urad::radiosity_relight_init(&solve.state, kept, sizeof kept) == Status::ok);
  while (!urad::radiosity_done(solve.state, 0))
    REQUIRE(urad::radiosity_step(&solve.state) == Status::ok);
  const std::int32_t dark[3] = {0, 0, 0};
  CHECK(urad::radiosity_set_emission(&solve.state, 0, dark) == Status::ok);
  CHECK(urad::radiosity_ambient(solve.state, 0) < -(1 << 18));
  CHECK(urad::radiosity_audit(solve.state, nullptr));
  // The scale of the scene is data, too: the same power over an area of 2^-60.
  for (auto& polygon : room.polygon) polygon.shape.log2_area_q24 = -60 * (1 << 24);
  solve.state.log2_area_q24 = -60 * (1 << 24);
  CHECK(urad::radiosity_ambient(solve.state, 0) < -(1 << 30));
  CHECK(urad::radiosity_ambient(solve.state, 1) == 0);
}

TEST_CASE("an emission beside light that has come back must leave room for both") {
  TableScene room(3, 1, 0);
  room.set(0, {0, 0, 0}, {7 << 17, 0, 0});
  room.set(1, {1, 1, 1}, {0, 0, 0});
  room.set(2, {1, 1, 1}, {0, 0, 0});
  room.row[0][1] = 0xE0000000u;
  room.pod.log2_power_q24 = 10 << 24;
  Solve solve(room);
  std::int32_t kept[9];
  REQUIRE(urad::radiosity_relight_init(&solve.state, kept, sizeof kept) == Status::ok);
  REQUIRE(urad::radiosity_step(&solve.state) == Status::ok);
  const urad_radiosity before = solve.state;
  const std::int32_t half[3] = {4 << 17, 0, 0};
  CHECK(urad::radiosity_set_emission(&solve.state, 1, half) == Status::overflow);
  CHECK(solve.state.remaining == before.remaining);
  CHECK(solve.state.unshot[3] == before.unshot[3]);
  CHECK(urad::radiosity_set_emission(&solve.state, 2, half) == Status::ok);
  CHECK(urad::radiosity_audit(solve.state, nullptr));
}

TEST_CASE(
    "the error of a solve does not depend on how bright it is, up to 200 patches at the limit") {
  std::mt19937 random(12);
  TableScene room(200, 1, URAD_SCENE_CLOSED);
  room.fill_reciprocal(random, 1);
  for (auto& polygon : room.polygon) polygon.shape.log2_area_q24 = 0;
  const auto said = [&](int log2_power) {
    for (int s = 0; s < 200; ++s) room.set(s, {0.5, 0.25, 0.5}, {300000, 300000, 300000 + s});
    room.pod.log2_power_q24 = log2_power << 24;
    Solve solve(room);
    REQUIRE(solve.status == Status::ok);
    std::vector<std::uint32_t> errors;
    for (int shot = 0; shot < 40; ++shot) {
      errors.push_back(urad::radiosity_error_uq32(solve.state));
      REQUIRE(urad::radiosity_step(&solve.state) == Status::ok);
    }
    return errors;
  };
  const std::vector<std::uint32_t> dim = said(4), bright = said(10);  // 2^10: 6e10 units a channel
  for (std::size_t k = 0; k < dim.size(); ++k)
    CHECK(bright[k] == doctest::Approx(dim[k]).epsilon(1e-3));
}
