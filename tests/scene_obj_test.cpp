#include "scene/obj.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "scene/builtin.hpp"

using host::Vec3;

namespace {

constexpr const char* kMaterials =
    "newmtl white\nKd 0.5 0.6 0.7\nnewmtl lamp\nKd 0 0 0\nKe 3 2 1\nnewmtl without\nKa 1 1 1\n"
    "newmtl bright\nKd 0.5 1.5 0.5\nnewmtl odd\nKd -0.1 0 0\nnewmtl hole\nKd 0 0 0\nKe 0 -1 0\n";

host::Scene parse(const std::string& obj, const std::string& mtl = kMaterials,
                  const host::MeshOptions& options = {}) {
  return host::parse_obj(obj, "room.obj", options, [&](const std::string& name) {
    if (name != "room.mtl") throw host::Error("cannot read " + name);
    return mtl;
  });
}

std::string message(const std::string& obj, const std::string& mtl = kMaterials,
                    const host::MeshOptions& options = {}) {
  try {
    parse(obj, mtl, options);
  } catch (const host::Error& error) {
    return error.what();
  }
  return "no error";
}

void check_message(const std::string& got, const std::string& start, const std::string& part) {
  CAPTURE(got);
  CHECK(got.substr(0, start.size()) == start);
  CHECK(got.find(part) != std::string::npos);
  CHECK(got.find('\n') == std::string::npos);
}

// Two plates that face each other: lines 1 to 11.
const std::string kPlates =
    "mtllib room.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "usemtl white\n"
    "f 1 2 3 4\n";
const std::string kLamp = "usemtl lamp\nf -4 -1 -2 -3\n";

}  // namespace

TEST_CASE("an OBJ becomes surfaces with the materials of its MTL") {
  const host::Scene scene = parse(kPlates + kLamp);
  REQUIRE(scene.patches.size() == 2);
  CHECK(scene.material_of(0).reflectance == Vec3(0.5, 0.6, 0.7));
  CHECK(scene.material_of(0).exitance == Vec3(0));
  CHECK(scene.material_of(1).exitance == Vec3(3, 2, 1));
  CHECK(scene.patches[1].moments.normal == Vec3(0, 0, -1));
  CHECK(scene.blockers.empty());
  CHECK(scene.convex);
  CHECK_FALSE(scene.closed);
}

TEST_CASE("texture and normal indices, CRLF, blanks and names with spaces are read") {
  const host::Scene scene = parse(
      "mtllib room.mtl\r\nv 0 0 0\r\nv\t1 0 0\r\nv 1 1 0\r\nv +0 1e0 0\r\nvt 0 0\r\nvn 0 0 1\r\n"
      "usemtl my lamp\r\nf 1/1/1 2/1/1  3/1/1 4/1/1 \r\nf 4//1 3//1 2//1 1//1\r\n",
      "newmtl my lamp\r\n\tKd 0.5 0.5 0.5\r\n\tKe 1 1 1\r\n");
  CHECK(scene.patches.size() == 2);
  CHECK(scene.material_of(0).name == "my lamp");
}

TEST_CASE("a byte-order mark, comments behind statements and continued lines are read") {
  const std::string mark = "\xEF\xBB\xBF";
  const std::string obj =
      mark + "mtllib room.mtl # materials\nv 0 0 0 # corner\nv 1 \\\n 0 0\nv 1 1 0\nv 0 1 0\n" +
      "# a comment ends here \\\nusemtl my lamp#1\t# not the name\nf 1 2 \\\r\n 3 \\\r\n4 # "
      "floor\r\n" +
      "f 4 3 2 1";
  const std::string mtl = mark + "newmtl my lamp#1 # name\nKd .5 \\\n .5 .5 # grey\nKe 1 1 1#1\n";
  check_message(message(obj, mtl), "room.mtl:4: ", "'1#1'");
  const host::Scene scene = parse(obj, mtl.substr(0, mtl.size() - 3));
  CHECK(scene.patches.size() == 2);
  CHECK(scene.material_of(0).name == "my lamp#1");
  CHECK(scene.material_of(0).exitance == Vec3(1));
  // Statements keep the line on which they begin, whatever they take in.
  check_message(message(obj + "\nf 1 2 9 # no such\n", mtl.substr(0, mtl.size() - 3)),
                "room.obj:13: ", "vertex 9");
  CHECK(message(obj + " \\", mtl.substr(0, mtl.size() - 3)) == "no error");
}

TEST_CASE("every bad OBJ and MTL gets one sentence with file and line") {
  const std::string bad_vertex =
      "mtllib room.mtl\nv 0 0 0\nv nan 0 0\nv 0 1 0\nusemtl lamp\nf 1 2 3\n";
  check_message(message(bad_vertex), "room.obj:3: ", "'nan' is not a finite number");
  check_message(message("v 0 0\n"), "room.obj:1: ", "three numbers");
  check_message(message("v 0 0 1e999\n"), "room.obj:1: ", "'1e999'");
  check_message(message("v 0 0 0 \nv x 0 0\n"), "room.obj:2: ", "'x'");
  check_message(message("\x7f"
                        "ELF\n"),
                "room.obj:1: ", "is it an OBJ");
  check_message(message("v 0 0 0\n"), "room.obj:1: ", "no face");
  check_message(message(""), "room.obj:1: ", "no vertex");
  check_message(message(kPlates + "f 1 2\n"), "room.obj:12: ", "3 vertices");
  check_message(message(kPlates + kLamp + "f 1 2 9 4\n"),
                "room.obj:14: ", "vertex 9, but there are 8");
  check_message(message(kPlates + kLamp + "f 1 2 -9\n"),
                "room.obj:14: ", "vertex 0, but there are 8");
  check_message(message(kPlates + kLamp + "f 1 2 x\n"), "room.obj:14: ", "vertex");
  check_message(message(kPlates + kLamp + "f 1 2 0\n"), "room.obj:14: ", "vertex");
  check_message(message(kPlates + kLamp + "v 2 0 0\nv 3 0 0\nf 1 9 10\n"),
                "room.obj:16: ", "zero area");
  check_message(message(kPlates + kLamp + "f 1 2 2 3\n"), "room.obj:14: ", "equal vertices");
  check_message(message(kPlates + kLamp + "f 1 3 2 4\n"), "room.obj:14: ", "cross");
  check_message(message(kPlates + kLamp + "f 1 2 3 8\n"), "room.obj:14: ", "not planar");
  check_message(message("mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                "room.obj:5: ", "without material");
  check_message(message(kPlates + "usemtl green\nf 1 2 3\n"), "room.obj:12: ", "'green'");
  check_message(message("mtllib other.mtl\n" + kPlates), "room.obj:1: ", "other.mtl");
  check_message(message(kPlates), "room.obj:11: ", "one patch");
  check_message(message(kPlates, kMaterials, {3, 0}), "room.obj:11: ", "no light");
  check_message(message(kPlates + "usemtl without\nf 4 3 2 1\n"), "room.mtl:6: ", "no Kd");
  check_message(message(kPlates + "usemtl bright\nf 4 3 2 1\n"), "room.mtl:9: ", "1.5");
  check_message(message(kPlates + "usemtl odd\nf 4 3 2 1\n"), "room.mtl:11: ", "-0.1");
  check_message(message(kPlates + "usemtl hole\nf 4 3 2 1\n"), "room.mtl:14: ", "emits -1");
  check_message(message(kPlates, "Kd 1 1 1\n"), "room.mtl:1: ", "before the first newmtl");
  check_message(message(kPlates, "newmtl a\nKd 1 nan 1\n"), "room.mtl:2: ", "'nan'");
  check_message(message(kPlates, "newmtl a\nKd 0.5\n"), "room.mtl:2: ", "three numbers");
  check_message(message(kPlates, "newmtl a\nnewmtl a\n"), "room.mtl:2: ", "line 1");
  check_message(message(kPlates + kLamp + "# grid 300 2\n"), "room.obj:14: ", "1 to 255");
  check_message(message(kPlates + kLamp + "# camera eye 0 0 1 target 0 0\n"),
                "room.obj:14: ", "camera");
  check_message(message(kPlates + kLamp, kMaterials, {200, 0}), "room.obj:13: ", "65535");
  check_message(message(kPlates + kLamp, kMaterials, {0, 1e-9}), "room.obj:11: ", "65535");
  check_message(message(kPlates + kLamp, kMaterials, {2, 1}), "", "exclude each other");
  check_message(message(kPlates + kLamp, kMaterials, {-2, 0}), "", "not -2");
  check_message(message(kPlates + kLamp, kMaterials, {0, -1}), "", "not -1");
}

TEST_CASE("mtllib may name a file twice, or several; what no face uses need not be there") {
  const std::string faces =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl nothere\nusemtl lamp\nf 1 2 3 4\n"
      "usemtl white\nf 4 3 2 1\n";
  CHECK(parse("mtllib room.mtl\n" + faces + "mtllib room.mtl\n").patches.size() == 2);
  const auto read = [](const std::string& name) -> std::string {
    if (name == "a.mtl") return "newmtl lamp\nKd 0 0 0\nKe 1 1 1\n";
    if (name == "b.mtl") return "newmtl white\nKd 0.5 0.5 0.5\n";
    throw host::Error("cannot read " + name);
  };
  CHECK(host::parse_obj("mtllib a.mtl b.mtl\n" + faces, "x.obj", {}, read).patches.size() == 2);
  CHECK_THROWS_WITH_AS(host::parse_obj("mtllib a.mtl c.mtl\n" + faces, "x.obj", {}, read),
                       doctest::Contains("c.mtl"), host::Error);
}

TEST_CASE("files are read relative to the OBJ, and a missing one is named") {
  const std::string folder = std::string(URAD_SCRATCH_DIR) + "/";
  std::ofstream(folder + "scene_obj_test.mtl") << kMaterials;
  std::string text = kPlates + kLamp;
  text.replace(text.find("room.mtl"), 8, "scene_obj_test.mtl");
  std::ofstream(folder + "scene_obj_test.obj") << text;
  CHECK(host::load_scene(folder + "scene_obj_test.obj").patches.size() == 2);
  CHECK(host::load_scene(folder + "scene_obj_test.obj", {4, 0}).patches.size() == 32);
  std::filesystem::remove(folder + "scene_obj_test.mtl");
  CHECK_THROWS_WITH_AS(host::load_scene(folder + "scene_obj_test.obj"),
                       doctest::Contains("scene_obj_test.mtl"), host::Error);
  std::filesystem::remove(folder + "scene_obj_test.obj");
  CHECK_THROWS_WITH_AS(host::load_scene(folder + "scene_obj_test.obj"),
                       doctest::Contains("scene_obj_test.obj"), host::Error);
  CHECK_THROWS_WITH_AS(host::load_scene("no_such_scene"), doctest::Contains("cornell, cube7"),
                       host::Error);
}

TEST_CASE("the comments of an OBJ place the camera and cut the faces after them") {
  const host::Scene scene =
      parse("# camera eye 1 2 3 target 0 0 0.5 up 0 0 1 fov 35 mirrored\n# grid of prose\n" +
            kPlates + "# grid 3 2\n" + kLamp);
  CHECK(scene.camera.eye == Vec3(1, 2, 3));
  CHECK(scene.camera.target == Vec3(0, 0, 0.5));
  CHECK(scene.camera.up == Vec3(0, 0, 1));
  CHECK(scene.camera.field_of_view == 35);
  CHECK(scene.camera.mirrored);
  REQUIRE(scene.surfaces.size() == 2);
  CHECK(scene.surfaces[0].patch_count == 1);
  CHECK(scene.surfaces[1].patch_count == 6);
  CHECK(parse("# grid 3\n" + kPlates + kLamp, kMaterials, {2, 0}).patches.size() ==
        8);  // the option wins
}
