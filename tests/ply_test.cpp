#include "report/ply.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "hand_made_scene.hpp"
#include "report/picture.hpp"

namespace {

using host::Scene;
using host::Vec3;

/// Reads little-endian values in turn. The machines that run this test are little-endian.
struct Reader {
  const std::string& bytes;
  std::size_t at;
  template <class Value>
  Value next() {
    Value value;
    REQUIRE(at + sizeof value <= bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof value);
    at += sizeof value;
    return value;
  }
  Vec3 vector() {
    const float x = next<float>(), y = next<float>(), z = next<float>();
    return {double(x), double(y), double(z)};
  }
};

/// A count in the header: "element NAME count".
std::size_t element(const std::string& file, const std::string& name) {
  const std::size_t at = file.find("element " + name + " ");
  REQUIRE(at != std::string::npos);
  return std::stoul(file.substr(at + name.size() + 9));
}

std::size_t end_of_header(const std::string& file) {
  const std::size_t at = file.find("end_header\n");
  REQUIRE(at != std::string::npos);
  return at + 11;
}

TEST_CASE("a PLY reads back as the mesh, its colours and its radiosities") {
  const Scene scene = test::cube(4);
  const host::CornerMesh mesh = host::merge_corners(scene);
  std::vector<Vec3> b;
  for (std::size_t k = 0; k < scene.patches.size(); ++k)
    b.push_back(Vec3(0.1, 0.2, 0.3) + 0.004 * double(k));
  const std::vector<Vec3> colour = host::smooth_colours(scene, mesh, b);
  const double white = 0.5;
  const std::string file = host::ply(scene, mesh, b, white);

  CHECK(file.starts_with("ply\nformat binary_little_endian 1.0\n"));
  REQUIRE(element(file, "vertex") == mesh.vertex.size());
  REQUIRE(element(file, "face") == mesh.facets.size());
  Reader in{file, end_of_header(file)};
  std::vector<Vec3> position;
  double worst = 0;
  for (std::size_t v = 0; v < mesh.vertex.size(); ++v) {
    position.push_back(in.vector());
    worst = std::max(worst, glm::distance(position[v], mesh.vertex[v]));
    for (int k = 0; k < 3; ++k)
      REQUIRE(in.next<std::uint8_t>() == host::srgb_byte(colour[v][k] / white));
    worst = std::max(worst, glm::distance(in.vector(), colour[v]));
  }
  CHECK(worst < 1e-6);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    REQUIRE(in.next<std::uint8_t>() == 4);
    Vec3 corner[4];
    for (Vec3& x : corner) x = position.at(in.next<std::uint32_t>());
    const auto patch = in.next<std::uint32_t>();
    REQUIRE(patch == f);
    const Vec3 normal = glm::cross(corner[1] - corner[0], corner[3] - corner[0]);
    REQUIRE(glm::dot(normal, scene.patches[patch].moments.normal) > 0);
  }
  CHECK(in.at == file.size());
}

TEST_CASE("patches that are not quads become triangles") {
  Scene scene;
  scene.materials.resize(1);
  host::Surface surface;
  surface.patch_count = 1;
  scene.surfaces.push_back(surface);
  const host::Polygon concave{{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},
                              {}};
  scene.patches.push_back({concave, host::moments(concave), 0});
  const std::string file = host::ply(scene, host::merge_corners(scene), {Vec3(1)}, 1);
  CHECK(element(file, "vertex") == 6);
  CHECK(element(file, "face") == 4);
  // 6 vertices of 27 bytes, 4 faces of 1 + 12 + 4.
  CHECK(file.size() == end_of_header(file) + 6 * 27 + 4 * 17);
}

}  // namespace
