#include "urad/urad.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "hand_made_scene.hpp"
#include "radiosity_scene.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/form_factor.hpp"
#include "urad/hemicube_table.hpp"
#include "urad/hybrid.hpp"
#include "urad/network.hpp"

extern "C" {
urad_status c99_solve(const urad_scene* scene, const urad_source* source, uint32_t* memory,
                      size_t bytes, uint32_t error_uq32, int32_t* exitance, int* balanced);
size_t c99_static_bytes(void);
}

namespace {

/// Two unit squares facing each other at side distance, in scene units of 2^-20 sides: F =
/// 0.199825.
struct FacingSquares {
  static constexpr int32_t kSide = 1 << 20;
  urad_grid grid[2];
  urad_surface surface[2];
  urad_material material[1];
  urad_scene scene{};

  FacingSquares() {
    for (int k = 0; k < 2; ++k) {
      urad_shape shape{};
      shape.normal_q30 = {0, 0, k ? -(1 << 30) : 1 << 30};
      shape.log2_area_q24 = 40 << 24;
      shape.log2_spread_q24 = int32_t((40 - std::log2(6.0)) * 0x1p24);  // tr M = s^2 / 6
      shape.spread_q15[0] = shape.spread_q15[1] = 16384;
      shape.fill_uq15 = 32768 / 3;
      const urad_point u{kSide, 0, 0}, v{0, kSide, 0};
      grid[k] = {{0, 0, k ? kSide : 0}, k ? v : u, k ? u : v, 1, 1, shape};
      surface[k] = {uint16_t(k), 1, 0, URAD_SURFACE_PLANAR, &grid[k], nullptr};
    }
    material[0] = {{16384, 16384, 16384}, 0, {1000000, 500000, 0}};
    scene.abi = URAD_SCENE_ABI;
    scene.flags = URAD_SCENE_CONVEX;
    scene.patch_count = scene.surface_count = 2;
    scene.material_count = 1;
    scene.surface = surface;
    scene.material = material;
    scene.log2_power_q24 = -(34 << 24);
  }
  FacingSquares(const FacingSquares&) = delete;
};

}  // namespace

TEST_CASE("C: second moments that no patch has are refused: the bend of a pair overflowed") {
  for (int k = 3; k < 6; ++k) {
    FacingSquares squares;
    CHECK(urad_scene_check(&squares.scene) == URAD_OK);
    squares.grid[1].shape.spread_q15[k] = -32768;
    CHECK(urad_scene_check(&squares.scene) == URAD_BAD_SCENE);
    squares.grid[1].shape.spread_q15[k] = k == 3 ? 16384 : 0;
    CHECK(urad_scene_check(&squares.scene) == URAD_OK);
    squares.grid[1].shape.spread_q15[k] = k == 3 ? 16389 : 300;
    CHECK(urad_scene_check(&squares.scene) == URAD_BAD_SCENE);
  }
}

TEST_CASE("C: scene and net checks") {
  FacingSquares squares;
  CHECK(urad_scene_check(&squares.scene) == URAD_OK);
  CHECK(urad_scene_check(nullptr) == URAD_BAD_SCENE);
  squares.scene.abi = 77;
  CHECK(urad_scene_check(&squares.scene) == URAD_BAD_SCENE);
  CHECK(urad_net_check(nullptr) == URAD_BAD_NET);
  const urad_net empty{};
  CHECK(urad_net_check(&empty) == URAD_BAD_NET);
}

TEST_CASE("C: form factor of one pair, and every bad argument") {
  const FacingSquares squares;
  uint32_t f = 0;
  urad_counters counters{};
  REQUIRE(urad_form_factor(&squares.scene, 0, 1, URAD_KERNEL_MOMENT, nullptr, 0, &f, &counters) ==
          URAD_OK);
  CHECK(f / 0x1p32 ==
        doctest::Approx(0.199825).epsilon(0.1));  // the kernel alone, in its near field
  CHECK(counters.evaluated == 1);
  uint32_t back = 0;
  CHECK(urad_form_factor(&squares.scene, 1, 0, URAD_KERNEL_MOMENT, nullptr, 0, &back, nullptr) ==
        URAD_OK);
  CHECK(back == f);
  CHECK(urad_form_factor(&squares.scene, 1, 1, URAD_KERNEL_MOMENT, nullptr, 0, &back, nullptr) ==
        URAD_OK);
  CHECK(back == 0);

  uint32_t kept = 4711;
  const urad_scene* s = &squares.scene;
  CHECK(urad_form_factor(nullptr, 0, 1, 1, nullptr, 0, &kept, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor(s, 2, 1, 1, nullptr, 0, &kept, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor(s, 0, 2, 1, nullptr, 0, &kept, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor(s, 0, 1, 2, nullptr, 0, &kept, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor(s, 0, 1, 1, nullptr, URAD_RAYS_MAX + 1, &kept, nullptr) ==
        URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor(s, 0, 1, 1, nullptr, 0, nullptr, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(kept == 4711);
}

TEST_CASE("C: a pair source feeds a solve") {
  const FacingSquares squares;
  std::vector<uint64_t> memory(urad_pair_source_bytes() / 8 + 1);
  const size_t bytes = urad_pair_source_bytes();
  urad_counters counters{};
  urad_source source{nullptr, nullptr};
  const auto init = [&](const urad_scene* scene, unsigned kernel, uint16_t rays,
                        urad_counters* count, void* at, size_t size) {
    return urad_pair_source_init(&source, scene, kernel, nullptr, rays, count, at, size);
  };
  CHECK(init(nullptr, 1, 0, &counters, memory.data(), bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(&squares.scene, 9, 0, &counters, memory.data(), bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(&squares.scene, 1, 2000, &counters, memory.data(), bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(&squares.scene, 1, 0, nullptr, memory.data(), bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(&squares.scene, 1, 0, &counters, nullptr, bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(&squares.scene, 1, 0, &counters, memory.data(), bytes - 1) == URAD_OUT_OF_MEMORY);
  CHECK(init(&squares.scene, 1, 0, &counters, reinterpret_cast<char*>(memory.data()) + 1, bytes) ==
        URAD_OUT_OF_MEMORY);
  CHECK(urad_pair_source_init(nullptr, &squares.scene, 1, nullptr, 0, &counters, memory.data(),
                              bytes) == URAD_BAD_ARGUMENT);
  CHECK((source.fill == nullptr));
  for (const uint64_t word : memory) CHECK(word == 0);
  REQUIRE(init(&squares.scene, 1, 0, &counters, memory.data(), bytes) == URAD_OK);

  uint32_t f = 0;
  REQUIRE(urad_form_factor(&squares.scene, 0, 1, 1, nullptr, 0, &f, nullptr) == URAD_OK);
  uint32_t light[URAD_RADIOSITY_BYTES(2, 1) / 4];
  int32_t exitance[2][3];
  int balanced = 0;
  REQUIRE(c99_solve(&squares.scene, &source, light, sizeof light, URAD_PERCENT / 10000,
                    &exitance[0][0], &balanced) == URAD_OK);
  CHECK(balanced == 1);
  // By symmetry B = E + rho F B.
  const double gain = 1 / (1 - 0.5 * f / 0x1p32);
  for (int patch = 0; patch < 2; ++patch) {
    CHECK(exitance[patch][0] == doctest::Approx(1000000 * gain).epsilon(2e-5));
    CHECK(exitance[patch][1] == doctest::Approx(500000 * gain).epsilon(2e-5));
    CHECK(exitance[patch][2] == 0);
  }
  CHECK(counters.evaluated + counters.skipped_same + counters.skipped_facing > 0);
  CHECK(c99_static_bytes() == urad::radiosity_bytes(294, 49));
}

TEST_CASE("C: hemicube and hybrid sources give the factors of the C++ objects") {
  const FacingSquares squares;
  static constexpr auto cells = urad::make_hemicube_table<32>();
  const urad_hemicube_table table{32, cells.top, cells.side};
  const urad_scene* scene = &squares.scene;
  urad_counters counters{};
  urad_source hemicube{nullptr, nullptr}, hybrid{nullptr, nullptr};
  const unsigned flags = URAD_HEMICUBE_TURNED | URAD_HEMICUBE_COVERAGE;
  const size_t bytes = urad_hemicube_source_bytes(scene, 32, 8, flags);
  std::vector<uint64_t> memory(bytes / 8 + 1), extra(urad_hybrid_source_bytes() / 8 + 1);

  CHECK(urad_hemicube_source_bytes(nullptr, 32, 8, flags) == 0);
  const auto init = [&](const urad_hemicube_table* t, uint16_t rows, unsigned with, size_t size) {
    return urad_hemicube_source_init(&hemicube, scene, t, rows, with, &counters, memory.data(),
                                     size);
  };
  CHECK(init(nullptr, 8, flags, bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(&table, 33, flags, bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(&table, 8, 4, bytes) == URAD_BAD_ARGUMENT);
  CHECK(init(&table, 8, flags, bytes - 1) == URAD_OUT_OF_MEMORY);
  CHECK(init(&table, 8, flags, 3) == URAD_OUT_OF_MEMORY);
  CHECK(urad_hybrid_source_init(&hybrid, &hemicube, 1, nullptr, 16, 0, extra.data(),
                                extra.size() * 8) ==
        URAD_BAD_ARGUMENT);  // not a hemicube source yet
  REQUIRE(init(&table, 8, flags, bytes) == URAD_OK);

  uint32_t f[1] = {0};
  REQUIRE(hemicube.fill(hemicube.context, 0, 1, 1, 1, f) == URAD_OK);
  CHECK(f[0] / 0x1p32 ==
        doctest::Approx(0.2395).epsilon(0.02));  // from the centre, not the mean over the square

  CHECK(urad_hybrid_source_init(&hybrid, &hemicube, 2, nullptr, 16, 0, extra.data(),
                                extra.size() * 8) == URAD_BAD_ARGUMENT);
  CHECK(urad_hybrid_source_init(&hybrid, &hemicube, 1, nullptr, 16, 0, extra.data(),
                                urad_hybrid_source_bytes() - 1) == URAD_OUT_OF_MEMORY);
  REQUIRE(urad_hybrid_source_init(&hybrid, &hemicube, 1, nullptr, 16, 0, extra.data(),
                                  extra.size() * 8) == URAD_OK);
  uint32_t kernel = 0;
  REQUIRE(urad_form_factor(scene, 0, 1, 1, nullptr, 0, &kernel, nullptr) == URAD_OK);
  REQUIRE(hybrid.fill(hybrid.context, 0, 1, 1, 1, f) == URAD_OK);
  CHECK(f[0] / 0x1p32 == doctest::Approx(kernel / 0x1p32).epsilon(1e-4));  // all of it is visible
}

TEST_CASE("C: radiosity refuses nulls and what is out of range") {
  test::TableScene room(6, 9, URAD_SCENE_CLOSED);
  std::mt19937 random(1);
  room.fill_reciprocal(random, 1);
  test::furnish(&room);
  const urad_source source = room.source();
  std::vector<uint32_t> memory(URAD_RADIOSITY_BYTES(54, 9) / 4);
  urad_radiosity state{};
  CHECK(urad_longest_run(&room.pod) == 9);
  CHECK(urad_longest_run(nullptr) == 0);
  CHECK(urad_radiosity_init(&state, &room.pod, nullptr, 0, 9, memory.data(), memory.size() * 4) ==
        URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_init(&state, &room.pod, &source, 0, 9, memory.data(),
                            memory.size() * 4 - 4) == URAD_OUT_OF_MEMORY);
  CHECK(state.scene == nullptr);
  REQUIRE(urad_radiosity_init(&state, &room.pod, &source, 0, 9, memory.data(), memory.size() * 4) ==
          URAD_OK);
  CHECK(urad_radiosity_step(nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_done(nullptr, 0) == 1);
  CHECK(urad_radiosity_error_uq32(nullptr) == 0);
  CHECK(urad_radiosity_audit(nullptr, nullptr) == 0);
  CHECK(urad_radiosity_error_uq32(&state) > 0xFFFFFF00u);
  CHECK(urad_radiosity_done(&state, URAD_PERCENT) == 0);
  CHECK(urad_radiosity_step(&state) == URAD_OK);
  CHECK(urad_radiosity_audit(&state, nullptr) == 1);
  ++state.unshot[7];
  CHECK(urad_radiosity_audit(&state, nullptr) == 0);
  --state.unshot[7];
  int32_t b = -7;
  CHECK(urad_radiosity_get(nullptr, 0, 0, &b) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_get(&state, 54, 0, &b) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_get(&state, 0, 3, &b) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_get(&state, 0, 0, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_display(nullptr, 0, 0, &b) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_display(&state, 54, 0, &b) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_display(&state, 0, 3, &b) == URAD_BAD_ARGUMENT);
  CHECK(urad_radiosity_display(&state, 0, 0, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(b == -7);
  CHECK(urad_radiosity_get(&state, 0, 0, &b) == URAD_OK);
  CHECK(b == doctest::Approx(room.material[0].exitance[0]).epsilon(1e-5));
  CHECK(urad_radiosity_display(&state, 53, 0, &b) == URAD_OK);
  CHECK(b == urad::radiosity_display(state, 53, 0));
}

TEST_CASE(
    "C: a net of other inputs than those of a pair is refused, and so is a run out of range") {
  const FacingSquares squares;
  const int8_t weights[20] = {};
  const int32_t bias[1] = {};
  const urad_rescale rescale[1] = {{1, 17}};
  const int16_t none[20] = {};
  urad_net net{URAD_NET_ABI, 0,    20,      1,    8,    0, 0,       0,
               weights,      bias, rescale, none, none, 0, {1, 17}, 0};
  net.crc32 = urad::network_crc32(net);
  REQUIRE(urad_net_check(&net) == URAD_OK);
  uint32_t f[2] = {7, 7};
  urad_counters counters{};
  uint64_t memory[16];
  urad_source source;
  CHECK(urad_form_factor(&squares.scene, 0, 1, URAD_KERNEL_MOMENT, &net, 0, f, &counters) ==
        URAD_BAD_NET);
  CHECK(urad_pair_source_init(&source, &squares.scene, URAD_KERNEL_MOMENT, &net, 0, &counters,
                              memory, sizeof memory) == URAD_BAD_NET);
  static constexpr auto cells = urad::make_hemicube_table<16>();
  const urad_hemicube_table table{16, cells.top, cells.side};
  std::vector<uint64_t> room(urad_hemicube_source_bytes(&squares.scene, 16, 0, 0) / 8 + 1),
      more(urad_hybrid_source_bytes() / 8 + 1);
  urad_source hemicube{nullptr, nullptr};
  REQUIRE(urad_hemicube_source_init(&hemicube, &squares.scene, &table, 0, 0, &counters, room.data(),
                                    room.size() * 8) == URAD_OK);
  CHECK(urad_hybrid_source_init(&source, &hemicube, 1, &net, 16, 0, more.data(), more.size() * 8) ==
        URAD_BAD_NET);
  REQUIRE(urad_pair_source_init(&source, &squares.scene, URAD_KERNEL_MOMENT, nullptr, 0, &counters,
                                memory, sizeof memory) == URAD_OK);
  CHECK(source.fill(source.context, 2, 0, 0, 1, f) == URAD_BAD_ARGUMENT);
  CHECK(source.fill(source.context, 0, 2, 0, 1, f) == URAD_BAD_ARGUMENT);
  CHECK(source.fill(source.context, 0, 1, 0, 1, f) == URAD_BAD_ARGUMENT);
  CHECK(source.fill(source.context, 0, 1, 1, 2, f) == URAD_BAD_ARGUMENT);
  CHECK(f[0] == 7);
  CHECK(source.fill(source.context, 0, 1, 1, 1, f) == URAD_OK);
}

TEST_CASE("C: a hemicube has room for the greatest polygon of a scene, patch or blocker") {
  const auto polygon = [](int corners, double z, bool down) {
    host::Polygon p;
    for (int k = 0; k < corners; ++k) {
      const double angle = (down ? -2 : 2) * 3.14159265358979 * k / corners;
      p.outer.push_back({std::cos(angle), std::sin(angle), z});
    }
    return p;
  };
  const auto bytes = [&](int floor, int plate, int between) {
    std::vector<host::Polygon> blockers;
    if (between) blockers.push_back(polygon(between, 1, false));
    const host::FixedScene scene = host::FixedScene::of_polygons(
        {polygon(floor, 0, false), polygon(plate, 2, true)}, blockers);
    const size_t all = urad_hemicube_source_bytes(&scene.pod(), 32, 8, 0);
    static constexpr auto cells = urad::make_hemicube_table<32>();
    const urad_hemicube_table table{32, cells.top, cells.side};
    std::vector<uint64_t> memory(all / 8 + 1);
    urad_source source{};
    urad_counters counters{};
    const auto init = [&](size_t room) {
      return urad_hemicube_source_init(&source, &scene.pod(), &table, 8, 0, &counters,
                                       memory.data(), room);
    };
    CHECK(init(all - 1) == URAD_OUT_OF_MEMORY);
    REQUIRE(init(all) == URAD_OK);
    uint32_t f = 0;
    CHECK(source.fill(source.context, 0, 1, 1, 1, &f) == URAD_OK);
    CHECK((f == 0) == (between != 0));
    return all;
  };
  const size_t four = bytes(4, 3, 0);
  CHECK(bytes(4, 7, 0) == four + 3 * sizeof(urad_point));
  CHECK(bytes(9, 7, 4) == four + 5 * sizeof(urad_point));
  CHECK(bytes(4, 3, 12) == four + 8 * sizeof(urad_point));
}

TEST_CASE("C: a hemicube counts a shooter's own wall as such, from its first patch to its last") {
  const host::FixedScene cube(test::cube(2));
  static constexpr auto cells = urad::make_hemicube_table<16>();
  const urad_hemicube_table table{16, cells.top, cells.side};
  std::vector<uint64_t> memory(urad_hemicube_source_bytes(&cube.pod(), 16, 0, 0) / 8 + 1);
  urad_counters counters{};
  urad_source source{};
  REQUIRE(urad_hemicube_source_init(&source, &cube.pod(), &table, 0, 0, &counters, memory.data(),
                                    memory.size() * 8) == URAD_OK);
  for (uint16_t shooter = 3; shooter < 9; ++shooter) {
    CAPTURE(shooter);
    uint32_t f[4];
    counters = {};
    REQUIRE(source.fill(source.context, shooter, 1, 4, 4, f) == URAD_OK);
    const bool own = shooter >= 4 && shooter < 8;  // of the second wall
    CHECK(counters.skipped_same == (own ? 3 : 0));
    CHECK(counters.evaluated == (own ? 0 : 4));
  }
}
