// Every field of a scene and of a pose table, one at a time out of its range: refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "scene/fixed_scene.hpp"
#include "urad/urad.h"

namespace {

/// Two facing squares, the upper one a polygon list of two triangles, with a blocker between them,
/// a box around it and a row of codes for each patch: every table that a scene can have.
struct Plain {
  urad_grid grid{};
  urad_polygon polygon[2]{};
  urad_surface surface[2]{};
  urad_material material{};
  urad_blocker blocker{};
  urad_bounds bounds{};
  urad_point vertex[7]{};
  std::int32_t scale[3] = {0, 0, 0};
  std::uint32_t row[3] = {0, 2, 4 | URAD_VISIBILITY_RUNS};
  std::uint8_t code[5] = {0xFF, 0xF, 0xFF, 0xF, 0xF2};
  urad_visibility visibility{};
  urad_scene scene{};

  Plain() {
    const host::FixedScene fixed =
        host::FixedScene::of_polygons({{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}},
                                       {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}}, {}},
                                       {{{0, 0, 1}, {1, 1, 1}, {1, 0, 1}}, {}}},
                                      {{{{0.2, 0.2, 0.5}, {0.8, 0.2, 0.5}, {0.5, 0.8, 0.5}}, {}}});
    const urad_scene& made = fixed.pod();
    REQUIRE(urad_grid_make({0, 0, 0}, {1 << 20, 0, 0}, {0, 1 << 20, 0}, 1, 1, &grid) == URAD_OK);
    // Loops are looked up, not compared with shapes: both triangles may share one.
    for (int k = 0; k < 2; ++k) polygon[k] = made.surface[1 + k].polygon[0];
    blocker = made.blocker[0];
    std::copy_n(made.vertex + blocker.first_vertex, 3, vertex);
    std::copy_n(made.vertex + polygon[0].first_vertex, 3, vertex + 3);
    polygon[0].first_vertex = polygon[1].first_vertex = 3;
    blocker.first_vertex = 0;
    blocker.surface = 0xFFFF;
    vertex[6] = vertex[3];  // the same loop from its second vertex
    surface[0] = {0, 1, 0, URAD_SURFACE_PLANAR, &grid, nullptr};
    surface[1] = {1, 2, 0, URAD_SURFACE_PLANAR, nullptr, polygon};
    bounds = {blocker.low, blocker.high, 0, 1, 1, 0};
    visibility = {3, 4, 0, 5, row, code};
    scene.abi = URAD_SCENE_ABI_SIGHT;
    scene.patch_count = 3;
    scene.surface_count = 2;
    scene.material_count = scene.blocker_count = scene.bounds_count = 1;
    scene.vertex_count = 7;
    scene.surface = surface;
    scene.material = &material;
    scene.blocker = &blocker;
    scene.vertex = vertex;
    scene.bounds = &bounds;
    scene.visibility = &visibility;
    scene.log2_scale_q24 = scale;
  }
  Plain(const Plain&) = delete;
};

/// All vertices at 5 along an axis, and the centroids of both polygons so far from there. Of
/// polygons alone: the box of the blocker is not made to fit.
void set_apart(Plain& p, std::int32_t urad_point::*axis, std::int32_t distance) {
  p.scene.bounds_count = 0;
  for (urad_point& vertex : p.vertex) vertex.*axis = 5;
  for (urad_polygon& polygon : p.polygon) polygon.centroid.*axis = 5 + distance;
}

struct Wrong {
  const char* what;
  std::function<void(Plain&)> make;
};

constexpr std::int32_t kFar = URAD_COORDINATE_MAX + 1, kOne = 1 << 30;

}  // namespace

TEST_CASE("a scene with any one field out of range is refused") {
  const std::vector<Wrong> wrongs{
      {"abi", [](Plain& p) { p.scene.abi = 3; }},
      {"no patches", [](Plain& p) { p.scene.patch_count = 0; }},
      {"no surfaces", [](Plain& p) { p.scene.surface = nullptr; }},
      {"no materials", [](Plain& p) { p.scene.material = nullptr; }},
      {"blockers but no table", [](Plain& p) { p.scene.blocker = nullptr; }},
      {"vertices but no table", [](Plain& p) { p.scene.vertex = nullptr; }},
      {"bounds but no table", [](Plain& p) { p.scene.bounds = nullptr; }},
      {"power", [](Plain& p) { p.scene.log2_power_q24 = (64 << 24) + 1; }},
      {"patches that do not add up", [](Plain& p) { p.scene.patch_count = 4; }},
      {"a surface of no patch", [](Plain& p) { p.surface[1].patch_count = 0; }},
      {"a gap between surfaces", [](Plain& p) { p.surface[1].first_patch = 2; }},
      {"material", [](Plain& p) { p.surface[0].material = 1; }},
      {"neither grid nor polygons", [](Plain& p) { p.surface[0].grid = nullptr; }},
      {"grid and polygons", [](Plain& p) { p.surface[1].grid = &p.grid; }},
      {"grid of no column", [](Plain& p) { p.grid.count_u = 0; }},
      {"grid of no row", [](Plain& p) { p.grid.count_v = 0; }},
      {"grid of other patches", [](Plain& p) { p.grid.count_u = 2; }},
      {"grid outside, x", [](Plain& p) { p.grid.origin.x = kFar; }},
      {"grid outside, y", [](Plain& p) { p.grid.origin.y = -kFar; }},
      {"grid outside, z", [](Plain& p) { p.grid.origin.z = kFar; }},
      {"grid leaves by u, x", [](Plain& p) { p.grid.step_u.x = kFar; }},
      {"grid leaves by u, y", [](Plain& p) { p.grid.step_u.y = -kFar; }},
      {"grid leaves by v, z", [](Plain& p) { p.grid.step_v.z = kFar; }},
      {"grid leaves by both",
       [](Plain& p) { p.grid.step_u.y = p.grid.step_v.y = URAD_COORDINATE_MAX - 9; }},
      {"normal, z", [](Plain& p) { p.grid.shape.normal_q30.z = kOne + 1; }},
      {"normal, x", [](Plain& p) { p.grid.shape.normal_q30.x = -kOne - 1; }},
      {"normal, y", [](Plain& p) { p.grid.shape.normal_q30.y = kOne + 1; }},
      {"normal too short", [](Plain& p) { p.grid.shape.normal_q30.z = kOne - (1 << 12); }},
      {"area", [](Plain& p) { p.grid.shape.log2_area_q24 = -(64 << 24) - 1; }},
      {"spread", [](Plain& p) { p.grid.shape.log2_spread_q24 = (64 << 24) + 1; }},
      {"trace too small", [](Plain& p) { p.grid.shape.spread_q15[0] = 16364; }},
      {"trace too large", [](Plain& p) { p.grid.shape.spread_q15[0] = 16404; }},
      {"negative xx",
       [](Plain& p) { p.grid.shape.spread_q15[0] = -4, p.grid.shape.spread_q15[1] = 32767; }},
      {"negative yy",
       [](Plain& p) { p.grid.shape.spread_q15[1] = -4, p.grid.shape.spread_q15[0] = 32767; }},
      {"negative zz",
       [](Plain& p) {
         p.grid.shape.spread_q15[2] = -9;
         p.grid.shape.spread_q15[0] = 16393;
       }},
      {"xz without zz", [](Plain& p) { p.grid.shape.spread_q15[4] = 900; }},
      {"yz without zz", [](Plain& p) { p.grid.shape.spread_q15[5] = -900; }},
      {"fill", [](Plain& p) { p.grid.shape.fill_uq15 = 32769; }},
      {"shape of a polygon", [](Plain& p) { p.polygon[1].shape.fill_uq15 = 32769; }},
      {"centroid", [](Plain& p) { p.polygon[1].centroid.x = kFar; }},
      {"centroids beside their vertices, x", [](Plain& p) { set_apart(p, &urad_point::x, 2); }},
      {"centroids beside their vertices, y", [](Plain& p) { set_apart(p, &urad_point::y, -2); }},
      {"centroids above their vertices", [](Plain& p) { set_apart(p, &urad_point::z, 2); }},
      {"centroids below their vertices", [](Plain& p) { set_apart(p, &urad_point::z, -2); }},
      {"polygons and no vertex",
       [](Plain& p) { p.scene.vertex = nullptr, p.scene.vertex_count = 0; }},
      {"two vertices", [](Plain& p) { p.polygon[1].vertex_count = 2; }},
      {"too many vertices", [](Plain& p) { p.polygon[1].vertex_count = 65; }},
      {"loop that starts outside", [](Plain& p) { p.polygon[1].first_vertex = 7; }},
      {"loop that ends outside", [](Plain& p) { p.polygon[1].first_vertex = 5; }},
      {"reflectance", [](Plain& p) { p.material.reflectance_uq15[2] = 32769; }},
      {"negative exitance", [](Plain& p) { p.material.exitance[1] = -1; }},
      {"exitance", [](Plain& p) { p.material.exitance[0] = kOne + 1; }},
      {"vertex outside", [](Plain& p) { p.vertex[6].y = kFar; }},
      {"normal of a blocker",
       [](Plain& p) {
         p.blocker.normal_q30 = {0, 0, 0};
       }},
      {"low end of a blocker", [](Plain& p) { p.blocker.low.z = -kFar; }},
      {"high end of a blocker", [](Plain& p) { p.blocker.high.x = kFar; }},
      {"loop of a blocker", [](Plain& p) { p.blocker.vertex_count = 8; }},
      {"surface of a blocker", [](Plain& p) { p.blocker.surface = 2; }},
      {"scale", [](Plain& p) { p.scale[2] = -(8 << 24) - 1; }},
      {"box of no blocker", [](Plain& p) { p.bounds.end = 0; }},
      {"box of more blockers", [](Plain& p) { p.bounds.end = 2; }},
      {"box that goes back", [](Plain& p) { p.bounds.next = 0; }},
      {"box that goes too far", [](Plain& p) { p.bounds.next = 2; }},
      {"box that is too small", [](Plain& p) { p.bounds.high.y -= 1; }},
      {"box that starts too late", [](Plain& p) { p.bounds.low.x += 1; }},
      {"codes of other patches", [](Plain& p) { p.visibility.patch_count = 2; }},
      {"codes of 2 bits", [](Plain& p) { p.visibility.bits = 2; }},
      {"no rows", [](Plain& p) { p.visibility.row = nullptr; }},
      {"no codes", [](Plain& p) { p.visibility.code = nullptr; }},
      {"row that starts outside", [](Plain& p) { p.row[1] = 5; }},
      {"row that ends outside", [](Plain& p) { p.row[1] = 4; }},
      {"runs that fall short", [](Plain& p) { p.code[4] = 0xF1; }},
      {"runs that go too far", [](Plain& p) { p.code[4] = 0xF3; }}};
  {
    const Plain plain;
    REQUIRE(urad_scene_check(&plain.scene) == URAD_OK);
  }
  for (const Wrong& wrong : wrongs) {
    Plain plain;
    wrong.make(plain);
    CHECK_MESSAGE(urad_scene_check(&plain.scene) == URAD_BAD_SCENE, wrong.what);
  }
}

TEST_CASE("what the check need not look at may be absent, and an end of a range is in it") {
  const std::vector<Wrong> fine{
      {"no blockers", [](Plain& p) { p.scene.blocker_count = 0, p.scene.bounds_count = 0; }},
      {"no sight", [](Plain& p) { p.scene.visibility = nullptr; }},
      {"sight is not read in the first ABI",
       [](Plain& p) { p.scene.abi = URAD_SCENE_ABI, p.visibility.bits = 7; }},
      {"no scale", [](Plain& p) { p.scene.log2_scale_q24 = nullptr; }},
      {"greatest scale", [](Plain& p) { p.scale[0] = 8 << 24, p.scale[1] = -(8 << 24); }},
      {"greatest power", [](Plain& p) { p.scene.log2_power_q24 = -(64 << 24); }},
      {"greatest exitance", [](Plain& p) { p.material.exitance[0] = kOne; }},
      {"reflectance 1", [](Plain& p) { p.material.reflectance_uq15[1] = 32768; }},
      {"a vertex at the limit", [](Plain& p) { p.vertex[6].y = -URAD_COORDINATE_MAX; }},
      {"centroids a unit above their vertices", [](Plain& p) { set_apart(p, &urad_point::z, 1); }},
      {"centroids a unit below their vertices", [](Plain& p) { set_apart(p, &urad_point::z, -1); }},
      {"a loop to the end of the table", [](Plain& p) { p.polygon[1].first_vertex = 4; }},
      {"the last surface", [](Plain& p) { p.blocker.surface = 1; }}};
  for (const Wrong& case_ : fine) {
    Plain plain;
    case_.make(plain);
    CHECK_MESSAGE(urad_scene_check(&plain.scene) == URAD_OK, case_.what);
  }
}

TEST_CASE("a pose table with any one field out of range is refused") {
  struct Table {
    Plain plain;
    std::uint16_t block_of[4] = {URAD_POSE_NO_BLOCK, 0, URAD_POSE_NO_BLOCK, URAD_POSE_NO_BLOCK};
    urad_pose_block block{};
    std::uint32_t value[4] = {};
    urad_pose_table table{};

    Table() {
      block.axis[0].stride = 1;
      table = {URAD_POSE_TABLE_ABI, 3, 2, 1, 4, block_of, &block, value};
    }
    urad_status check() const { return urad_pose_table_check(&table, &plain.scene); }
  };
  struct Case {
    const char* what;
    std::function<void(Table&)> make;
    urad_status expected;
  };
  const std::vector<Case> cases{
      {"as it is", [](Table&) {}, URAD_OK},
      {"abi", [](Table& t) { ++t.table.abi; }, URAD_BAD_SCENE},
      {"patches", [](Table& t) { ++t.table.patch_count; }, URAD_BAD_SCENE},
      {"surfaces", [](Table& t) { ++t.table.surface_count; }, URAD_BAD_SCENE},
      {"no directory", [](Table& t) { t.table.block_of = nullptr; }, URAD_BAD_SCENE},
      {"no blocks", [](Table& t) { t.table.block = nullptr; }, URAD_BAD_SCENE},
      {"no values", [](Table& t) { t.table.value_uq32 = nullptr; }, URAD_BAD_SCENE},
      {"nothing in it",
       [](Table& t) {
         t.block_of[1] = URAD_POSE_NO_BLOCK;
         t.table.block_count = 0, t.table.value_count = 0;
         t.table.block = nullptr, t.table.value_uq32 = nullptr;
       },
       URAD_OK},
      {"too many values", [](Table& t) { t.table.value_count = URAD_POSE_VALUES_MAX + 1u; },
       URAD_BAD_SCENE},
      {"block outside", [](Table& t) { t.block_of[2] = 1; }, URAD_BAD_SCENE},
      {"from a list to a grid", [](Table& t) { t.block_of[2] = 0; }, URAD_OK},
      {"factor above 1", [](Table& t) { t.block.axis[0].from_u = 2; }, URAD_BAD_SCENE},
      {"factor below -1", [](Table& t) { t.block.axis[1].from_v = -2; }, URAD_BAD_SCENE},
      {"mirror", [](Table& t) { t.block.mirror[1] = 3; }, URAD_BAD_SCENE},
      {"ends after the table", [](Table& t) { t.block.first = 3; }, URAD_BAD_SCENE},
      {"last value", [](Table& t) { t.block.first = 2; }, URAD_OK},
      {"begins before the table", [](Table& t) { t.block.axis[0].offset = -1; }, URAD_BAD_SCENE},
      // Positions -3 and -2 about 0 are 3 and 2; about a half 2 and 1.
      {"about 0", [](Table& t) { t.block.axis[0].offset = -3, t.block.mirror[0] = 1; }, URAD_OK},
      {"about 0, beyond", [](Table& t) { t.block.axis[0].offset = -4, t.block.mirror[0] = 1; },
       URAD_BAD_SCENE},
      {"about a half", [](Table& t) { t.block.axis[0].offset = -4, t.block.mirror[0] = 2; },
       URAD_OK},
      {"about a half, beyond", [](Table& t) { t.block.axis[0].offset = -5, t.block.mirror[0] = 2; },
       URAD_BAD_SCENE},
      {"about a half, the side beyond it the longer",
       [](Table& t) { t.block.axis[0].offset = -1, t.block.mirror[0] = 2; }, URAD_OK}};
  for (const Case& case_ : cases) {
    Table table;
    case_.make(table);
    CHECK_MESSAGE(table.check() == case_.expected, case_.what);
  }
}
