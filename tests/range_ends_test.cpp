// The engine where scenes hardly reach: ends of ranges, ties, sums that come out empty, surfaces that
// no exporter writes.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "../firmware_style/src/lambert_carrier.hpp"
#include "../firmware_style/src/radiosity_two_ways.hpp"
#include "../firmware_style/src/visibility_rays.hpp"
#include "polygon_scene.hpp"
#include "urad/clip.hpp"
#include "urad/log2.hpp"
#include "urad/network.hpp"
#include "urad/pair.hpp"
#include "urad/pose_table.hpp"
#include "urad/ratio.hpp"
#include "urad/source.h"

namespace {

/// The engine's own copy of an inline function, not one that the compiler folds into the test.
template <class F>
F engines(F function) {
  F volatile kept = function;
  return kept;
}

/// One polygon in the plane z = 0, its lit side up, cut by the plane x = 0: what of it is at x > 0.
struct CutOutline {
  explicit CutOutline(const std::vector<urad_point>& loop) : vertex(loop) {
    polygon.shape.normal_q30 = {0, 0, 1 << 30};
    polygon.vertex_count = std::uint16_t(vertex.size());
    surface = {0, 1, 0, URAD_SURFACE_PLANAR, nullptr, &polygon};
    scene.abi = URAD_SCENE_ABI;
    scene.patch_count = scene.surface_count = 1;
    scene.surface = &surface;
    scene.vertex = vertex.data();
    scene.vertex_count = std::uint32_t(vertex.size());
    left = urad::clipped_shape(scene, urad::patch_at(scene, 0), {0, 0, 0}, {1 << 30, 0, 0}, &shape,
                               &centroid);
  }
  double area() const { return std::exp2(shape.log2_area_q24 * 0x1p-24); }

  std::vector<urad_point> vertex;
  urad_polygon polygon{};
  urad_surface surface{};
  urad_scene scene{};
  urad_shape shape{};
  urad_point centroid{};
  bool left = false;
};

}  // namespace

TEST_CASE("a quotient beyond 2^62 stays there, with its sign") {
  const auto ratio = engines(&urad::ratio_q);
  CHECK(ratio(std::int64_t{1} << 40, 1, 31) == std::int64_t{1} << 62);
  CHECK(ratio(-(std::int64_t{1} << 40), 1, 31) == -(std::int64_t{1} << 62));
  CHECK(ratio(std::int64_t{1} << 40, 1, 21) == doctest::Approx(0x1p61).epsilon(1e-8));
}

TEST_CASE("a cut through a vertex leaves what lies in front of it") {
  const CutOutline cut({{0, 0, 0}, {-1000, 500, 0}, {-1000, -500, 0}, {0, -500, 0}, {800, 0, 0}});
  REQUIRE(cut.left);
  CHECK(cut.area() == doctest::Approx(200000).epsilon(1e-5));
  CHECK(std::abs(cut.centroid.x - 267) <= 1);
  CHECK(std::abs(cut.centroid.y + 167) <= 1);
}

TEST_CASE("a cut that leaves a sliver of 1 : 4,096 is as thin as a shape can say") {
  const CutOutline cut({{-1000, 0, 0}, {1 << 20, 0, 0}, {1 << 20, 256, 0}, {-1000, 256, 0}});
  REQUIRE(cut.left);
  CHECK(cut.area() == doctest::Approx(0x1p28).epsilon(1e-5));
  CHECK(cut.shape.fill_uq15 == 21);  // 2^15 / (1 + 12 128)
  // Of one 64 times as thin the second moments are below their last bit: it is nothing.
  CHECK_FALSE(CutOutline({{-1000, 0, 0}, {1 << 20, 0, 0}, {1 << 20, 4, 0}, {-1000, 4, 0}}).left);
}

TEST_CASE("loops that cross themselves leave nothing rather than an area below 0") {
  // At x > 0 all of it is seen from behind.
  CHECK_FALSE(CutOutline({{-900, 500, 0}, {-900, -500, 0}, {900, 500, 0}, {900, -500, 0}}).left);
  // A square of 100, less one of 90 a thousand away: its moment about the centroid is below 0.
  const CutOutline apart({{-10, 0, 0},
                          {100, 0, 0},
                          {100, 50, 0},
                          {1000, 50, 0},
                          {1000, 140, 0},
                          {1090, 140, 0},
                          {1090, 50, 0},
                          {100, 50, 0},
                          {100, 100, 0},
                          {-10, 100, 0}});
  CHECK_FALSE(apart.left);
  CHECK(apart.shape.log2_area_q24 == 0);  // nothing is written
  // Of 2^36 square units, one is left: its first moment by its area is beyond 31 bits.
  const CutOutline one({{-10, 0, 0},
                        {1 << 18, 0, 0},
                        {1 << 18, 1, 0},
                        {1 << 19, 1, 0},
                        {1 << 19, (1 << 18) + 1, 0},
                        {3 << 18, (1 << 18) + 1, 0},
                        {3 << 18, 1, 0},
                        {1 << 18, 1, 0},
                        {1 << 18, (1 << 18) + 1, 0},
                        {-10, (1 << 18) + 1, 0}});
  CHECK_FALSE(one.left);
}

TEST_CASE("a span 2^33 below the greatest of its carrier is none") {
  const auto brought = engines(&urad::brought_to);
  CHECK(brought({0x3FFFFFFF, -3}, 30) == 0);
  CHECK(brought({0x3FFFFFFF, -2}, 30) == 0);  // 2^30 / 2^32
  CHECK(brought({0x3FFFFFFF, 29}, 30) == 0x20000000);
  CHECK(brought({0x3FFFFFFF, 30}, 30) == 0x3FFFFFFF);
}

TEST_CASE("weights 2^32 below the greatest count as rays, and weigh nothing") {
  urad::Sums sums;
  const auto add = engines(&urad::Sums::add);
  const auto fraction = engines(&urad::Sums::fraction_uq16);
  (sums.*add)({0x80000000u, 0}, true, false);
  (sums.*add)({0x80000000u, -40}, false, false);
  CHECK_FALSE(sums.all_open());
  CHECK((sums.*fraction)() == 65535);
  (sums.*add)({0x80000000u, 0}, false, false);
  CHECK((sums.*fraction)() == 32768);
  (sums.*add)({0x80000000u, 40}, false, false);
  (sums.*add)({0x80000000u, 0}, true, false);
  CHECK((sums.*fraction)() == 1);
}

TEST_CASE("where all rays are near and none is weighed, a pair is not taken for shut") {
  urad::Sums sums;
  const auto add = engines(&urad::Sums::add);
  const auto add_near = engines(&urad::Sums::add_near);
  const auto fraction = engines(&urad::Sums::fraction_uq16);
  (sums.*add)({0x80000000u, 0}, true, true);
  (sums.*add)({0x80000000u, 0}, false, true);
  (sums.*add_near)(urad::kNoHit, urad::kNoHit);
  CHECK_FALSE(sums.all_open());
  CHECK_FALSE(sums.all_shut());
  CHECK((sums.*fraction)() == 65535);
}

TEST_CASE("patches that differ in their slant alone have one order, whichever comes first") {
  // Facing each other along z, each tilted by the same angle the other way: w = z, equal cosines.
  const auto q30 = [](double x) { return std::int32_t(std::lround(x * 0x1p30)); };
  const auto q15 = [](double x) { return std::int16_t(std::lround(x * 0x1p15)); };
  urad_shape a{};
  a.normal_q30 = {q30(0.6), 0, q30(0.8)};
  a.log2_area_q24 = 20 << 24;
  a.log2_spread_q24 = 18 << 24;
  a.fill_uq15 = 16384;
  urad_shape b = a;
  b.normal_q30 = {0, q30(0.6), q30(-0.8)};
  // Of M only zz and z with the other's normal are seen along the ray: xx and yy tell them apart.
  const double share[6] = {0.25, 0.5, 0.25, 0, 0, 0};
  for (int k = 0; k < 6; ++k) a.spread_q15[k] = b.spread_q15[k] = q15(share[k]);
  urad::Pair forward{}, backward{};
  REQUIRE(urad::pair_invariants(a, {0, 0, 0}, b, {0, 0, 1 << 12}, &forward));
  REQUIRE(urad::pair_invariants(b, {0, 0, 1 << 12}, a, {0, 0, 0}, &backward));
  CHECK(forward.input_q15[6] > forward.input_q15[11]);  // the more slanted one is the first
  for (int k = 0; k < urad::kPairInputs; ++k) CHECK(forward.input_q15[k] == backward.input_q15[k]);
  for (int k : {3, 4, 5, 7}) CHECK(forward.input_q15[k] == forward.input_q15[k + 5]);
  // And in their spread: the wider one is the first.
  b.log2_spread_q24 += 1 << 20;
  REQUIRE(urad::pair_invariants(a, {0, 0, 0}, b, {0, 0, 1 << 12}, &forward));
  REQUIRE(urad::pair_invariants(b, {0, 0, 1 << 12}, a, {0, 0, 0}, &backward));
  CHECK(forward.input_q15[3] > forward.input_q15[8]);
  for (int k = 0; k < urad::kPairInputs; ++k) CHECK(forward.input_q15[k] == backward.input_q15[k]);
}

TEST_CASE("poses of a polygon list are read by place, and a patch exchanges nothing with itself") {
  std::array<urad_polygon, 4> polygon{};
  std::array<urad_surface, 2> surface{{{0, 1, 0, URAD_SURFACE_PLANAR, nullptr, polygon.data()},
                                       {1, 3, 0, 0, nullptr, &polygon[1]}}};
  urad_scene scene{};
  scene.abi = URAD_SCENE_ABI;
  scene.patch_count = 4;
  scene.surface_count = 2;
  scene.surface = surface.data();
  // 0 to 1..3, 1..3 to 0, and 1..3 to each other, which is no plane.
  const std::array<std::uint32_t, 15> value{10, 11, 12, 20, 21, 22, 0, 31,
                                            32, 41, 0,  43, 51, 52, 0};
  const std::array<urad_pose_block, 3> block{
      {{0, {0, 0}, {{1, 0, 0, 0}, {0, 0, 0, 0}}, {0, 0}, 0},
       {3, {1, 0}, {{0, 0, 0, 0}, {0, 0, 0, 0}}, {0, 0}, 0},
       {6, {3, 0}, {{1, 0, 0, 0}, {0, 0, 0, 0}}, {0, 0}, 0}}};
  const std::array<std::uint16_t, 4> block_of{URAD_POSE_NO_BLOCK, 0, 1, 2};
  const urad_pose_table table{URAD_POSE_TABLE_ABI, 4,           2, 3, 15, block_of.data(),
                              block.data(),        value.data()};
  REQUIRE(urad::pose_table_check(&table, &scene) == urad::Status::ok);
  urad_counters counters{};
  urad::PoseSource source{&scene, &table, &counters};
  std::array<std::uint32_t, 3> f{};
  REQUIRE(urad::pose_fill(&source, 0, 1, 1, 3, f.data()) == URAD_OK);
  CHECK(f == std::array<std::uint32_t, 3>{10, 11, 12});
  CHECK(counters.evaluated == 3);
  REQUIRE(urad::pose_fill(&source, 3, 0, 0, 1, f.data()) == URAD_OK);
  CHECK(f[0] == 22);
  CHECK(counters.evaluated == 4);
  REQUIRE(urad::pose_fill(&source, 2, 1, 1, 3, f.data()) == URAD_OK);
  CHECK(f == std::array<std::uint32_t, 3>{41, 0, 43});
  CHECK(counters.evaluated == 6);  // not of itself
  REQUIRE(urad::pose_fill(&source, 3, 1, 1, 2, f.data()) == URAD_OK);
  CHECK(f[0] == 51);
  CHECK(counters.evaluated == 8);
}

TEST_CASE("a network's word ends at 2^61 and 2^-61") {
  const auto word = engines(&urad::word_q24);
  CHECK(word(INT32_MAX, 65535) == urad::kMostWord * (1 << 24));
  CHECK(word(-INT32_MAX, 65535) == -urad::kMostWord * (1 << 24));
  CHECK(word(3 << 16, 32768) == 3 << 23);
}

TEST_CASE("a normal along an axis that is no unit is taken as it stands") {
  const auto distance = engines(&urad::plane_distance);
  for (const urad_point& half : {urad_point{1 << 29, 0, 0}, {0, 1 << 29, 0}, {0, 0, 1 << 29}})
    CHECK(distance(half, {1, 2, 3}, {1001, 1002, 1003}) == 500);
}

TEST_CASE("cross products of a unit or two keep their length in the exponent") {
  const auto cross = engines(&urad::cross);
  const urad::LongVector c = cross({1, 0, 0}, {0, 3, 0});
  CHECK(c.exponent == -28);
  CHECK(c.direction.z == 3 << 28);
}

TEST_CASE("an edge seen end-on spans no angle") {
  test::PolygonScene polygons(0);
  polygons.add({{1000, 0, 0}, {2000, 0, 0}, {2000, 1000, 0}, {1000, 1000, 0}});
  const urad_scene& scene = polygons.pod();
  const urad::Patch patch = urad::patch_at(scene, 0);
  const urad::Frame frame{{0, 0, 0}, 10};
  const urad::Outline outline(scene, patch, frame, nullptr);
  // From the corner of the plane that its first edge leads to: the plane itself is dark.
  CHECK(urad::lambert_sum_uq30({0, 0, 0}, {1 << 30, 0, 0}, outline) <= 8);
}

TEST_CASE("a sum over no area is no exchange, and none is more than a patch has") {
  urad_shape small{}, great{};
  small.log2_area_q24 = 10 << 24, great.log2_area_q24 = 20 << 24;
  const urad::Patch carrier{&small, {0, 0, 0}, nullptr, 0, 0, 0, 0},
      receiver{&great, {0, 0, 0}, nullptr, 1, 0, 0, 0};
  urad::LambertPair pair{};
  pair.carrier = &carrier, pair.receiver = &receiver;
  const auto exchange = engines(&urad::LambertPair::log2_exchange_q24);
  CHECK((pair.*exchange)(5, 0, 0) == urad::kNoExchange);
  CHECK((pair.*exchange)(0, 5, 0) == urad::kNoExchange);
  CHECK((pair.*exchange)(std::int64_t{1} << 32, 1024, 0) == 10 << 24);  // all of the carrier
  CHECK((pair.*exchange)(std::int64_t{1} << 33, 1024, 0) == 10 << 24);
  CHECK((pair.*exchange)(std::int64_t{1} << 31, 1024, 0) == 9 << 24);
}

TEST_CASE("where waves are mostly nearby, a gain beyond the greatest comes down to it") {
  urad_radiosity state{};
  state.flags = urad::kTwoWays;
  state.remaining = 1000;
  const auto gain = engines(&urad::two_ways_gain_uq16);
  CHECK(gain(state, 6u << 16) == urad::kTwoWaysGainMost_uq16);
  state.flags = 0;
  CHECK(gain(state, 6u << 16) == 6u << 16);
}
