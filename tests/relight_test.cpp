// Light that changes: signed shots lead to the light of a solve from the start, in as few shots as
// the goals say, and mixed lights need none.
#include "solve/relight.hpp"

#include <doctest/doctest.h>

#include "radiosity_scene.hpp"
#include "scene/builtin.hpp"
#include "solve/repair.hpp"
#include "urad/urad.h"
#include "weights/cube7.h"

namespace {

using host::Vec3;
using test::Solve;
using test::TableScene;
using urad::Status;

const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_cube7; }};

/// cube7 with repaired rows.
struct Cube {
  host::Scene scene = host::load_scene("cube7");
  host::EngineRows rows;

  Cube() {
    host::FixedScene fixed(scene);
    const host::MethodSpec net = host::parse_method("net");
    rows = host::engine_rows(fixed, net, kNets, {}, 0);
    Eigen::MatrixXd f(rows.patches, rows.patches);
    for (std::size_t i = 0; i < rows.patches; ++i) {
      for (std::size_t j = 0; j < rows.patches; ++j)
        f(Eigen::Index(i), Eigen::Index(j)) = rows(i, j);
    }
    fixed.set_scale(host::symmetric_scale(scene, f));
    rows = host::engine_rows(fixed, net, kNets, {}, 0);
  }
  int material(const std::string& name) const {
    for (std::size_t k = 0; k < scene.materials.size(); ++k)
      if (scene.materials[k].name == name) return int(k);
    return -1;
  }
  const host::Surface& lamp() const {
    for (const host::Surface& surface : scene.surfaces)
      if (scene.materials[std::size_t(surface.material)].exitance != Vec3(0)) return surface;
    throw "no lamp";
  }
};

/// Lets the light of a solve be changed; the memory that takes has to live as long.
std::vector<std::int32_t> relight(Solve* solve) {
  std::vector<std::int32_t> memory(3 * std::size_t(solve->state.scene->patch_count));
  REQUIRE(urad::radiosity_relight_init(&solve->state, memory.data(), memory.size() * 4) ==
          Status::ok);
  return memory;
}

void light_column(const Cube& cube, host::Relighting* light, int column) {
  const host::Surface& lamp = cube.lamp();
  for (int k = 0; k < lamp.patch_count; ++k) {
    const bool lit = k % lamp.grid->count_u == column;
    light->emit(std::size_t(lamp.first_patch + k), lit ? Vec3(1) : Vec3(0));
  }
}

int shots_to(host::Relighting* light, double error) {
  const std::vector<Vec3> truth = light->converged();
  int shots = 0;
  while (light->error(truth) > error) {
    if (light->step(1) == 0 || ++shots == 5000) return 5000;  // not reached
  }
  return shots;
}

}  // namespace

TEST_CASE("cube7: a strip of light moves by a column, a red wall turns green") {
  const Cube cube;
  const int columns = cube.lamp().grid->count_u;
  int inner = 0, outer = 0;
  host::Relighting light(cube.scene, cube.rows, true);
  light_column(cube, &light, 0);
  shots_to(&light, 1e-3);
  for (int move = 1; move < 2 * columns - 1; ++move) {  // there and back
    const int column = move < columns ? move : 2 * columns - 2 - move;
    light_column(cube, &light, column);
    const double before = light.error(light.converged());
    CHECK(before > 0.2);
    const int shots = shots_to(&light, 0.02);
    const bool edge =
        move == 1 || move == columns - 1 || move == columns || move == 2 * columns - 2;
    (edge ? outer : inner) = std::max(edge ? outer : inner, shots);
    REQUIRE(shots_to(&light, 1e-3) < 5000);
  }
  MESSAGE("strip: back to 2 % in " << inner << " shots at most, " << outer << " at the edges");
  CHECK(inner <= 100);
  CHECK(outer <= 130);
  CHECK(urad::radiosity_audit(light.state(), nullptr));

  host::Relighting wall(cube.scene, cube.rows, true);
  const int scratch = shots_to(&wall, 0.01);
  shots_to(&wall, 1e-3);
  wall.paint(cube.material("red"), Vec3(0.1, 0.75, 0.1));
  CHECK(wall.error(wall.converged()) > 0.1);
  const int shots = shots_to(&wall, 0.01);
  MESSAGE("wall: back to 1 % in " << shots << " shots; from the start " << scratch);
  CHECK(shots <= 450);
  CHECK(shots_to(&wall, 1e-3) < 5000);
  CHECK(urad::radiosity_audit(wall.state(), nullptr));
}

TEST_CASE("after any changes: the light of a solve from the start, and a ledger that balances") {
  for (const unsigned flags : {0u, unsigned{URAD_OVERSHOOT}}) {
    std::mt19937 random(31 + flags);
    TableScene room(6, 9, URAD_SCENE_CLOSED);
    room.fill_reciprocal(random, 1);
    test::furnish(&room);
    Solve solve(room, flags);
    const std::vector<std::int32_t> memory = relight(&solve);
    solve.run(0.01);
    for (int change = 0; change < 12; ++change) {
      CAPTURE(flags);
      CAPTURE(change);
      if (change % 2) {
        const std::int32_t e[3] = {std::int32_t(random() % 900000), 0,
                                   std::int32_t(random() % 400000)};
        for (int k = 0; k < 9; ++k) {
          CHECK(urad::radiosity_set_emission(&solve.state, std::uint16_t(k), e) == Status::ok);
        }
        room.set(0, {0, 0, 0}, {e[0], e[1], e[2]});
      } else {
        std::uint16_t rho[3];
        for (auto& r : rho) r = std::uint16_t(1000 + random() % 25000);
        urad_material* wall = &room.material[1 + random() % 5];
        CHECK(urad::radiosity_set_reflectance(&solve.state, wall, rho) == Status::ok);
        CHECK(wall->reflectance_uq15[1] == rho[1]);
      }
      CHECK(urad::radiosity_audit(solve.state, nullptr));
      if (change % 3 == 2) {  // at times the next change comes before this one is done
        std::uint32_t shots = 0;
        CHECK(urad::radiosity_steps(&solve.state, 20, 0, &shots) == Status::ok);
        CHECK(shots == 20);
        continue;
      }
      solve.run(1e-5);
      CHECK(solve.status == Status::ok);
      CHECK(urad::radiosity_audit(solve.state, nullptr));
      INFO("rms ", solve.relative_rms());
      CHECK(solve.relative_rms() < 3e-3);
    }
  }
}

TEST_CASE("a lamp switched off and on again, and what is refused") {
  std::mt19937 random(5);
  TableScene room(6, 9, URAD_SCENE_CLOSED);
  room.fill_reciprocal(random, 1);
  test::furnish(&room);
  Solve solve(room);
  const std::int32_t off[3] = {0, 0, 0}, on[3] = {960000, 800000, 480000}, low[3] = {0, -1, 0},
                     high[3] = {0, (1 << 30) + 1, 0}, bright[3] = {1 << 30, 0, 0};
  std::vector<std::int32_t> memory(3 * 54);
  CHECK(urad::radiosity_set_emission(&solve.state, 0, on) == Status::bad_argument);
  CHECK(urad::radiosity_relight_init(&solve.state, memory.data(), memory.size() * 4 - 4) ==
        Status::out_of_memory);
  REQUIRE(urad_radiosity_relight_init(&solve.state, memory.data(), memory.size() * 4) == URAD_OK);
  solve.run(1e-5);
  for (std::uint16_t k = 0; k < 9; ++k)
    CHECK(urad_radiosity_set_emission(&solve.state, k, off) == URAD_OK);
  solve.run(0, 20000);
  for (int k = 9; k < 54; ++k)  // dark but for the roundings of a few hundred shots
    CHECK(std::abs(urad::radiosity_get(solve.state, std::uint16_t(k), 0)) < 200);
  for (std::uint16_t k = 0; k < 9; ++k)
    CHECK(urad_radiosity_set_emission(&solve.state, k, on) == URAD_OK);
  solve.run(1e-5);
  CHECK(solve.relative_rms() < 3e-3);

  const urad_radiosity before = solve.state;
  const std::vector<std::uint32_t> power = solve.memory;
  const std::uint16_t full[3] = {32768, 32768, 32768}, over[3] = {32769, 0, 0};
  urad_material stranger = room.material[1];
  CHECK(urad_radiosity_set_emission(&solve.state, 54, on) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_set_emission(&solve.state, 0, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_set_emission(&solve.state, 0, low) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_set_emission(&solve.state, 0, high) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_set_emission(&solve.state, 0, bright) == URAD_OVERFLOW);
  CHECK(urad_radiosity_set_reflectance(&solve.state, &stranger, full) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_set_reflectance(&solve.state, &room.material[1], over) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_set_reflectance(nullptr, &room.material[1], full) == URAD_BAD_ARGUMENT);
  CHECK(solve.memory == power);
  CHECK(test::same_bytes(before, solve.state));
}

TEST_CASE("a wall that was black reflects as from the start, in any channel") {
  for (const unsigned flags : {0u, unsigned{URAD_OVERSHOOT}}) {
    std::mt19937 random(41 + flags);
    TableScene room(6, 9, URAD_SCENE_CLOSED);
    room.fill_reciprocal(random, 1);
    test::furnish(&room);
    room.set(2, {0, 0.6, 0}, {0, 0, 0});
    Solve solve(room, flags);
    const std::vector<std::int32_t> memory = relight(&solve);
    std::uint32_t shots = 0;
    CHECK(urad::radiosity_steps(&solve.state, 60, 0, &shots) == Status::ok);  // on the way
    const std::uint16_t grey[3] = {20000, 15000, 24000}, black[3] = {0, 0, 0};
    CHECK(urad::radiosity_set_reflectance(&solve.state, &room.material[2], grey) == Status::ok);
    CHECK(urad::radiosity_audit(solve.state, nullptr));
    solve.run(1e-5);
    INFO("rms ", solve.relative_rms());
    CHECK(solve.relative_rms() < 3e-3);
    // The lamp, too, and back again.
    CHECK(urad::radiosity_set_reflectance(&solve.state, &room.material[0], grey) == Status::ok);
    solve.run(1e-5);
    CHECK(solve.relative_rms() < 3e-3);
    CHECK(urad::radiosity_set_reflectance(&solve.state, &room.material[0], black) == Status::ok);
    CHECK(urad::radiosity_set_reflectance(&solve.state, &room.material[2], black) == Status::ok);
    solve.run(1e-5);
    CHECK(solve.relative_rms() < 3e-3);
    CHECK(urad::radiosity_audit(solve.state, nullptr));
  }
}

TEST_CASE("black channels one by one: those that stay black reflect nothing") {
  std::mt19937 random(45);
  TableScene room(6, 9, URAD_SCENE_CLOSED);
  room.fill_reciprocal(random, 1);
  test::furnish(&room);
  for (int channel = 0; channel < 3; ++channel) {
    CAPTURE(channel);
    room.set(2, {0, 0, 0}, {0, 0, 0});
    Solve solve(room);
    const std::vector<std::int32_t> memory = relight(&solve);
    solve.run(0.01);
    std::uint16_t rho[3] = {0, 0, 0};
    rho[channel] = 20000;
    CHECK(urad::radiosity_set_reflectance(&solve.state, &room.material[2], rho) == Status::ok);
    for (std::uint16_t k = 18; k < 27; ++k)
      for (int c = 0; c < 3; ++c)
        CHECK((urad::radiosity_get(solve.state, k, c) > 0) == (c == channel));
    CHECK(urad::radiosity_audit(solve.state, nullptr));
    solve.run(1e-5);
    CHECK(solve.relative_rms() < 3e-3);
  }
}

TEST_CASE("a source that fails while a wall is painted leaves everything as it was") {
  std::mt19937 random(43);
  TableScene room(6, 9, URAD_SCENE_CLOSED);
  room.fill_reciprocal(random, 1);
  test::furnish(&room);
  room.set(2, {0, 0.6, 0}, {0, 0, 0});
  Solve solve(room);
  const std::vector<std::int32_t> memory = relight(&solve);
  const auto paint = [&](std::uint16_t red, std::uint16_t green, std::uint16_t blue) {
    const std::uint16_t rho[3] = {red, green, blue};
    return urad::radiosity_set_reflectance(&solve.state, &room.material[2], rho);
  };
  solve.run(0.01);
  // Painted black after it has been white: what is undone below is known to the unit.
  REQUIRE(paint(9000, 15000, 24000) == Status::ok);
  solve.run(0.01);
  REQUIRE(paint(0, 15000, 0) == Status::ok);
  solve.run(0.001);
  const urad_radiosity before = solve.state;
  const std::vector<std::uint32_t> power = solve.memory;
  const std::size_t light = 6 * std::size_t(room.patches());  // the rest is room for a run
  constexpr int kCalls = 9 * 6;                               // a row of six runs for every patch
  for (int call = 0; call < kCalls; ++call) {
    CAPTURE(call);
    room.fail_after = call;
    CHECK(paint(20000, 12000, 9000) == Status::bad_net);
    CHECK(test::same_bytes(before, solve.state));
    CHECK(std::equal(power.begin(), power.begin() + std::ptrdiff_t(light), solve.memory.begin()));
    CHECK(room.material[2].reflectance_uq15[1] == 15000);
  }
  room.fail_after = kCalls;
  CHECK(paint(20000, 12000, 9000) == Status::ok);
  room.fail_after = -1;
  CHECK(urad::radiosity_audit(solve.state, nullptr));
  solve.run(1e-5);
  CHECK(solve.relative_rms() < 3e-3);
}

TEST_CASE("a wall that would reflect more than a patch can hold is not painted") {
  std::mt19937 random(44);
  TableScene room(6, 9, URAD_SCENE_CLOSED);
  room.fill_reciprocal(random, 1);
  test::furnish(&room);
  for (int s = 1; s < 6; ++s) room.set(s, {0, 1.0 / 32768, 1.0 / 32768}, {0, 0, 0});
  room.set(0, {0, 0, 0}, {1300000, 1300000, 1300000});
  room.row.assign(54, std::vector<std::uint32_t>(54, 0));
  // The lamp shines on one patch of the wall, from all of its own.
  for (std::size_t k = 0; k < 9; ++k) room.row[k][9] = 1u << 31, room.row[9][k] = 1u << 31;
  Solve solve(room);
  REQUIRE(solve.status == Status::ok);
  const std::vector<std::int32_t> memory = relight(&solve);
  solve.run(1e-3);
  REQUIRE(solve.status == Status::ok);
  const urad_radiosity before = solve.state;
  const std::uint16_t white[3] = {32768, 32768, 32768}, grey[3] = {3000, 3000, 3000};
  CHECK(urad::radiosity_set_reflectance(&solve.state, &room.material[1], white) ==
        Status::overflow);
  CHECK(test::same_bytes(before, solve.state));
  CHECK(room.material[1].reflectance_uq15[0] == 0);
  CHECK(urad::radiosity_set_reflectance(&solve.state, &room.material[1], grey) == Status::ok);
  CHECK(urad::radiosity_audit(solve.state, nullptr));
}

TEST_CASE("one basis per light: the mix is the light of a solve with those colours") {
  std::mt19937 random(77);
  TableScene room(6, 9, URAD_SCENE_CLOSED);
  room.fill_reciprocal(random, 1);
  test::furnish(&room);
  constexpr std::int32_t kFull = 800000;
  const auto solved = [&](std::array<std::int32_t, 3> a, std::array<std::int32_t, 3> b) {
    room.set(0, {0.2, 0.2, 0.2}, a);
    room.set(3, {0.5, 0.5, 0.5}, b);
    Solve solve(room, URAD_OVERSHOOT);
    solve.run(1e-6);
    std::vector<std::uint32_t> light;
    for (int k = 0; k < room.patches(); ++k) {
      for (int c = 0; c < 3; ++c)
        light.push_back(std::uint32_t(urad::radiosity_get(solve.state, std::uint16_t(k), c)));
    }
    return light;
  };
  std::vector<std::uint16_t> basis[2];
  for (int k = 0; k < 2; ++k) {
    const std::array<std::int32_t, 3> full{kFull, kFull, kFull}, none{0, 0, 0};
    for (const std::uint32_t b : k ? solved(none, full) : solved(full, none))
      basis[k].push_back(std::uint16_t(b >> 5));
  }
  const urad_light lights[2] = {{basis[0].data(), {32768, 16384, 0}},
                                {basis[1].data(), {8192, 32768, 24576}}};
  std::vector<std::uint32_t> mixed(basis[0].size(), 99);
  REQUIRE(urad_light_mix(lights, 2, std::uint16_t(room.patches()), mixed.data()) == URAD_OK);
  const std::vector<std::uint32_t> exact =
      solved({kFull, kFull / 2, 0}, {kFull / 4, kFull, 3 * (kFull / 4)});
  double worst = 0, most = 0;
  for (std::size_t k = 0; k < mixed.size(); ++k) {
    worst = std::max(worst, std::fabs(mixed[k] * 32.0 - exact[k]));
    most = std::max(most, double(exact[k]));
  }
  MESSAGE("worst difference " << worst << " of " << most);
  CHECK(worst < 2e-4 * most);
  CHECK(urad_light_mix(lights, 2, 54, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_light_mix(lights, 0, std::uint16_t(room.patches()), mixed.data()) == URAD_OK);
  CHECK(mixed[10] == 0);
}
