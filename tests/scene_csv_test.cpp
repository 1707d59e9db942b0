#include "scene/patch_csv.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.hpp"
#include "geometry/parse.hpp"
#include "scene/builtin.hpp"

using host::Vec3;

namespace {

host::Scene read(const std::string& text) {
  const std::string path = std::string(URAD_SCRATCH_DIR) + "/scene_csv_test.csv";
  std::ofstream(path) << text;
  try {
    host::Scene scene = host::load_scene(path);
    std::filesystem::remove(path);
    return scene;
  } catch (...) {
    std::filesystem::remove(path);
    throw;
  }
}

std::string table_of(const host::Scene& scene, const std::vector<std::size_t>& order) {
  std::string text = "patch,note,polygon,rho_r,rho_g,rho_b,emit_r,emit_g,emit_b\n";
  for (const std::size_t k : order) {
    const host::Material& m = scene.material_of(k);
    text += "p" + std::to_string(k) + ",\"a, b\"," + host::write_polygon(scene.patches[k].polygon);
    for (const Vec3& rgb : {m.reflectance, m.exitance})
      for (int c = 0; c < 3; ++c) text += "," + std::to_string(rgb[c]);
    text += "\n";
  }
  return text;
}

constexpr const char* kHeader = "patch,polygon,rho_r,rho_g,rho_b,emit\n";
constexpr const char* kGood = "a,0 0 0;1 0 0;1 1 0,0.5,0.5,0.5,1\n";

}  // namespace

TEST_CASE("a shuffled patch table gives back the grids, and tables keep its order") {
  const host::Scene cube = host::load_scene("cube7");
  std::vector<std::size_t> order(cube.patches.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  for (const bool shuffled : {false, true}) {
    CAPTURE(shuffled);
    if (shuffled) std::shuffle(order.begin(), order.end(), std::mt19937(1996));
    const host::Scene scene = read(table_of(cube, order));
    REQUIRE(scene.surfaces.size() == 6);
    for (const host::Surface& surface : scene.surfaces) {
      REQUIRE(surface.grid);
      CHECK(surface.grid->count_u == 7);
      CHECK(surface.grid->count_v == 7);
    }
    CHECK(scene.closed);
    CHECK(scene.convex);
    CHECK(scene.output_order.empty() == !shuffled);
    for (std::size_t row = 0; row < order.size(); ++row) {
      const std::size_t patch = scene.patch_of_row(row);
      REQUIRE(scene.label_of_row(row) == "p" + std::to_string(order[row]));
      const Vec3 expected = cube.patches[order[row]].moments.centroid;
      REQUIRE(glm::length(scene.patches[patch].moments.centroid - expected) < 1e-12);
      REQUIRE(scene.material_of(patch).exitance == cube.material_of(order[row]).exitance);
      REQUIRE(scene.material_of(patch).reflectance == cube.material_of(order[row]).reflectance);
    }
  }
}

TEST_CASE("patches that tile no grid stay a list, holes and all") {
  const host::Scene scene = read(std::string(kHeader) + kGood +
                                 "b,0 0 0;1 1 0;0 1 0,0.5,0.5,0.5,1\n"
                                 "c,0 0 1;0 3 1;3 3 1;3 0 1|1 1 1;2 1 1;2 2 1,0.5,0.5,0.5,0\n");
  REQUIRE(scene.surfaces.size() == 2);
  CHECK_FALSE(scene.surfaces[0].grid);
  CHECK(scene.surfaces[0].patch_count == 2);
  CHECK(scene.patches[2].moments.area == doctest::Approx(8.5));
  CHECK(scene.label_of_row(2) == "c");
}

TEST_CASE("every bad patch table gets one sentence with file and line") {
  const auto check = [](const std::string& rows, const std::string& line, const std::string& part) {
    CAPTURE(rows);
    const std::string start = "scene_csv_test.csv:" + line + ": ";
    CHECK_THROWS_WITH_AS(read(rows), doctest::Contains(start.c_str()), host::Error);
    CHECK_THROWS_WITH_AS(read(rows), doctest::Contains(part.c_str()), host::Error);
  };
  const std::string good = std::string(kHeader) + kGood;
  check(good + "b,0 0 1;1 0 1,0.5,0.5,0.5,1\n", "3", "3 vertices");
  check(good + "b,0 0 1;1 0 1;nan 1 1,0.5,0.5,0.5,1\n", "3", "not a number");
  check(good + "b,0 0 1;1 0 1;zz 1 1,0.5,0.5,0.5,1\n", "3", "form");
  check(good + "b,0 0 1;1 0 1;2 0 1,0.5,0.5,0.5,1\n", "3", "zero area");
  check(good + "b,0 0 1;1 0 1;1 1 1,0.5,1.01,0.5,1\n", "3", "rho_g is 1.01");
  check(good + "b,0 0 1;1 0 1;1 1 1,0.5,0.5,-1,1\n", "3", "rho_b is -1");
  check(good + "b,0 0 1;1 0 1;1 1 1,0.5,0.5,0.5,-1\n", "3", "emit is -1");
  check(good + "b,0 0 1;1 0 1;1 1 1,0.5,0.5,half,1\n", "3", "'half'");
  check(good + "b,0 0 1;1 0 1;1 1 1,0.5,0.5,inf,1\n", "3", "'inf'");
  check(good + "a,0 0 1;1 0 1;1 1 1,0.5,0.5,0.5,1\n", "3", "earlier line");
  check(good, "2", "one patch");
  check(std::string(kHeader) +
            "a,0 0 0;1 0 0;1 1 0,0.5,0.5,0.5,0\nb,0 0 1;1 0 1;1 1 1,0.5,0.5,0.5,0\n",
        "2", "no light");
  CHECK_THROWS_WITH_AS(read("patch,polygon,rho_r,rho_g,emit\n"), doctest::Contains("rho_b"),
                       host::Error);
  CHECK_THROWS_WITH_AS(host::load_scene("x.csv", {2, 0}), doctest::Contains("--subdivide"),
                       host::Error);
}

TEST_CASE("the public cube table is the built-in cube7, patch by patch") {
  const host::Scene cube = host::load_scene("cube7");
  CHECK(cube.patches[0].polygon.outer[1] ==
        Vec3(0, 0, 1.0 / 7));  // first edge of the first patch runs along z
  CHECK(cube.patches[48].polygon.outer[2] == Vec3(1, 0, 1));
  CHECK(glm::length(cube.patches[99].polygon.outer[0] - Vec3(0, 1.0 / 7, 0)) < 1e-15);
  CHECK(cube.material_of(98).reflectance == Vec3(0.75, 0.1, 0.1));
  CHECK(cube.material_of(147).reflectance == Vec3(0.1, 0.1, 0.75));
  CHECK(cube.material_of(245).exitance == Vec3(1));
}
