// The hemicube's frame, and what its rows sum to in closed rooms.
#include "urad/hemicube.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "polygon_scene.hpp"

namespace {

using test::Hemicube, test::PolygonScene, test::Tables, test::to_vec, test::Vec;

std::vector<Vec> quad(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  return {a, b, c, d};
}

/// A closed box [-x,x] x [-y,y] x [-z,z], each wall in count x count patches, seen from inside,
/// rotated.
PolygonScene box_room(const Vec& half, int count, const glm::dmat3& turn, uint16_t flags) {
  PolygonScene scene(flags);
  const auto wall = [&](const Vec& origin, const Vec& u, const Vec& v) {
    for (int j = 0; j < count; ++j) {
      for (int i = 0; i < count; ++i) {
        const auto at = [&](int a, int b) {
          return turn * (origin + u * (double(a) / count) + v * (double(b) / count));
        };
        scene.add(quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)));
      }
    }
  };
  const Vec x{2 * half.x, 0, 0}, y{0, 2 * half.y, 0}, z{0, 0, 2 * half.z};
  wall(-half, x, y);
  wall(-half, y, z);
  wall(-half, z, x);
  wall(half, -y, -x);
  wall(half, -z, -y);
  wall(half, -x, -z);
  return scene;
}

glm::dmat3 random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Vec a = glm::normalize(Vec{normal(random), normal(random), normal(random)});
  const Vec b = glm::normalize(glm::cross(a, Vec{normal(random), normal(random), normal(random)}));
  return {a, b, glm::cross(a, b)};
}

TEST_CASE("hemicube_frame is right-handed and orthonormal to 2^-27, turned or not") {
  const uint64_t seed = 20241;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  MESSAGE("seed ", seed);
  double worst = 0;
  for (int n = 0; n < 20000; ++n) {
    Vec d = glm::normalize(Vec{normal(random), normal(random), normal(random)});
    if (n < 6) d = Vec{0}, d[n % 3] = n < 3 ? 1 : -1;
    d *= 0x1p30;
    const urad_point q30{int32_t(std::lround(d.x)), int32_t(std::lround(d.y)),
                         int32_t(std::lround(d.z))};
    const urad::HemicubeFrame frame = urad::hemicube_frame(q30, uint16_t(random()), n & 1);
    const Vec x = to_vec(frame.axis[0]) * 0x1p-30, y = to_vec(frame.axis[1]) * 0x1p-30,
              z = to_vec(frame.axis[2]) * 0x1p-30;
    for (const double e : {glm::dot(x, y), glm::dot(y, z), glm::dot(z, x), glm::dot(x, x) - 1,
                           glm::dot(y, y) - 1, glm::length(glm::cross(x, y) - z)}) {
      worst = std::max(worst, std::fabs(e));
    }
  }
  CHECK(worst <= 0x1p-27);
}

TEST_CASE(
    "closed rooms: every row sums to exactly 2^32, without a buffer, with one, and in bands") {
  const uint64_t seed = 77;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> side(0.2, 1);
  MESSAGE("seed ", seed);
  for (int room = 0; room < 12; ++room) {
    const int resolution = room % 3 == 0 ? 32 : room % 3 == 1 ? 42 : 64;
    const Tables tables(resolution);
    const glm::dmat3 turn = room < 4 ? glm::dmat3(1) : random_rotation(random);
    PolygonScene scene = box_room(2.9e8 * Vec{side(random), side(random), side(random)},
                                  2 + room % 4, turn, URAD_SCENE_CONVEX | URAD_SCENE_CLOSED);
    const urad_scene& pod = scene.pod();
    const uint8_t flags = room & 1 ? urad::hemicube_turned : 0;
    Hemicube bare(pod, tables, 0, flags), whole(pod, tables, uint16_t(resolution), flags),
        banded(pod, tables, 5, flags);
    for (uint16_t shooter = 0; shooter < pod.patch_count; ++shooter) {
      const std::vector<uint32_t> row = bare.row(shooter);
      uint64_t sum = 0;
      for (const uint32_t f : row) sum += f;
      CHECK(sum == uint64_t{1} << 32);
      CHECK(whole.row(shooter) == row);
      CHECK(banded.row(shooter) == row);
    }
  }
}

TEST_CASE(
    "a plate over the whole half cube gets all of it, a speck at the end of the world next to "
    "none") {
  const Tables tables(16);
  const auto square = [](double half, double z, bool down) {
    const std::vector<Vec> up{
        {-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
    return down ? std::vector<Vec>(up.rbegin(), up.rend()) : up;
  };
  for (const uint16_t rows : {uint16_t{0}, uint16_t{16}}) {
    CAPTURE(rows);
    PolygonScene under(URAD_SCENE_CONVEX | URAD_SCENE_CLOSED);
    under.add(square(1000, 0, false));
    under.add(square(400000000, 1000, true));
    CHECK(Hemicube(under.pod(), tables, rows, 0).row(0)[1] == 0xFFFFFFFFu);

    // Two units across at 2^29: its corners are the same direction, or the next.
    PolygonScene far(URAD_SCENE_CONVEX);
    far.add(square(1000, 0, false));
    far.add(square(1, 500000000, true));
    const uint32_t seen = Hemicube(far.pod(), tables, rows, 0).row(0)[1];
    CHECK(seen <= *std::max_element(tables.top.begin(), tables.top.end()));
  }
}

}  // namespace
