// Geometry that moves: the light of a solve from the start, with only touched pairs made again.
#include "urad/move.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "urad/form_factor.hpp"
#include "urad/grid.hpp"
#include "urad/radiosity.hpp"
#include "weights/general.h"

namespace {

using urad::Status;

constexpr std::int32_t kHalf = 1 << 28;  // of the room
constexpr int kWall = 4, kSide = 2;      // patches along a wall and along the box
constexpr std::uint16_t kWalls = 6 * kWall * kWall, kBox = 5 * kSide * kSide;

struct Place {
  double x, z, turn;
};

/// A cube, lit from its ceiling, with a box on its floor that can be moved: all of it in RAM.
struct Room {
  std::array<urad_grid, 11> grid{};
  std::array<urad_surface, 11> surface{};
  std::array<urad_material, 4> material{};
  std::array<urad_blocker, 5> blocker{};
  std::array<urad_bounds, 3> bounds{};
  std::array<urad_point, 20> vertex{};
  urad_scene pod{};
  urad_counters counters{};
  urad::PairSource pairs{};

  explicit Room(const Place& place) {
    material[0] = {{24000, 24000, 24000}, 0, {0, 0, 0}};
    material[1] = {{24000, 4000, 4000}, 0, {0, 0, 0}};
    material[2] = {{4000, 20000, 24000}, 0, {0, 0, 0}};
    material[3] = {{6000, 6000, 6000}, 0, {900000, 800000, 500000}};
    const std::int32_t h = kHalf, s = 2 * kHalf / kWall;
    const auto wall = [&](std::size_t k, urad_point o, urad_point u, urad_point v) {
      REQUIRE(urad::grid_make(o, u, v, kWall, kWall, &grid[k]) == Status::ok);
    };
    wall(0, {-h, -h, -h}, {0, 0, s}, {s, 0, 0});  // floor, seen from above
    wall(1, {-h, h, -h}, {s, 0, 0}, {0, 0, s});   // ceiling
    wall(2, {-h, -h, -h}, {0, s, 0}, {0, 0, s});  // x
    wall(3, {h, -h, -h}, {0, 0, s}, {0, s, 0});
    wall(4, {-h, -h, -h}, {s, 0, 0}, {0, s, 0});  // z
    wall(5, {-h, -h, h}, {0, s, 0}, {s, 0, 0});
    std::uint16_t first = 0;
    for (std::size_t k = 0; k < 11; ++k) {
      const std::uint16_t count = k < 6 ? kWall * kWall : kSide * kSide;
      const auto paint = std::uint16_t(k == 1 ? 3 : k == 2 ? 1 : k >= 6 ? 2 : 0);
      surface[k] = {first, count, paint, URAD_SURFACE_PLANAR, &grid[k], nullptr};
      first = std::uint16_t(first + count);
    }
    for (std::size_t k = 0; k < 5; ++k)
      blocker[k].first_vertex = std::uint32_t(4 * k), blocker[k].surface = std::uint16_t(6 + k);
    bounds[0] = {{}, {}, 0, 5, 3, 0};
    bounds[1] = {{}, {}, 0, 3, 2, 0};
    bounds[2] = {{}, {}, 3, 5, 3, 0};
    put(place);
    pod.abi = URAD_SCENE_ABI_SIGHT;
    pod.flags = URAD_SCENE_CLOSED;
    pod.patch_count = kWalls + kBox;
    pod.surface_count = 11;
    pod.material_count = 4;
    pod.surface = surface.data();
    pod.material = material.data();
    pod.vertex = vertex.data();
    pod.vertex_count = 20;
    pod.blocker_count = 5, pod.bounds_count = 3;
    pod.blocker = blocker.data();
    pod.bounds = bounds.data();
    pod.log2_power_q24 = -(46 << 24);
    REQUIRE(urad::scene_check(&pod) == Status::ok);
    pairs = {&pod, &urad_general, urad::Kernel::moment, 16, 0, &counters};
  }
  Room(const Room&) = delete;

  /// Four sides and a top, as a renderer would move them.
  void put(const Place& place) {
    const double a = kHalf * 0.25, c = a * std::cos(place.turn), s = a * std::sin(place.turn);
    const double x = place.x * kHalf, z = place.z * kHalf;
    const auto at = [&](double u, double v) {
      return urad_point{std::int32_t(x + u * c - v * s), -kHalf, std::int32_t(z + u * s + v * c)};
    };
    const urad_point corner[4] = {at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)};
    const urad_point up{0, kHalf / 2 / kSide * 2, 0};
    for (std::size_t k = 0; k < 4; ++k) {
      const urad_point &p = corner[k], &q = corner[(k + 1) % 4];
      const urad_point along{(q.x - p.x) / kSide, 0, (q.z - p.z) / kSide};
      REQUIRE(urad::grid_make(p, up, along, kSide, kSide, &grid[6 + k]) == Status::ok);
    }
    const urad_point high{corner[0].x, corner[0].y + kSide * up.y, corner[0].z};
    const auto step = [&](const urad_point& q) {
      return urad_point{(q.x - corner[0].x) / kSide, 0, (q.z - corner[0].z) / kSide};
    };
    REQUIRE(urad::grid_make(high, step(corner[3]), step(corner[1]), kSide, kSide, &grid[10]) ==
            Status::ok);
    for (std::size_t k = 0; k < 5; ++k)
      REQUIRE(urad_blocker_make(&grid[6 + k], vertex.data(), &blocker[k]) == URAD_OK);
    REQUIRE(urad_bounds_fit(bounds.data(), 3, blocker.data()) == URAD_OK);
  }
  urad_box box() const { return {bounds[0].low, bounds[0].high}; }
  urad_source source() { return {urad::pair_fill, &pairs}; }
};

struct Light {
  std::vector<std::uint32_t> memory;
  urad_radiosity state{};

  explicit Light(Room& room, unsigned flags = URAD_OVERSHOOT, std::uint16_t run = 16)
      : memory(URAD_RADIOSITY_BYTES(kWalls + kBox, 16) / 4) {
    REQUIRE(urad::radiosity_init(&state, &room.pod, room.source(), flags, run, memory.data(),
                                 memory.size() * 4) == Status::ok);
  }
  int solve(double error) {
    std::uint32_t shots = 0;
    REQUIRE(urad::radiosity_steps(&state, 20000, std::uint32_t(error * 0x1p32), &shots) ==
            Status::ok);
    CHECK(urad::radiosity_audit(state, nullptr));
    return int(shots);
  }
  std::vector<double> b() const {
    std::vector<double> values;
    for (std::uint16_t k = 0; k < kWalls + kBox; ++k) {
      const bool lamp = k / (kWall * kWall) == 1;
      for (int c = 0; c < 3; ++c)
        if (!lamp) values.push_back(urad::radiosity_get(state, k, c));
    }
    return values;
  }
};

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double off = 0, all = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    off += (a[k] - b[k]) * (a[k] - b[k]);
    all += b[k] * b[k];
  }
  return std::sqrt(off / all);
}

/// From `place` to `to`, in place.
urad_move move(Room& room, Light& light, const Place& to) {
  urad_move move{kWalls, kBox, 2, 0, {room.box(), Room(to).box()}, 0, 0};
  REQUIRE(urad_radiosity_move_begin(&light.state, &move) == URAD_OK);
  CHECK(urad::radiosity_audit(light.state, nullptr));
  room.put(to);
  REQUIRE(urad_radiosity_move_end(&light.state, &move, nullptr, nullptr) == URAD_OK);
  CHECK(urad::radiosity_audit(light.state, nullptr));
  constexpr std::uint32_t n = kWalls + kBox;
  CHECK(move.made + move.kept == n * (n - 1));
  return move;
}

}  // namespace

TEST_CASE("a box moves through a room: the light of a solve from the start, in fewer shots") {
  for (const unsigned flags : {0u, unsigned{URAD_OVERSHOOT}}) {
    Room room({-0.4, -0.4, 0.2});
    Light light(room, flags);
    light.solve(1e-4);
    for (const Place& to : {Place{-0.2, -0.4, 0.3}, Place{0.2, 0.1, 1.1}, Place{0.5, 0.5, 0}}) {
      Room other(to);
      Light truth(other, flags), scratch(other, flags);
      truth.solve(1e-5);
      const int all = scratch.solve(0.01);
      const double before = difference(light.b(), truth.b());
      const urad_move moved = move(room, light, to);
      const int shots = light.solve(0.01);
      const double after = difference(light.b(), truth.b());
      MESSAGE(moved.made << " of " << moved.made + moved.kept << " pairs, " << shots << " shots ("
                         << all << " from the start), error " << before << " -> " << after);
      CHECK(before > 0.03);
      CHECK(after < 0.01);
      CHECK(2 * shots < all);
      CHECK(moved.kept > moved.made / 2);
      light.solve(1e-5);
      // What is left: rows that a solve divides by sums up to 2^-8 off, and a shot does not see twice.
      CHECK(difference(light.b(), truth.b()) < 2e-3);
    }
  }
}

TEST_CASE("a wall of an open street moves, nothing stands between: light to the rounding") {
  const std::int32_t m = kHalf / 4;
  std::array<urad_grid, 3> grid{};
  const auto put = [&](urad_grid* wall, std::int32_t x) {
    REQUIRE(urad::grid_make({x, 0, -4 * m}, {0, 0, m}, {0, m, 0}, 8, 4, wall) == Status::ok);
  };
  REQUIRE(urad::grid_make({-2 * m, 0, -4 * m}, {0, 0, m}, {m, 0, 0}, 8, 4, &grid[0]) == Status::ok);
  REQUIRE(urad::grid_make({-2 * m, 0, -4 * m}, {0, m, 0}, {0, 0, m}, 4, 8, &grid[1]) == Status::ok);
  put(&grid[2], 3 * m);
  const std::array<urad_material, 2> material{
      {{{24000, 20000, 9000}, 0, {0, 0, 0}}, {{16000, 16000, 16000}, 0, {500000, 900000, 0}}}};
  const std::array<urad_surface, 3> surface{{{0, 32, 0, URAD_SURFACE_PLANAR, &grid[0], nullptr},
                                             {32, 32, 1, URAD_SURFACE_PLANAR, &grid[1], nullptr},
                                             {64, 32, 0, URAD_SURFACE_PLANAR, &grid[2], nullptr}}};
  urad_scene pod{};
  pod.abi = URAD_SCENE_ABI, pod.flags = URAD_SCENE_CONVEX;
  pod.patch_count = 96, pod.surface_count = 3, pod.material_count = 2;
  pod.surface = surface.data(), pod.material = material.data();
  pod.log2_power_q24 = -(44 << 24);
  REQUIRE(urad::scene_check(&pod) == Status::ok);
  urad_counters counters{};
  urad::PairSource pairs{&pod, &urad_general, urad::Kernel::moment, 0, 0, &counters};
  std::vector<std::uint32_t> memory[2];
  urad_radiosity state[2];
  const auto start = [&](int k) {
    memory[k].assign(URAD_RADIOSITY_BYTES(96, 32) / 4, 0);
    REQUIRE(urad::radiosity_init(&state[k], &pod, {urad::pair_fill, &pairs}, 0, 32,
                                 memory[k].data(), memory[k].size() * 4) == Status::ok);
    REQUIRE(urad::radiosity_steps(&state[k], 9999, 4295, nullptr) == Status::ok);
  };
  start(0);
  for (int step = 0; step < 40; ++step) {  // to and fro: errors do not add up
    urad_move move{64, 32, 0, 0, {}, 0, 0};
    REQUIRE(urad_radiosity_move_begin(&state[0], &move) == URAD_OK);
    put(&grid[2], (2 + step % 4) * m);
    REQUIRE(urad_radiosity_move_end(&state[0], &move, nullptr, nullptr) == URAD_OK);
    CHECK(move.made == 2 * 32 * 64);
    CHECK(move.kept == 2 * (96 * 95 / 2 - 32 * 64));
    REQUIRE(urad::radiosity_steps(&state[0], step % 3 ? 20u : 9999u, 4295, nullptr) == Status::ok);
    CHECK(urad::radiosity_audit(state[0], nullptr));
  }
  REQUIRE(urad::radiosity_steps(&state[0], 9999, 4295, nullptr) == Status::ok);
  start(1);
  double off = 0, all = 0;
  for (std::uint16_t k = 0; k < 96; ++k) {
    for (int c = 0; c < 2; ++c) {
      const double b = urad::radiosity_get(state[1], k, c);
      off += std::pow(urad::radiosity_get(state[0], k, c) - b, 2), all += b * b;
    }
  }
  MESSAGE("after 40 moves " << std::sqrt(off / all));
  CHECK(std::sqrt(off / all) < 1e-4);
}

TEST_CASE("pairs left alone are those that nothing changes for: the bits of making all again") {
  const unsigned seed = 11;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.6, 0.6);
  for (int k = 0; k < 6; ++k) {
    const Place from{place(random), place(random), place(random)};
    const Place to{place(random), place(random), place(random)};
    Room room(from), whole(from), apart(from), target(to);
    Light light(room), all(whole, URAD_OVERSHOOT, 5), swapped(apart);
    for (Light* l : {&light, &all, &swapped})
      REQUIRE(urad::radiosity_steps(&l->state, 40, 0, nullptr) == Status::ok);
    const urad_move some = move(room, light, to);

    urad_move every = some;
    every.box[0] = every.box[1] = {{-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}};
    REQUIRE(urad_radiosity_move_begin(&all.state, &every) == URAD_OK);
    whole.put(to);
    REQUIRE(urad_radiosity_move_end(&all.state, &every, nullptr, nullptr) == URAD_OK);
    CHECK(every.made > some.made);
    CHECK(std::equal(light.memory.begin(), light.memory.begin() + 6 * (kWalls + kBox),
                     all.memory.begin()));

    // The same by another scene, as from flash.
    urad_move by_scene = some;
    const urad_source source = target.source();
    REQUIRE(urad_radiosity_move_begin(&swapped.state, &by_scene) == URAD_OK);
    REQUIRE(urad_radiosity_move_end(&swapped.state, &by_scene, &target.pod, &source) == URAD_OK);
    CHECK(by_scene.made == some.made);
    CHECK(std::equal(light.memory.begin(), light.memory.begin() + 6 * (kWalls + kBox),
                     swapped.memory.begin()));
    CHECK(std::memcmp(&light.state.ledger, &swapped.state.ledger, sizeof(urad_ledger)) == 0);
  }
}

TEST_CASE("where nothing has moved after all, not a bit of the light is another") {
  Room room({0.1, -0.3, 0.7});
  Light light(room);
  light.solve(0.01);
  const std::vector<std::uint32_t> memory = light.memory;
  const urad_ledger ledger = light.state.ledger;
  const urad_move moved = move(room, light, {0.1, -0.3, 0.7});
  CHECK(moved.made > 2 * kBox * kWalls);
  CHECK(std::equal(memory.begin(), memory.begin() + 6 * (kWalls + kBox), light.memory.begin()));
  CHECK(std::memcmp(&ledger, &light.state.ledger, sizeof ledger) == 0);
}

TEST_CASE("between the two calls no shot is made; what is refused, and what stays") {
  Room room({0, 0, 0});
  Light light(room);
  light.solve(0.1);
  urad_move move{kWalls, kBox, 1, 0, {room.box(), {}}, 7, 7};
  const auto refused = [&](urad_move wrong) {
    return urad_radiosity_move_begin(&light.state, &wrong) == URAD_BAD_ARGUMENT;
  };
  urad_move wrong = move;
  wrong.patch_count = kBox + 1;
  CHECK(refused(wrong));
  wrong = move, wrong.box_count = 3;
  CHECK(refused(wrong));
  wrong = move, wrong.box[0].low.y = wrong.box[0].high.y + 1;
  CHECK(refused(wrong));
  wrong = move, wrong.box[0].high.z = URAD_COORDINATE_MAX + 1;
  CHECK(refused(wrong));
  CHECK(urad_radiosity_move_begin(nullptr, &move) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_move_begin(&light.state, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_move_end(&light.state, &move, nullptr, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_blocker_make(nullptr, room.vertex.data(), &room.blocker[0]) == URAD_BAD_ARGUMENT);
  CHECK(urad_bounds_fit(nullptr, 3, room.blocker.data()) == URAD_BAD_ARGUMENT);
  std::vector<std::uint8_t> codes((kWalls + kBox) * (kWalls + kBox) / 8 + 116);
  const std::vector<std::uint32_t> rows(kWalls + kBox, 0);
  const urad_visibility exported{kWalls + kBox, 1,           0, std::uint32_t(codes.size()),
                                 rows.data(),   codes.data()};
  room.pod.visibility = &exported;
  CHECK(refused(move));
  room.pod.visibility = nullptr;

  CHECK_FALSE(urad::radiosity_done(light.state, 0));
  REQUIRE(urad_radiosity_move_begin(&light.state, &move) == URAD_OK);
  CHECK(move.made + move.kept == (kWalls + kBox) * (kWalls + kBox - 1) / 2);
  CHECK(urad::radiosity_done(light.state, 0));
  CHECK(urad_radiosity_step(&light.state) == URAD_BAD_ARGUMENT);
  CHECK(refused(move));
  const urad_source none{nullptr, nullptr};
  CHECK(urad_radiosity_move_end(&light.state, &move, nullptr, &none) == URAD_BAD_ARGUMENT);
  urad_scene smaller = room.pod;
  --smaller.patch_count;
  CHECK(urad_radiosity_move_end(&light.state, &move, &smaller, nullptr) == URAD_BAD_ARGUMENT);
  REQUIRE(urad_radiosity_move_end(&light.state, &move, nullptr, nullptr) == URAD_OK);
  CHECK_FALSE(urad::radiosity_done(light.state, 0));

  // A source that fails half way: the ledger holds, and nobody goes on by mistake.
  struct Failing {
    Room* room;
    int left;
  } failing{&room, 5};
  const urad_source fails{[](void* context, std::uint16_t shooter, std::uint16_t surface,
                             std::uint16_t first, std::uint16_t count, std::uint32_t* f_uq32) {
                            auto& self = *static_cast<Failing*>(context);
                            if (self.left-- == 0) return urad_status(URAD_BAD_NET);
                            return urad::pair_fill(&self.room->pairs, shooter, surface, first,
                                                   count, f_uq32);
                          },
                          &failing};
  REQUIRE(urad_radiosity_move_begin(&light.state, &move) == URAD_OK);
  CHECK(urad_radiosity_move_end(&light.state, &move, nullptr, &fails) == URAD_BAD_NET);
  CHECK(urad::radiosity_audit(light.state, nullptr));
  CHECK(urad_radiosity_step(&light.state) == URAD_BAD_NET);
  CHECK(urad_radiosity_move_begin(&light.state, &move) == URAD_BAD_NET);
}

TEST_CASE("light beyond a patch's power is refused before it wraps") {
  Room room({0, 0, 0});
  Light light(room);
  light.solve(0.1);
  // A source that is not reciprocal, from now on: everything goes everywhere.
  const urad_source all{[](void*, std::uint16_t, std::uint16_t, std::uint16_t, std::uint16_t count,
                           std::uint32_t* f_uq32) {
                          std::fill_n(f_uq32, count, ~0u);
                          return URAD_OK;
                        },
                        nullptr};
  for (std::uint32_t k = 0; k < 3 * (kWalls + kBox); ++k) light.state.shot[k] = INT32_MAX;
  urad_move move{kWalls, kBox, 0, 0, {}, 0, 0};
  light.state.source = all;
  CHECK(urad_radiosity_move_begin(&light.state, &move) == URAD_OVERFLOW);
  CHECK(urad::radiosity_audit(light.state, nullptr));
  CHECK(urad_radiosity_step(&light.state) == URAD_OVERFLOW);
}

TEST_CASE("the outline of a grid in any direction, and the box around it") {
  urad_grid grid{};
  constexpr int kU = 3, kV = 5;
  REQUIRE(urad::grid_make({1000, -2000, 3000}, {400, 500, -600}, {-700, 800, 900}, kU, kV, &grid) ==
          Status::ok);
  urad_point vertex[6] = {};
  urad_blocker blocker{};
  blocker.first_vertex = 1;
  blocker.surface = 7;
  urad::blocker_make(grid, vertex, &blocker);
  const urad_point u{kU * 400, kU * 500, kU * -600}, v{kV * -700, kV * 800, kV * 900};
  const auto corner = [&](int of_u, int of_v) {
    return urad_point{1000 + of_u * u.x + of_v * v.x, -2000 + of_u * u.y + of_v * v.y,
                      3000 + of_u * u.z + of_v * v.z};
  };
  const auto same = [](const urad_point& a, const urad_point& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  };
  for (const urad_point& expected : {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)})
    CHECK(std::count_if(vertex + 1, vertex + 5,
                        [&](const urad_point& p) { return same(p, expected); }) == 1);
  CHECK(same(vertex[0], {0, 0, 0}));
  CHECK(same(vertex[5], {0, 0, 0}));
  CHECK(same(blocker.low, {1000 + v.x, -2000, 3000 + u.z}));
  CHECK(same(blocker.high, {1000 + u.x, -2000 + u.y + v.y, 3000 + v.z}));
  CHECK(blocker.vertex_count == 4);
  CHECK(blocker.first_vertex == 1);
  CHECK(blocker.surface == 7);
}

TEST_CASE("of a source that is not reciprocal no patch gets more than twice what was shot") {
  for (const std::int32_t shot : {INT32_MAX, -INT32_MAX}) {
    Room room({0, 0, 0});
    Light light(room);
    light.solve(0.1);
    for (std::uint32_t k = 0; k < 3 * (kWalls + kBox); ++k) light.state.shot[k] = 0;
    light.state.shot[3 * kWalls] = shot;  // of a patch of the box, a quarter of one of the walls
    light.state.source = {[](void*, std::uint16_t, std::uint16_t, std::uint16_t first,
                             std::uint16_t count, std::uint32_t* f_uq32) {
                            for (std::uint16_t k = 0; k < count; ++k)
                              f_uq32[k] = first + k == kWalls ? ~0u : 0;
                            return URAD_OK;
                          },
                          nullptr};
    // All of it to every wall patch: 2^33, held to 2^32.
    urad_move move{kWalls, kBox, 0, 0, {}, 0, 0};
    const urad_status status = urad_radiosity_move_begin(&light.state, &move);
    CHECK((status == URAD_OK || status == URAD_OVERFLOW));
    CHECK(move.made > 0);
    CHECK(urad::radiosity_audit(light.state, nullptr));
  }
}

TEST_CASE("light of one channel alone moves with what stands in it, on bent surfaces too") {
  for (int channel = 0; channel < 3; ++channel) {
    Room room({-0.3, 0.2, 0.1}), there({0.35, -0.3, 0.7});
    for (Room* one : {&room, &there}) {
      for (int c = 0; c < 3; ++c)
        if (c != channel) one->material[3].exitance[c] = 0;
      one->surface[2].flags = 0;  // as if its patches might see each other: they do not
    }
    Light light(room), fresh(there);
    light.solve(1e-3);
    fresh.solve(1e-3);
    urad_move move{kWalls, kBox, 2, 0, {room.box(), there.box()}, 0, 0};
    REQUIRE(urad_radiosity_move_begin(&light.state, &move) == URAD_OK);
    room.put({0.35, -0.3, 0.7});
    REQUIRE(urad_radiosity_move_end(&light.state, &move, nullptr, nullptr) == URAD_OK);
    light.solve(1e-3);
    CHECK(urad::radiosity_audit(light.state, nullptr));
    for (int c = 0; c < 3; ++c) {
      double moved = 0, anew = 0;
      for (std::uint16_t k = 0; k < kWalls + kBox; ++k) {
        moved += urad::radiosity_get(light.state, k, c);
        anew += urad::radiosity_get(fresh.state, k, c);
      }
      CHECK((anew > 0) == (c == channel));
      CHECK(moved == doctest::Approx(anew).epsilon(0.01));
    }
  }
}
