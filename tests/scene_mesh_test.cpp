#include "scene/mesh.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <utility>

#include "random_room.hpp"
#include "scene/builtin.hpp"
#include "scene/obj.hpp"

using host::Vec3;

namespace {

host::Face face(const host::Loop& loop, int material = 0, std::array<int, 2> counts = {1, 1}) {
  return {{loop, {}}, material, counts, "test.obj:1"};
}

host::Scene mesh(const std::vector<host::Face>& faces, const host::MeshOptions& options = {}) {
  return host::mesh_faces("test", {{"wall", Vec3(0.5), Vec3(1)}, {"other", Vec3(0.25), Vec3(0)}},
                          faces, options)
      .scene;
}

double area(const host::Scene& scene, int surface) {
  double sum = 0;
  for (const host::ScenePatch& patch : scene.patches)
    if (patch.surface == surface) sum += patch.moments.area;
  return sum;
}

const host::Loop kSquare = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
const host::Loop kKite = {{0, 0, 1}, {0, 1, 1}, {2, 2, 1}, {1, 0, 1}};
const host::Loop kTriangle = {{0, 0, 2}, {0, 3, 2}, {4, 0, 2}};
const host::Loop kConcave = {{0, 0, 3}, {0, 2, 3}, {1, 0.5, 3}, {3, 0, 3}};

}  // namespace

TEST_CASE("each kind of face is cut into patches that keep its area and plane") {
  const std::vector<host::Face> faces = {face(kSquare), face(kKite), face(kTriangle),
                                         face(kConcave)};
  const host::Scene whole = mesh(faces), cut = mesh(faces, {4, 0});
  CHECK(whole.patches.size() == 4);
  REQUIRE(cut.surfaces.size() == 4);
  const int expected[4] = {16, 16, 16, 32};
  for (int s = 0; s < 4; ++s) {
    CAPTURE(s);
    CHECK(cut.surfaces[std::size_t(s)].patch_count == expected[s]);
    CHECK(area(cut, s) == doctest::Approx(area(whole, s)).epsilon(1e-14));
  }
  CHECK(cut.surfaces[0].grid.has_value());
  for (const host::ScenePatch& patch : cut.patches) {
    const host::Moments& parent = whole.patches[std::size_t(patch.surface)].moments;
    REQUIRE(glm::length(patch.moments.normal - parent.normal) < 1e-13);
  }
}

TEST_CASE("a patch size gives patches no longer than that, and one cut fewer would not do") {
  const host::Scene scene = mesh({face(kSquare), face(kKite), face(kTriangle)}, {0, 0.5});
  CHECK(scene.surfaces[0].grid->count_u == 4);
  CHECK(scene.surfaces[0].grid->count_v == 2);
  CHECK(scene.surfaces[1].patch_count == 5 * 5);    // sqrt(5) is its longest edge both ways
  CHECK(scene.surfaces[2].patch_count == 10 * 10);  // hypotenuse 5
}

TEST_CASE("faces of one plane and material are one surface, whatever order they come in") {
  std::vector<host::Face> faces;
  for (const auto& [x, y] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {1.0, 1.0}})
    faces.push_back(face({{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}}));
  faces.push_back(face({{5, 0, 0}, {5, 1, 0}, {6, 1, 0}, {6, 0, 0}}));     // same plane, other side
  faces.push_back(face({{5, 5, 0}, {6, 5, 0}, {6, 6, 0}, {5, 6, 0}}, 1));  // other material
  const host::Scene scene = mesh(faces);
  REQUIRE(scene.surfaces.size() == 3);
  REQUIRE(scene.surfaces[0].grid);
  CHECK(scene.surfaces[0].grid->count_u == 2);
  CHECK(scene.output_order == std::vector<int>{1, 2, 0, 3, 4, 5});
  faces[3].polygon.outer = {{3, 1, 0}, {4, 1, 0}, {4, 2, 0}, {3, 2, 0}};  // no rectangle any more
  const host::Scene loose = mesh(faces);
  CHECK_FALSE(loose.surfaces[0].grid);
  CHECK(loose.surfaces[0].patch_count == 4);
  CHECK(loose.output_order.empty());
}

TEST_CASE("faces that miss their plane by the rounding of a file are laid into it") {
  const host::Scene scene =
      mesh({face({{0, 0, 0}, {1, 0, 2e-6}, {1, 1, -1e-6}, {0.3, 1, 1e-6}}), face(kKite)}, {3, 0});
  const host::Moments plane = host::moments(scene.patches[0].polygon);
  for (int k = 0; k < 9; ++k)
    for (const Vec3& x : scene.patches[std::size_t(k)].polygon.outer)
      CHECK(std::abs(glm::dot(plane.normal, x - plane.centroid)) < 1e-15);
}

TEST_CASE("cube7 is convex and closed, without blockers") {
  const host::Scene scene = host::load_scene("cube7");
  CHECK(scene.patches.size() == 294);
  CHECK(scene.surfaces.size() == 6);
  CHECK(scene.blockers.empty());
  CHECK(scene.convex);
  CHECK(scene.closed);
}

TEST_CASE("the Cornell box has the light and the two blocks as blockers, and an open front") {
  const host::Scene scene = host::load_scene("cornell");
  CHECK(scene.patches.size() == 354);
  CHECK(scene.blockers.size() == 11);
  CHECK_FALSE(scene.convex);
  CHECK_FALSE(scene.closed);
  double emitting = 0;
  for (std::size_t k = 0; k < scene.patches.size(); ++k) {
    const bool light = scene.material_of(k).exitance != Vec3(0);
    if (!light) continue;
    emitting += scene.patches[k].moments.area;
    CHECK(scene.patches[k].moments.normal == Vec3(0, -1, 0));
  }
  CHECK(emitting == doctest::Approx(130 * 105));
}

TEST_CASE(
    "rooms of any sides, place, turn and scale are seen as convex and closed, and as open without "
    "a wall") {
  constexpr unsigned seed = 1996;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 30; ++round) {
    const double scale = std::pow(10, round % 3 * 3 - 3);
    CAPTURE(round);
    const test::RandomRoom room = test::random_room(random, scale);
    const host::Scene scene =
        host::parse_obj(room.obj, "room.obj", {}, [&](const std::string&) { return room.mtl; });
    CHECK(scene.surfaces.size() == 6);
    CHECK(int(scene.patches.size()) == room.patches);
    CHECK(scene.convex);
    CHECK(scene.closed);
    std::string open = room.obj;
    open.erase(open.rfind("f "));
    const host::Scene rest = host::parse_obj(open + "usemtl lamp\nf 1 3 7 5\n", "room.obj", {},
                                             [&](const std::string&) { return room.mtl; });
    CHECK(rest.convex);
    CHECK_FALSE(rest.closed);
  }
}
