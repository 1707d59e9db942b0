#include "scene/c_export.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "program.hpp"
#include "scene/builtin.hpp"
#include "solve/exported_visibility.hpp"

namespace {

// A checksum over what a scene points to, in C; the same expression is evaluated here on the host's
// own tables.
constexpr const char* kChecksum =
    "static uint32_t mix(uint32_t h, int64_t x) { return (h ^ (uint32_t)x) * 16777619u; }\n"
    "static uint32_t checksum(const urad_scene *s) {\n"
    "  uint32_t h = 2166136261u, k, i;\n"
    "#define MIX(x) h = mix(h, x)\n"
    "  MIX(s->abi); MIX(s->flags); MIX(s->patch_count); MIX(s->blocker_count); "
    "MIX(s->log2_power_q24);\n"
    "  for (k = 0; k < s->vertex_count; ++k) { MIX(s->vertex[k].x); MIX(s->vertex[k].y); "
    "MIX(s->vertex[k].z); }\n"
    "  for (k = 0; k < s->material_count; ++k)\n"
    "    for (i = 0; i < 3; ++i) { MIX(s->material[k].reflectance_uq15[i]); "
    "MIX(s->material[k].exitance[i]); }\n"
    "  for (k = 0; k < s->surface_count; ++k) {\n"
    "    const urad_surface *f = &s->surface[k];\n"
    "    MIX(f->first_patch); MIX(f->material); MIX(f->flags);\n"
    "    if (f->grid) { MIX(f->grid->origin.x); MIX(f->grid->step_v.z); "
    "MIX(f->grid->shape.log2_area_q24);\n"
    "      MIX(f->grid->shape.spread_q15[5]); MIX(f->grid->shape.fill_uq15); "
    "MIX(f->grid->count_v); }\n"
    "    else for (i = 0; i < f->patch_count; ++i) { MIX(f->polygon[i].centroid.y);\n"
    "      MIX(f->polygon[i].shape.normal_q30.z); MIX(f->polygon[i].shape.log2_spread_q24);\n"
    "      MIX(f->polygon[i].first_vertex); MIX(f->polygon[i].vertex_count); }\n"
    "  }\n"
    "  for (k = 0; k < s->blocker_count; ++k) { MIX(s->blocker[k].normal_q30.x); "
    "MIX(s->blocker[k].low.x);\n"
    "    MIX(s->blocker[k].high.z); MIX(s->blocker[k].first_vertex); MIX(s->blocker[k].surface); "
    "}\n"
    "  for (k = 0; k < s->bounds_count; ++k) { MIX(s->bounds[k].low.y); MIX(s->bounds[k].high.x); "
    "MIX(s->bounds[k].end); MIX(s->bounds[k].next); }\n"
    "  if (s->visibility) {\n"
    "    MIX(s->visibility->bits); MIX(s->visibility->patch_count);\n"
    "    for (k = 0; k < s->patch_count; ++k) MIX(s->visibility->row[k]);\n"
    "    for (k = 0; k < s->visibility->byte_count; ++k) MIX(s->visibility->code[k]);\n"
    "  }\n"
    "  if (s->log2_scale_q24) for (k = 0; k < s->patch_count; ++k) MIX(s->log2_scale_q24[k]);\n"
    "  return h;\n"
    "}\n";

uint32_t checksum(const urad_scene& s) {
  uint32_t h = 2166136261u;
  const auto mix = [&](auto x) { h = (h ^ uint32_t(x)) * 16777619u; };
  mix(s.abi), mix(s.flags), mix(s.patch_count), mix(s.blocker_count), mix(s.log2_power_q24);
  for (uint32_t k = 0; k < s.vertex_count; ++k)
    mix(s.vertex[k].x), mix(s.vertex[k].y), mix(s.vertex[k].z);
  for (uint32_t k = 0; k < s.material_count; ++k)
    for (int i = 0; i < 3; ++i)
      mix(s.material[k].reflectance_uq15[i]), mix(s.material[k].exitance[i]);
  for (uint32_t k = 0; k < s.surface_count; ++k) {
    const urad_surface& f = s.surface[k];
    mix(f.first_patch), mix(f.material), mix(f.flags);
    if (f.grid) {
      mix(f.grid->origin.x), mix(f.grid->step_v.z), mix(f.grid->shape.log2_area_q24);
      mix(f.grid->shape.spread_q15[5]), mix(f.grid->shape.fill_uq15), mix(f.grid->count_v);
      continue;
    }
    for (uint32_t i = 0; i < f.patch_count; ++i) {
      mix(f.polygon[i].centroid.y), mix(f.polygon[i].shape.normal_q30.z),
          mix(f.polygon[i].shape.log2_spread_q24);
      mix(f.polygon[i].first_vertex), mix(f.polygon[i].vertex_count);
    }
  }
  for (uint32_t k = 0; k < s.blocker_count; ++k) {
    mix(s.blocker[k].normal_q30.x), mix(s.blocker[k].low.x), mix(s.blocker[k].high.z);
    mix(s.blocker[k].first_vertex), mix(s.blocker[k].surface);
  }
  for (uint32_t k = 0; k < s.bounds_count; ++k) {
    mix(s.bounds[k].low.y), mix(s.bounds[k].high.x), mix(s.bounds[k].end), mix(s.bounds[k].next);
  }
  if (s.visibility) {
    mix(s.visibility->bits), mix(s.visibility->patch_count);
    for (uint32_t k = 0; k < s.patch_count; ++k) mix(s.visibility->row[k]);
    for (uint32_t k = 0; k < s.visibility->byte_count; ++k) mix(s.visibility->code[k]);
  }
  if (s.log2_scale_q24)
    for (uint32_t k = 0; k < s.patch_count; ++k) mix(s.log2_scale_q24[k]);
  return h;
}

}  // namespace

TEST_CASE(
    "exported scenes compile as C99 and C++17 without a warning and hold the host's integers") {
  const std::filesystem::path folder = std::filesystem::path(URAD_SCRATCH_DIR) / "scene_c_test";
  std::filesystem::create_directories(folder);
  std::string program = "#include \"cube7.h\"\n#include \"cornell.h\"\n#include \"light.h\"\n" +
                        std::string(kChecksum);
  program += "int main(void) {\n  return ";
  for (const std::string name : {"cube7", "cornell"}) {
    const host::Scene scene = host::load_scene(name);
    host::FixedScene fixed(scene);
    if (!scene.convex)
      fixed.set_visibility(
          host::make_visibility(scene, fixed, host::VisibilityCode::fractions, 16, 0));
    if (scene.closed) fixed.set_scale(std::vector<double>(scene.patches.size(), 1.001));
    std::ofstream(folder / (name + ".h")) << host::scene_to_c(fixed, name, "urad bake " + name);
    program +=
        "checksum(&urad_" + name + "_scene) != " + std::to_string(checksum(fixed.pod())) + "u || ";
    std::vector<int32_t> light(3 * scene.patches.size(), -7);
    light[5] = INT32_MIN;
    std::ofstream(folder / "light.h") << host::light_to_c(fixed, light, name, "urad bake " + name);
  }
  program +=
      "urad_cornell_light[1][2] != -2147483647 - 1 || urad_cornell_light[353][0] != -7;\n}\n";
  std::ofstream(folder / "main.c") << program;
  std::ofstream(folder / "main.cpp") << program;
  const std::string flags =
      " -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I" URAD_SOURCE_DIR
      "/firmware_style/include -o " +
      (folder / "main").string() + " " + folder.string();
  CHECK(test::runs(URAD_CC " -std=c99" + flags + "/main.c"));
  CHECK(test::runs((folder / "main").string()));
  CHECK(test::runs(URAD_CXX " -std=c++17" + flags + "/main.cpp"));
  CHECK(test::runs((folder / "main").string()));
  std::filesystem::remove_all(folder);
}

TEST_CASE("exporting twice gives the same bytes, and comments cannot be broken out of") {
  const host::Scene scene = host::load_scene("cornell");
  const std::string once = host::scene_to_c(host::FixedScene(scene), "room", "urad bake */ x");
  CHECK(once ==
        host::scene_to_c(host::FixedScene(host::load_scene("cornell")), "room", "urad bake */ x"));
  CHECK(once.find("urad bake */") == std::string::npos);
}

TEST_CASE("names that C does not take are refused or made over") {
  const host::FixedScene fixed(host::load_scene("cube7"));
  CHECK_THROWS_AS(host::scene_to_c(fixed, "my room", "x"), host::Error);
  CHECK_THROWS_AS(host::scene_to_c(fixed, "7", "x"), host::Error);
  CHECK_THROWS_AS(host::light_to_c(fixed, std::vector<int32_t>(293 * 3), "a", "x"), host::Error);
  CHECK(host::c_identifier("some/where/my room-2.obj") == "my_room_2");
  CHECK(host::c_identifier("7up.csv") == "scene_7up");
  CHECK(host::c_identifier("") == "scene_");
}
