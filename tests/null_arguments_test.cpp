// Every pointer of every entry of urad.h as null, in turn; sizes too small, memory that is misaligned,
// numbers out of range: a status, and nothing written.
#include <doctest/doctest.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "hand_made_scene.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/hemicube_table.hpp"
#include "urad/hybrid.hpp"
#include "urad/move.h"
#include "urad/urad.h"
#include "weights/cube7.h"

namespace {

/// Calls `entry` with each pointer among `good` as null but for those in `optional`; all must give
/// `expected`.
template <class Result, class... Parameters>
void null_in_turn(const char* name, Result (*entry)(Parameters...), std::tuple<Parameters...> good,
                  Result expected, const std::vector<std::size_t>& optional = {}) {
  const auto with_null = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) {
    using Parameter = std::tuple_element_t<k, std::tuple<Parameters...>>;
    if constexpr (std::is_pointer_v<Parameter>) {
      if (std::find(optional.begin(), optional.end(), k) != optional.end()) return;
      auto bad = good;
      std::get<k>(bad) = nullptr;
      const Result got = std::apply(entry, bad);
      CHECK_MESSAGE(got == expected, name, ", argument ", k);
    }
  };
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    (with_null(std::integral_constant<std::size_t, k>{}), ...);
  }
  (std::index_sequence_for<Parameters...>{});
}

#define NULL_IN_TURN(entry, expected, optional, ...) \
  null_in_turn(#entry, entry, {__VA_ARGS__}, expected, optional)

using Optional = std::vector<std::size_t>;

/// A cube of 9 patches a wall, and memory for everything.
struct Room {
  host::FixedScene fixed{test::cube(3)};
  const urad_scene* scene = &fixed.pod();
  std::vector<std::uint64_t> memory = std::vector<std::uint64_t>(1 << 16);
  std::vector<std::uint32_t> light = std::vector<std::uint32_t>(1 << 12);
  std::size_t bytes = memory.size() * 8, light_bytes = light.size() * 4;
  std::vector<std::uint32_t> top = std::vector<std::uint32_t>(64), side = top;
  urad_hemicube_table table{16, top.data(), side.data()};
  urad_counters counters{};
  urad_source source{};
  urad_radiosity state{};

  void start() {
    REQUIRE(urad_pair_source_init(&source, scene, URAD_KERNEL_MOMENT, &urad_cube7, 0, &counters,
                                  memory.data(), bytes) == URAD_OK);
    REQUIRE(urad_radiosity_init(&state, scene, &source, 0, 9, light.data(), light_bytes) ==
            URAD_OK);
  }
};

}  // namespace

TEST_CASE("null scenes, nets and checksums") {
  Room room;
  std::uint32_t crc[2] = {}, f = 0;
  const urad_pose_table table{};
  CHECK(urad_scene_check(nullptr) == URAD_BAD_SCENE);
  CHECK(urad_net_check(nullptr) == URAD_BAD_NET);
  NULL_IN_TURN(urad_scene_crc32, URAD_BAD_ARGUMENT, Optional{}, room.scene, crc);
  CHECK(urad_scene_verify(nullptr, crc) != URAD_OK);
  CHECK(urad_scene_verify(room.scene, nullptr) == URAD_BAD_ARGUMENT);
  NULL_IN_TURN(urad_pose_table_check, URAD_BAD_ARGUMENT, Optional{}, &table, room.scene);
  CHECK(urad_longest_run(nullptr) == 0);
  CHECK(urad_hemicube_source_bytes(nullptr, 32, 8, 0) == 0);
  NULL_IN_TURN(urad_form_factor, URAD_BAD_ARGUMENT, (Optional{4, 7}), room.scene, 0, 20, 1,
               &urad_cube7, 0, &f, &room.counters);
  CHECK(urad_form_factor(room.scene, 54, 0, 1, nullptr, 0, &f, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor(room.scene, 0, 54, 1, nullptr, 0, &f, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor(room.scene, 0, 20, 2, nullptr, 0, &f, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor(room.scene, 0, 20, 1, nullptr, URAD_RAYS_MAX + 1, &f, nullptr) ==
        URAD_BAD_ARGUMENT);
}

TEST_CASE("null arguments of sources, and memory that is too small or misaligned") {
  Room room;
  const urad_pose_table poses{};
  void* const memory = room.memory.data();
  NULL_IN_TURN(urad_pair_source_init, URAD_BAD_ARGUMENT, Optional{3}, &room.source, room.scene, 1,
               &urad_cube7, 0, &room.counters, memory, room.bytes);
  NULL_IN_TURN(urad_pose_source_init, URAD_BAD_ARGUMENT, Optional{}, &room.source, room.scene,
               &poses, &room.counters, memory, room.bytes);
  NULL_IN_TURN(urad_hemicube_source_init, URAD_BAD_ARGUMENT, Optional{}, &room.source, room.scene,
               &room.table, 0, 0, &room.counters, memory, room.bytes);
  for (const urad_hemicube_table& bad :
       {urad_hemicube_table{16, nullptr, room.side.data()},
        urad_hemicube_table{16, room.top.data(), nullptr},
        urad_hemicube_table{14, room.top.data(), room.side.data()},
        urad_hemicube_table{130, room.top.data(), room.side.data()},
        urad_hemicube_table{17, room.top.data(), room.side.data()}})
    CHECK(urad_hemicube_source_init(&room.source, room.scene, &bad, 0, 0, &room.counters, memory,
                                    room.bytes) == URAD_BAD_ARGUMENT);
  CHECK(urad_hemicube_source_init(&room.source, room.scene, &room.table, 17, 0, &room.counters,
                                  memory, room.bytes) == URAD_BAD_ARGUMENT);
  const auto pairs = [&](void* at, std::size_t bytes) {
    return urad_pair_source_init(&room.source, room.scene, 1, nullptr, 0, &room.counters, at,
                                 bytes);
  };
  CHECK(pairs(memory, urad_pair_source_bytes() - 1) == URAD_OUT_OF_MEMORY);
  CHECK(pairs(static_cast<char*>(memory) + 1, room.bytes - 8) == URAD_OUT_OF_MEMORY);
  CHECK(pairs(memory, urad_pair_source_bytes()) == URAD_OK);
  NULL_IN_TURN(urad_pair_source_worth, URAD_BAD_ARGUMENT, Optional{}, &room.source, 1u << 26, 2);
  CHECK(urad_pair_source_worth(&room.source, 1u << 26, 7) == URAD_BAD_ARGUMENT);
  const urad_source empty{room.source.fill, nullptr};
  CHECK(urad_pair_source_worth(&empty, 1u << 26, 2) == URAD_BAD_ARGUMENT);
  const urad_source stranger{urad_fill{}, memory};
  CHECK(urad_pair_source_worth(&stranger, 1u << 26, 2) == URAD_BAD_ARGUMENT);
  const std::size_t hemicube = urad_hemicube_source_bytes(room.scene, 16, 4, 0);
  const auto cubes = [&](void* at, std::size_t bytes) {
    return urad_hemicube_source_init(&room.source, room.scene, &room.table, 4, 0, &room.counters,
                                     at, bytes);
  };
  CHECK(cubes(memory, hemicube - 1) == URAD_OUT_OF_MEMORY);
  CHECK(cubes(static_cast<char*>(memory) + 4, hemicube) == URAD_OUT_OF_MEMORY);
  CHECK(cubes(memory, hemicube) == URAD_OK);
}

TEST_CASE("a source's own function refuses null, and runs that are none") {
  Room room;
  room.start();
  std::uint32_t f[9] = {};
  const auto fill = [&](std::uint16_t shooter, std::uint16_t surface, std::uint16_t first,
                        std::uint16_t count) {
    return room.source.fill(room.source.context, shooter, surface, first, count, f);
  };
  CHECK(fill(0, 1, 9, 9) == URAD_OK);
  CHECK(fill(54, 1, 9, 9) == URAD_BAD_ARGUMENT);
  CHECK(fill(0, 6, 9, 9) == URAD_BAD_ARGUMENT);
  CHECK(fill(0, 1, 8, 9) == URAD_BAD_ARGUMENT);
  CHECK(fill(0, 1, 10, 9) == URAD_BAD_ARGUMENT);
  CHECK(room.source.fill(nullptr, 0, 1, 9, 9, f) == URAD_BAD_ARGUMENT);
  CHECK(room.source.fill(room.source.context, 0, 1, 9, 9, nullptr) == URAD_BAD_ARGUMENT);
}

TEST_CASE("hemicubes and hybrids refuse null, runs that are none, and rows that are not kept") {
  Room room;
  std::vector<std::uint64_t> more(64);
  std::uint32_t f[9] = {};
  urad_source hybrid{};
  const auto hemicube = [&](std::uint16_t rows, unsigned flags) {
    REQUIRE(urad_hemicube_source_init(&room.source, room.scene, &room.table, rows, flags,
                                      &room.counters, room.memory.data(), room.bytes) == URAD_OK);
  };
  const auto refuses_what_is_none = [&](const urad_source& source) {
    CHECK(source.fill(source.context, 0, 1, 9, 9, f) == URAD_OK);
    CHECK(source.fill(nullptr, 0, 1, 9, 9, f) == URAD_BAD_ARGUMENT);
    CHECK(source.fill(source.context, 0, 1, 9, 9, nullptr) == URAD_BAD_ARGUMENT);
    CHECK(source.fill(source.context, 54, 1, 9, 9, f) == URAD_BAD_ARGUMENT);
    CHECK(source.fill(source.context, 0, 6, 9, 9, f) == URAD_BAD_ARGUMENT);
    CHECK(source.fill(source.context, 0, 1, 8, 9, f) == URAD_BAD_ARGUMENT);
    CHECK(source.fill(source.context, 0, 1, 10, 9, f) == URAD_BAD_ARGUMENT);
  };
  hemicube(4, URAD_HEMICUBE_COVERAGE);
  refuses_what_is_none(room.source);
  void* const memory = more.data();
  const std::size_t bytes = more.size() * 8;
  NULL_IN_TURN(urad_hybrid_source_init, URAD_BAD_ARGUMENT, (Optional{3}), &hybrid,
               static_cast<const urad_source*>(&room.source), 1, &urad_cube7, 16, 0, memory, bytes);
  const auto init = [&](const urad_source& cells, unsigned kernel, std::uint16_t rays,
                        std::size_t room_for) {
    return urad_hybrid_source_init(&hybrid, &cells, kernel, &urad_cube7, rays, 0, memory, room_for);
  };
  CHECK(init({nullptr, room.source.context}, 1, 16, bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(room.source, 2, 16, bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(room.source, 1, 0, bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(room.source, 1, URAD_RAYS_MAX + 1, bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(room.source, 1, 16, urad_hybrid_source_bytes() - 1) == URAD_OUT_OF_MEMORY);
  CHECK(init(room.source, 1, 16, bytes) == URAD_OK);
  refuses_what_is_none(hybrid);
  // Of near pairs alone, a hybrid is a hemicube with a row changed.
  REQUIRE(urad_hybrid_source_init(&hybrid, &room.source, 1, &urad_cube7, 16, 65536 / 27, memory,
                                  bytes) == URAD_OK);
  refuses_what_is_none(hybrid);
}

TEST_CASE("an item buffer that is kept for no row, and cells outside of it, are refused") {
  Room room;
  urad::HemicubeSource cells{};
  const urad::HemicubeTable table{16, room.top.data(), room.side.data()};
  const auto init = [&](urad::HemicubeSource* source, const urad_scene* scene, std::uint16_t rows,
                        urad_counters* counters) {
    return urad::hemicube_init(source, scene, table, rows, 0, room.memory.data(), room.bytes,
                               counters);
  };
  using urad::Status;
  CHECK(init(nullptr, room.scene, 4, &room.counters) == Status::bad_argument);
  CHECK(init(&cells, nullptr, 4, &room.counters) == Status::bad_argument);
  CHECK(init(&cells, room.scene, 4, nullptr) == Status::bad_argument);
  for (const urad::HemicubeTable& half : {urad::HemicubeTable{16, nullptr, room.side.data()},
                                          urad::HemicubeTable{16, room.top.data(), nullptr}})
    CHECK(urad::hemicube_init(&cells, room.scene, half, 4, 0, room.memory.data(), room.bytes,
                              &room.counters) == Status::bad_argument);
  REQUIRE(init(&cells, room.scene, 0, &room.counters) == Status::ok);
  CHECK(urad::hemicube_items(&cells, 0, 0, 0) == Status::bad_argument);
  REQUIRE(init(&cells, room.scene, 4, &room.counters) == Status::ok);
  CHECK(urad::hemicube_items(nullptr, 0, 0, 0) == Status::bad_argument);
  CHECK(urad::hemicube_items(&cells, 54, 0, 0) == Status::bad_argument);
  CHECK(urad::hemicube_items(&cells, 0, -1, 0) == Status::bad_argument);
  CHECK(urad::hemicube_items(&cells, 0, 5, 0) == Status::bad_argument);
  CHECK(urad::hemicube_items(&cells, 0, 0, 16) == Status::bad_argument);
  CHECK(urad::hemicube_items(&cells, 0, 4, 14) == Status::ok);  // a band that the face ends
  CHECK(urad::hemicube_items(&cells, 0, 0, 4) == Status::ok);
  CHECK(urad::hemicube_render(nullptr, 0) == Status::bad_argument);
  urad::HybridSource hybrid{};
  CHECK(urad::hybrid_init(nullptr, &cells, urad::Kernel::moment, nullptr, 16, 0) ==
        Status::bad_argument);
  CHECK(urad::hybrid_init(&hybrid, nullptr, urad::Kernel::moment, nullptr, 16, 0) ==
        Status::bad_argument);
}

TEST_CASE("null arguments of the solver and of light that changes") {
  Room room;
  room.start();
  std::int32_t b = 0;
  const std::int32_t dark[3] = {0, 0, 0}, negative[3] = {0, -1, 0}, huge[3] = {0, 0, (1 << 30) + 1};
  const std::uint16_t grey[3] = {9, 9, 9}, beyond[3] = {9, 32769, 9};
  urad_radiosity other{};
  NULL_IN_TURN(urad_radiosity_init, URAD_BAD_ARGUMENT, (Optional{}), &other, room.scene,
               &room.source, 0, 9, room.light.data(), room.light_bytes);
  CHECK(urad_radiosity_init(&other, room.scene, &room.source, 0, 0, room.light.data(),
                            room.light_bytes) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_init(&other, room.scene, &room.source, 0, 9, room.light.data(), 100) ==
        URAD_OUT_OF_MEMORY);
  CHECK(urad_radiosity_step(nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_steps(nullptr, 1, 0, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_done(nullptr, 0) == 1);
  CHECK(urad_radiosity_error_uq32(nullptr) == 0);
  CHECK(urad_radiosity_audit(nullptr, nullptr) == 0);
  NULL_IN_TURN(urad_radiosity_get, URAD_BAD_ARGUMENT, Optional{}, &room.state, 0, 0, &b);
  NULL_IN_TURN(urad_radiosity_display, URAD_BAD_ARGUMENT, Optional{}, &room.state, 0, 0, &b);
  CHECK(urad_radiosity_get(&room.state, 54, 0, &b) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_get(&room.state, 0, 3, &b) == URAD_BAD_ARGUMENT);
  std::vector<std::uint32_t> kept(URAD_RELIGHT_BYTES(54) / 4);
  auto* const wall = const_cast<urad_material*>(room.scene->material);
  CHECK(urad_radiosity_set_emission(&room.state, 0, dark) ==
        URAD_BAD_ARGUMENT);  // nothing kept yet
  CHECK(urad_radiosity_set_reflectance(&room.state, wall, grey) == URAD_BAD_ARGUMENT);
  NULL_IN_TURN(urad_radiosity_relight_init, URAD_BAD_ARGUMENT, Optional{}, &room.state,
               static_cast<void*>(kept.data()), kept.size() * 4);
  CHECK(urad_radiosity_relight_init(&room.state, kept.data(), kept.size() * 4 - 1) ==
        URAD_OUT_OF_MEMORY);
  CHECK(urad_radiosity_relight_init(&room.state, reinterpret_cast<char*>(kept.data()) + 1,
                                    kept.size() * 4) == URAD_OUT_OF_MEMORY);
  REQUIRE(urad_radiosity_relight_init(&room.state, kept.data(), kept.size() * 4) == URAD_OK);
  NULL_IN_TURN(urad_radiosity_set_emission, URAD_BAD_ARGUMENT, Optional{}, &room.state, 0,
               static_cast<const std::int32_t*>(dark));
  CHECK(urad_radiosity_set_emission(&room.state, 54, dark) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_set_emission(&room.state, 0, negative) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_set_emission(&room.state, 0, huge) == URAD_BAD_ARGUMENT);
  urad_material stranger{};
  NULL_IN_TURN(urad_radiosity_set_reflectance, URAD_BAD_ARGUMENT, Optional{}, &room.state,
               &stranger, static_cast<const std::uint16_t*>(grey));
  CHECK(urad_radiosity_set_reflectance(&room.state, &stranger, grey) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_set_reflectance(&room.state, wall, beyond) == URAD_BAD_ARGUMENT);
}

TEST_CASE("null grids and lights") {
  urad_grid grid{};
  CHECK(urad_grid_make({0, 0, 0}, {9, 0, 0}, {0, 9, 0}, 1, 1, nullptr) == URAD_BAD_ARGUMENT);
  const std::int32_t most = URAD_COORDINATE_MAX;
  for (const urad_point& origin : {urad_point{-most - 1, 0, 0}, urad_point{0, -most - 1, 0},
                                   urad_point{0, 0, -most - 1}, urad_point{0, 0, most + 1}})
    CHECK(urad_grid_make(origin, {99, 0, 0}, {0, 99, 0}, 1, 1, &grid) == URAD_BAD_ARGUMENT);
  for (const urad_point& step : {urad_point{most, 0, 0}, urad_point{-most, 0, 0},
                                 urad_point{0, 0, most}, urad_point{0, 0, -most}})
    CHECK(urad_grid_make({0, 0, 0}, step, {0, 99, 0}, 2, 2, &grid) == URAD_BAD_ARGUMENT);
  CHECK(grid.count_u == 0);
  std::uint32_t radiosity[3] = {};
  const std::uint16_t basis[3] = {5, 5, 5};
  urad_light light{};
  light.basis = basis;
  NULL_IN_TURN(urad_light_mix, URAD_BAD_ARGUMENT, Optional{},
               static_cast<const urad_light*>(&light), 1, 1,
               static_cast<std::uint32_t*>(radiosity));
  CHECK(urad_light_mix(&light, 32768, 1, radiosity) == URAD_BAD_ARGUMENT);
  light.basis = nullptr;
  CHECK(urad_light_mix(&light, 1, 1, radiosity) == URAD_BAD_ARGUMENT);
}

TEST_CASE("null arguments of geometry that moves, and boxes that are none") {
  Room room;
  room.start();
  urad_grid grid{};
  urad_point vertex[4] = {};
  urad_blocker blocker{};
  urad_bounds bounds{};
  NULL_IN_TURN(urad_blocker_make, URAD_BAD_ARGUMENT, Optional{},
               static_cast<const urad_grid*>(&grid), vertex, &blocker);
  NULL_IN_TURN(urad_bounds_fit, URAD_BAD_ARGUMENT, Optional{}, &bounds, 1,
               static_cast<const urad_blocker*>(&blocker));
  urad_move move{};
  move.patch_count = 9;
  CHECK(urad_radiosity_move_begin(nullptr, &move) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_move_begin(&room.state, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_move_end(&room.state, &move, nullptr, nullptr) ==
        URAD_BAD_ARGUMENT);  // nothing was begun
  const std::int32_t most = URAD_COORDINATE_MAX;
  for (int axis = 0; axis < 3; ++axis) {
    for (const auto& [low, high] :
         {std::pair{-most - 1, 0}, std::pair{0, most + 1}, std::pair{1, 0}}) {
      urad_move bad = move;
      bad.box_count = 1;
      const auto set = [axis](urad_point* p, std::int32_t x) {
        (axis == 0 ? p->x : axis == 1 ? p->y : p->z) = x;
      };
      set(&bad.box[0].low, low), set(&bad.box[0].high, high);
      CHECK(urad_radiosity_move_begin(&room.state, &bad) == URAD_BAD_ARGUMENT);
    }
  }
  REQUIRE(urad_radiosity_move_begin(&room.state, &move) == URAD_OK);
  std::vector<std::uint32_t> kept(URAD_RELIGHT_BYTES(54) / 4);
  const std::uint16_t grey[3] = {9, 9, 9};
  REQUIRE(urad_radiosity_relight_init(&room.state, kept.data(), kept.size() * 4) == URAD_OK);
  CHECK(urad_radiosity_set_reflectance(&room.state,
                                       const_cast<urad_material*>(room.scene->material),
                                       grey) == URAD_BAD_ARGUMENT);  // not while something moves
  const urad_source unfilled{nullptr, nullptr};
  CHECK(urad_radiosity_move_end(nullptr, &move, nullptr, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_move_end(&room.state, nullptr, nullptr, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_move_end(&room.state, &move, nullptr, &unfilled) == URAD_BAD_ARGUMENT);
  urad_scene other = *room.scene;
  other.patch_count = 53;
  CHECK(urad_radiosity_move_end(&room.state, &move, &other, nullptr) == URAD_BAD_ARGUMENT);
  const urad_visibility sight{};
  other = *room.scene;
  other.abi = URAD_SCENE_ABI_SIGHT, other.visibility = &sight;  // of where things were
  CHECK(urad_radiosity_move_end(&room.state, &move, &other, nullptr) == URAD_BAD_ARGUMENT);
  room.state.status = URAD_DIVERGES;
  CHECK(urad_radiosity_move_end(&room.state, &move, nullptr, nullptr) == URAD_DIVERGES);
  room.state.status = URAD_OK;
  CHECK(urad_radiosity_move_end(&room.state, &move, nullptr, nullptr) == URAD_OK);
  CHECK(urad_radiosity_audit(&room.state, nullptr) == 1);
}
