// Hemicubes at the ends of their ranges: planes seen along themselves, edges seen end-on from afar,
// dark sides, shooters whose quarters have no middle.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "../firmware_style/src/hemicube_raster.hpp"
#include "polygon_scene.hpp"

TEST_CASE("a cell on the vanishing line of a plane far away has the least depth there is") {
  test::PolygonScene polygons(0);
  polygons.add({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}});
  const test::Tables tables(32);
  test::Hemicube hemicube(polygons.pod(), tables, 32, urad::hemicube_coverage);
  urad::HemicubeSource& source = hemicube.source;
  constexpr int kRow = 16, kColumn = 31, kCell = kRow * 32 + kColumn;
  const urad::raster::Band band{0, 0, 32};
  for (const int apart : {5, -5, 500000000}) {
    const bool least = apart < 1000;
    for (int k = 0; k < 32 * 32; ++k) source.depth[k] = 0, source.item[k] = 0xFFFF;
    // normal . (31, 1, 32), units of its 30 bits off the line; five below it is beyond it.
    const urad::raster::View view{
        nullptr, 0, 0, 0, {-32 * 24000000, apart, 31 * 24000000}, std::int64_t{1} << 59};
    source.mask[kRow] = 1u << kColumn;
    CHECK(urad::raster::paint(source, view, band, {0, kRow, kRow + 1}) == 1);
    CHECK(source.mask[kRow] == 0);
    CHECK(source.item[kCell] == 0);
    CHECK((source.depth[kCell] == 1) == least);
  }
}

TEST_CASE("a step of two units almost 2^30 away takes a row of cells on its own side alone") {
  constexpr std::int32_t kFar = (1 << 30) - 65536, kWide = 1 << 27, kLine = kFar / 64;
  const auto row = [&](std::int32_t left, std::int32_t right) {
    const urad_point corner[] = {{-kWide, -kWide, kFar}, {-kWide, left, kFar},
                                 {0, left, kFar},        {0, right, kFar},
                                 {kWide, right, kFar},   {kWide, -kWide, kFar}};
    const urad::raster::View view{corner, 6, 0, 0, {0, 0, -(1 << 30)}, -(std::int64_t{kFar} << 30)};
    std::uint32_t mask[2 * 64] = {};
    urad::raster::scan(view, {0, 0, 64}, 64, 2, mask);
    CHECK(mask[2 * 31] == 0xF0000000u);  // the row below: four columns either side
    CHECK(mask[2 * 31 + 1] == 0xFu);
    return std::uint64_t{mask[2 * 32 + 1]} << 32 | mask[2 * 32];
  };
  // The centres of row 32 lie at 1/64 of the distance: on the line they are beside it.
  CHECK(row(kLine, kLine) == 0);
  CHECK(row(kLine + 2, kLine + 2) == 0xFF0000000u);
  CHECK(row(kLine, kLine + 2) == 0xF00000000u);
  CHECK(row(kLine + 2, kLine) == 0xF0000000u);
}

TEST_CASE("in an unbuffered hemicube the dark side of a patch covers nothing") {
  test::PolygonScene polygons(URAD_SCENE_CONVEX);
  polygons.add({{-90, -90, 0}, {90, -90, 0}, {90, 90, 0}, {-90, 90, 0}});
  polygons.add({{-900, -900, 99}, {-900, 900, 99}, {900, 900, 99}, {900, -900, 99}});
  polygons.add({{-900, -900, 199}, {900, -900, 199}, {900, 900, 199}, {-900, 900, 199}});
  const test::Tables tables(32);
  const std::vector<std::uint32_t> row = test::Hemicube(polygons.pod(), tables, 0, 0).row(0);
  CHECK(row[1] > 0xF0000000u);
  CHECK(row[2] == 0);
}

TEST_CASE("four eyes on a shape whose quarters have no middle stand on its centre") {
  // An L: the middle of the box's upper right quarter lies beside it.
  test::PolygonScene polygons(0);
  polygons.add({{0, 0, 0}, {90, 0, 0}, {90, 30, 0}, {30, 30, 0}, {30, 90, 0}, {0, 90, 0}});
  polygons.add({{-9000, -9000, 99}, {-9000, 9000, 99}, {9000, 9000, 99}, {9000, -9000, 99}});
  const test::Tables tables(32);
  const auto seen = [&](int eyes) {
    return test::Hemicube(polygons.pod(), tables, 32, std::uint8_t(urad::hemicube_coverage | eyes))
        .row(0)[1];
  };
  CHECK(std::fabs(seen(urad::hemicube_four_eyes) * 0x1p-32 - seen(0) * 0x1p-32) < 1e-3);
}
