// Grids made on the chip against those the exporter makes in double.
#include "urad/grid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "urad/patch.hpp"

namespace {

constexpr unsigned kSeed = 7;

struct Exact {
  double normal[3], area, sum;
};

Exact exact(const urad_point& u, const urad_point& v) {
  const double a[3] = {double(u.x), double(u.y), double(u.z)},
               b[3] = {double(v.x), double(v.y), double(v.z)};
  Exact result{};
  result.normal[0] = a[1] * b[2] - a[2] * b[1];
  result.normal[1] = a[2] * b[0] - a[0] * b[2];
  result.normal[2] = a[0] * b[1] - a[1] * b[0];
  result.area =
      std::sqrt(result.normal[0] * result.normal[0] + result.normal[1] * result.normal[1] +
                result.normal[2] * result.normal[2]);
  for (int k = 0; k < 3; ++k)
    result.sum += a[k] * a[k] + b[k] * b[k], result.normal[k] /= result.area;
  return result;
}

}  // namespace

TEST_CASE("grid_make keeps its error bounds on random parallelograms of every size") {
  MESSAGE("seed ", kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> part(-1, 1), bits(4, 28);
  double normal = 0, area = 0, spread = 0, fill = 0;
  for (int n = 0; n < 20000; ++n) {
    const double size = std::exp2(bits(random));
    const auto draw = [&] { return std::int32_t(std::lround(part(random) * size)); };
    const urad_point u{draw(), draw(), draw()}, v{draw(), draw(), draw()};
    const Exact want = exact(u, v);
    if (want.area < 1e-3 * want.sum || want.sum == 0) continue;
    urad_grid grid;
    REQUIRE(urad::grid_make({0, 0, 0}, u, v, 1, 1, &grid) == urad::Status::ok);
    const urad_shape& shape = grid.shape;
    normal = std::max({normal, std::fabs(shape.normal_q30.x / 0x1p30 - want.normal[0]),
                       std::fabs(shape.normal_q30.y / 0x1p30 - want.normal[1]),
                       std::fabs(shape.normal_q30.z / 0x1p30 - want.normal[2])});
    area = std::max(area, std::fabs(shape.log2_area_q24 / 0x1p24 - std::log2(want.area)));
    spread = std::max(spread, std::fabs(shape.log2_spread_q24 / 0x1p24 - std::log2(want.sum / 12)));
    const double xx = (double(u.x) * u.x + double(v.x) * v.x) / want.sum;
    fill =
        std::max(fill, std::fabs(shape.fill_uq15 / 32768.0 - want.area / (want.area + want.sum)));
    CHECK(std::fabs(shape.spread_q15[0] / 32768.0 - xx) <= 0x1p-15);
  }
  CHECK(normal <= 0x1p-26);
  CHECK(area <= 3e-6);
  CHECK(spread <= 3e-6);
  CHECK(fill <= 0x1p-15);
}

TEST_CASE("grid_make refuses what is no grid and writes nothing") {
  const urad_point zero{0, 0, 0}, x{1000, 0, 0}, y{0, 1000, 0}, far{URAD_COORDINATE_MAX, 0, 0};
  urad_grid grid{};
  grid.count_u = 42;
  CHECK(urad::grid_make(zero, x, x, 1, 1, &grid) == urad::Status::bad_argument);
  CHECK(urad::grid_make(zero, x, zero, 1, 1, &grid) == urad::Status::bad_argument);
  CHECK(urad::grid_make(zero, x, y, 0, 1, &grid) == urad::Status::bad_argument);
  CHECK(urad::grid_make(zero, x, y, 1, 0, &grid) == urad::Status::bad_argument);
  CHECK(urad::grid_make(far, x, y, 1, 1, &grid) == urad::Status::bad_argument);
  CHECK(urad::grid_make(zero, x, y, 1, 1, nullptr) == urad::Status::bad_argument);
  // Of the four corners any one may be the only one outside.
  const std::int32_t most = URAD_COORDINATE_MAX, half = most / 2 + 1;
  const urad_point corner{most - half, 0, 0}, up{0, 0, 1000};
  CHECK(urad::grid_make(corner, {half + 1, 0, 0}, up, 1, 1, &grid) == urad::Status::bad_argument);
  CHECK(urad::grid_make(corner, up, {half + 1, 0, 0}, 1, 1, &grid) == urad::Status::bad_argument);
  CHECK(urad::grid_make(corner, {half, 0, 0}, {half, 9, 0}, 1, 1, &grid) ==
        urad::Status::bad_argument);
  CHECK(urad::grid_make({most + 1, 0, 0}, {-9, 0, 0}, {-9, 9, 0}, 1, 1, &grid) ==
        urad::Status::bad_argument);
  CHECK(grid.count_u == 42);
  CHECK(urad::grid_make(corner, {half, 0, 0}, up, 1, 1, &grid) == urad::Status::ok);
  CHECK(grid.count_u == 1);
}

TEST_CASE("the fill of a strip falls with its length, to the least that is told apart") {
  const auto fill = [](std::int32_t length) {
    urad_grid grid{};
    REQUIRE(urad::grid_make({0, 0, 0}, {length, 0, 0}, {0, 1000, 0}, 1, 1, &grid) ==
            urad::Status::ok);
    return grid.shape.fill_uq15 / 32768.0;
  };
  CHECK(fill(1000) == doctest::Approx(1.0 / 3).epsilon(1e-4));
  // A / (A + 12 tr M) with 12 tr M = a a + b b.
  for (const double ratio : {3.0, 30.0, 300.0})
    CHECK(std::fabs(fill(std::int32_t(1000 * ratio)) - ratio / (ratio + ratio * ratio + 1)) <
          1.0 / 32768);
  CHECK(fill(100000000) == fill(5000000));
  CHECK(fill(100000000) == 16.0 / 32768);
}

TEST_CASE("a grid made on the chip passes the scene check and enumerates its patches") {
  urad_grid grid;
  REQUIRE(urad::grid_make({-300, 0, 0}, {100, 0, 0}, {0, 50, 0}, 3, 2, &grid) == urad::Status::ok);
  const urad_surface surface{0, 6, 0, URAD_SURFACE_PLANAR, &grid, nullptr};
  const urad_material material{};
  urad_scene scene{};
  scene.abi = URAD_SCENE_ABI;
  scene.patch_count = 6;
  scene.surface_count = scene.material_count = 1;
  scene.surface = &surface;
  scene.material = &material;
  CHECK(urad::scene_check(&scene) == urad::Status::ok);
  const urad::Patch patch = urad::patch_at(scene, 4);
  CHECK(patch.centroid.x == -150);
  CHECK(patch.centroid.y == 75);
  CHECK(urad::patch_vertex(scene, patch, 2).x == -100);
  CHECK(urad::patch_vertex(scene, patch, 2).y == 100);
}

TEST_CASE("squares turned in their plane have unit normals that the scene check takes") {
  urad_material material{};
  urad_scene scene{};
  scene.abi = URAD_SCENE_ABI;
  scene.patch_count = scene.surface_count = scene.material_count = 1;
  scene.material = &material;
  for (int k = 0; k < 500; ++k) {
    const auto a = std::int32_t(0x1p26 * std::cos(0.01 * k)),
               b = std::int32_t(0x1p26 * std::sin(0.01 * k));
    urad_grid grid;
    REQUIRE(urad::grid_make({0, 0, 0}, {a, 0, b}, {-b, 0, a}, 1, 1, &grid) == urad::Status::ok);
    const urad_surface surface{0, 1, 0, URAD_SURFACE_PLANAR, &grid, nullptr};
    scene.surface = &surface;
    CAPTURE(k);
    CHECK(urad::scene_check(&scene) == urad::Status::ok);
  }
}
