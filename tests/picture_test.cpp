#include "report/picture.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "base/error.hpp"
#include "hand_made_scene.hpp"
#include "report/camera.hpp"

// Decodes what the library under test encoded.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace {

using host::Channel;
using host::Image;
using host::Scene;
using host::Shading;
using host::Vec3;
using host::View;

constexpr host::PictureOptions kSmall{61, 61, 2, 0};
const Vec3 kMagenta(1, 0, 1), kGreen(0, 1, 0);

Vec3 pixel(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.pixels[std::size_t(image.channels * (y * image.width + x))];
  return {double(p[0]), double(p[1]), double(p[2])};
}

/// Each wall in a colour of its own: its reflectance, and magenta for the lamp.
std::vector<Vec3> wall_colours(const Scene& scene) {
  std::vector<Vec3> b;
  for (std::size_t k = 0; k < scene.patches.size(); ++k)
    b.push_back(test::wall_of(scene, k) == "lamp" ? kMagenta : scene.material_of(k).reflectance);
  return b;
}

bool shows(const Image& image, const Vec3& colour) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (pixel(image, x, y) == colour) return true;
  return false;
}

TEST_CASE("from behind the luminous wall one looks into the cube, red to the left") {
  const Scene scene = test::cube(7);
  const View view(scene, kSmall);
  CHECK(view.outside());
  for (const Shading shading : {Shading::kFlat, Shading::kSmooth}) {
    const Image image = view.picture(wall_colours(scene), shading, 0.75);
    const auto srgb = [](const Vec3& c) {
      return Vec3(host::srgb_byte(c.x / 0.75), host::srgb_byte(c.y / 0.75),
                  host::srgb_byte(c.z / 0.75));
    };
    CHECK(pixel(image, 6, 30) == srgb({0.75, 0.1, 0.1}));
    CHECK(pixel(image, 54, 30) == srgb({0.1, 0.1, 0.75}));
    CHECK(pixel(image, 30, 30) == Vec3(255));
    CHECK_FALSE(shows(image, srgb(kMagenta)));
  }
}

TEST_CASE("a mirrored camera exchanges left and right") {
  Scene scene = test::cube(2);
  scene.camera.mirrored = true;
  const Image image = View(scene, kSmall).picture(wall_colours(scene), Shading::kFlat, 0.75);
  CHECK(pixel(image, 54, 30).x > pixel(image, 54, 30).z);
  CHECK(pixel(image, 6, 30).x < pixel(image, 6, 30).z);
}

TEST_CASE("a mirrored solution gives the mirrored picture") {
  const Scene scene = test::cube(5);
  std::vector<Vec3> b(scene.patches.size()), mirrored(b.size());
  const auto value = [](const Vec3& x) { return Vec3(x.x, 0.5, 1 - x.x) * (0.3 + 0.5 * x.y); };
  for (std::size_t k = 0; k < b.size(); ++k) {
    const Vec3 c = scene.patches[k].moments.centroid;
    b[k] = value(c);
    mirrored[k] = value({1 - c.x, c.y, c.z});
  }
  const View view(scene, kSmall);
  const Image left = view.picture(b, Shading::kSmooth, 1),
              right = view.picture(mirrored, Shading::kSmooth, 1);
  double worst = 0;  // single precision rays: silhouettes may fall to either side
  int silhouettes = 0;
  for (int y = 0; y < left.height; ++y)
    for (int x = 0; x < left.width; ++x) {
      const Vec3 d = glm::abs(pixel(left, x, y) - pixel(right, left.width - 1 - x, y));
      const double size = std::max({d.x, d.y, d.z});
      if (size > 3)
        ++silhouettes;
      else
        worst = std::max(worst, size);
    }
  CHECK(worst <= 3);
  CHECK(silhouettes < left.width * left.height / 25);
}

/// The patch that the cube's camera sees at (x, y) of the picture, both 0 .. 1, by closed form; -1:
/// background.
int seen_patch(const Scene& scene, double x, double y) {
  const double half = std::tan(23 * 0.0174532925199433);
  const Vec3 d((1 - 2 * x) * half, (1 - 2 * y) * half,
               1);  // from (0.5, 0.5, -1.25); +x is to the left
  if (1.25 * std::max(std::abs(d.x), std::abs(d.y)) > 0.5) return -1;
  const double t = std::min({2.25, 0.5 / std::abs(d.x), 0.5 / std::abs(d.y)});
  const Vec3 hit = Vec3(0.5, 0.5, -1.25) + t * d;
  int best = 0;
  for (int k = 1; k < int(scene.patches.size()); ++k)
    if (glm::distance(scene.patches[std::size_t(k)].moments.centroid, hit) <
        glm::distance(scene.patches[std::size_t(best)].moments.centroid, hit))
      best = k;
  return best;
}

TEST_CASE("flat pixels are the patch that an analytic ray meets") {
  const Scene scene = test::cube(7);
  std::vector<Vec3> b(scene.patches.size());
  std::mt19937 random(1996);
  for (Vec3& value : b) value = Vec3(double(random() % 256)) / 255.0;
  const host::PictureOptions options{101, 101, 2, 0};
  const Image image = View(scene, options).picture(b, Shading::kFlat, 1);
  int compared = 0;
  for (int y = 0; y < 101; y += 3)
    for (int x = 0; x < 101; x += 3) {
      const int patch = seen_patch(scene, (x + 0.5) / 101, (y + 0.5) / 101);
      bool whole = patch >= 0;  // a pixel that sees one patch only
      for (const double dx : {0.0, 1.0})
        for (const double dy : {0.0, 1.0})
          whole = whole && seen_patch(scene, (x + dx) / 101, (y + dy) / 101) == patch;
      if (!whole) continue;
      CAPTURE(x);
      CAPTURE(y);
      CHECK(pixel(image, x, y).x == double(host::srgb_byte(b[std::size_t(patch)].x)));
      ++compared;
    }
  CHECK(compared > 300);
}

TEST_CASE("inside, the back of a patch is opaque and black; outside, blockers are") {
  Scene scene = test::cube(3);
  scene.camera = {{0.5, 0.5, 0.9}, {0.5, 0.5, 0}, {0, 1, 0}, 60};
  const View towards_lamp(scene, kSmall);
  CHECK_FALSE(towards_lamp.outside());
  CHECK(pixel(towards_lamp.picture(wall_colours(scene), Shading::kSmooth, 1), 30, 30) ==
        Vec3(255, 0, 255));

  // A plate before the lamp that shows the camera its back.
  test::add_wall(&scene, "plate", {0.4, 0.4, 0.5}, {0, 0.2, 0}, {0.2, 0, 0}, 1, Vec3(0.5), Vec3(0));
  std::vector<Vec3> b = wall_colours(scene);
  b.back() = kGreen;
  const Image back = View(scene, kSmall).picture(b, Shading::kSmooth, 1);
  CHECK(pixel(back, 30, 30) == Vec3(0));
  CHECK_FALSE(shows(back, {0, 255, 0}));

  Scene outside = test::cube(3);
  outside.blockers.push_back(
      {{{{0.4, 0.4, 0.5}, {0.4, 0.6, 0.5}, {0.6, 0.6, 0.5}, {0.6, 0.4, 0.5}}, {}}, -1});
  CHECK(pixel(View(outside, kSmall).picture(wall_colours(outside), Shading::kFlat, 1), 30, 30) ==
        Vec3(0));
}

TEST_CASE(
    "differences: 128 is none, the scale is white and black, linear in between, channels apart") {
  const Scene scene = test::cube(2);
  const View view(scene, kSmall);
  const std::vector<Vec3> exact(scene.patches.size(), Vec3(0.5));
  const auto differ = [&](const Vec3& by, Channel channel) {
    std::vector<Vec3> b = exact;
    for (Vec3& value : b) value += by;
    return view.difference(b, exact, Shading::kSmooth, 0.25, channel);
  };
  for (const std::uint8_t value : differ(Vec3(0), Channel::kAll).pixels) REQUIRE(value == 128);
  const Image rgb = differ({0.25, -0.25, 0.125}, Channel::kAll);
  CHECK(pixel(rgb, 30, 30) == Vec3(255, 0, 192));
  CHECK(pixel(rgb, 0, 0) == Vec3(128));  // background
  const Image blue = differ({0.25, -0.25, 0.125}, Channel::kBlue);
  CHECK(blue.channels == 1);
  CHECK(blue.pixels[30 * 61 + 30] == 192);
  CHECK(pixel(differ({9, -9, 0}, Channel::kAll), 30, 30) == Vec3(255, 0, 128));
}

TEST_CASE(
    "the scale of a difference is 1, 2 or 5 times a power of ten and holds 99 % of the pixels") {
  const Scene scene = test::cube(2);
  const View view(scene, kSmall);
  const std::vector<Vec3> exact(scene.patches.size(), Vec3(0.5));
  const auto scale = [&](double error) {
    std::vector<Vec3> b = exact;
    for (Vec3& value : b) value.y -= error;
    return view.difference_scale(b, exact, Shading::kFlat, 2.0) / 2.0;
  };
  CHECK(scale(0) == 0);
  CHECK(scale(0.03 * 2) == doctest::Approx(0.05));
  CHECK(scale(0.0011 * 2) == doctest::Approx(0.002));
  CHECK(scale(0.51 * 2) == doctest::Approx(1));
}

TEST_CASE("white is the 99th percentile of what does not emit") {
  const Scene scene = test::cube(10);  // 500 patches that do not emit, 100 that do
  std::vector<Vec3> b(scene.patches.size());
  for (std::size_t k = 0; k < b.size(); ++k) b[k] = {0, double(k) + 1, 0};
  CHECK(host::white_level(scene, b) == 495);
  CHECK(host::white_level(scene, std::vector<Vec3>(b.size(), Vec3(0))) == 1);
  Scene lamp;
  test::add_wall(&lamp, "lamp", Vec3(0), {1, 0, 0}, {0, 1, 0}, 1, Vec3(0), Vec3(3));
  CHECK(host::white_level(lamp, {Vec3(3)}) == 3);
}

TEST_CASE("pictures depend neither on threads nor on the unit of length") {
  Scene scene = test::cube(7);
  const std::vector<Vec3> b = wall_colours(scene);
  const Image one = View(scene, {61, 61, 3, 1}).picture(b, Shading::kSmooth, 1);
  CHECK(one.pixels == View(scene, {61, 61, 3, 3}).picture(b, Shading::kSmooth, 1).pixels);
  for (const double scale : {1e-12, 1e12}) {
    Scene scaled = scene;
    for (host::ScenePatch& patch : scaled.patches) {
      for (Vec3& x : patch.polygon.outer) x *= scale;
      patch.moments = host::moments(patch.polygon);
    }
    for (host::Surface& surface : scaled.surfaces) {
      surface.grid->origin *= scale;
      surface.grid->step_u *= scale;
      surface.grid->step_v *= scale;
    }
    scaled.camera.eye *= scale;
    scaled.camera.target *= scale;
    const Image image = View(scaled, {61, 61, 3, 1}).picture(b, Shading::kSmooth, 1);
    std::size_t differing = 0;
    for (std::size_t k = 0; k < image.pixels.size(); ++k)
      differing += std::abs(int(image.pixels[k]) - int(one.pixels[k])) > 1;
    CAPTURE(scale);
    CHECK(differing < image.pixels.size() / 100);
  }
}

TEST_CASE("a scene without a camera is framed from outside") {
  Scene scene = test::cube(2);
  scene.camera = {};
  const host::Camera camera = host::camera_of(scene);
  CHECK(glm::distance(camera.target, Vec3(0.5)) < 1e-12);
  const Image image = View(scene, kSmall).picture(wall_colours(scene), Shading::kFlat, 1);
  CHECK(pixel(image, 0, 0) == pixel(image, 60, 60));  // background in the corners
  CHECK_FALSE(pixel(image, 30, 30) == pixel(image, 0, 0));
}

TEST_CASE("a PNG decodes to the pixels it was made of") {
  const Scene scene = test::cube(2);
  const View view(scene, {37, 23, 2, 1});
  const std::vector<Vec3> b = wall_colours(scene), none(b.size(), Vec3(0));
  for (const Image& image : {view.picture(b, Shading::kSmooth, 1),
                             view.difference(b, none, Shading::kFlat, 1, Channel::kRed)}) {
    const std::string file = host::png(image);
    int width = 0, height = 0, channels = 0;
    unsigned char* data = stbi_load_from_memory(reinterpret_cast<const unsigned char*>(file.data()),
                                                int(file.size()), &width, &height, &channels, 0);
    REQUIRE(data != nullptr);
    CHECK(width == 37);
    CHECK(height == 23);
    CHECK(channels == image.channels);
    CHECK(std::equal(image.pixels.begin(), image.pixels.end(), data));
    stbi_image_free(data);
  }
}

TEST_CASE("what cannot be drawn is refused") {
  const Scene scene = test::cube(1);
  CHECK_THROWS_AS(View(scene, {0, 480, 3, 1}), host::Error);
  CHECK_THROWS_AS(View(scene, {480, 20000, 3, 1}), host::Error);
  CHECK_THROWS_AS(View(scene, {480, 480, 1, 1}), host::Error);
  CHECK_THROWS_AS(View(Scene{}, kSmall), host::Error);
  const View view(scene, kSmall);
  CHECK_THROWS_AS(view.picture({}, Shading::kFlat, 1), host::Error);
}

}  // namespace
