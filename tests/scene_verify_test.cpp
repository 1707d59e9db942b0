// A scene in flash that has lost a bit is found, whichever it is.
#include <doctest/doctest.h>

#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "solve/exported_visibility.hpp"
#include "stress/open_scene.hpp"
#include "urad/urad.h"

namespace {

/// Bits of the scene that can be lost without notice.
std::size_t missed_bits(const host::FixedScene& fixed) {
  host::OpenScene scene(fixed.pod());
  std::uint32_t crc32[2];
  REQUIRE(urad_scene_crc32(&scene.pod(), crc32) == URAD_OK);
  REQUIRE(urad_scene_verify(&scene.pod(), crc32) == URAD_OK);
  std::size_t missed = 0;
  for (std::size_t bit = 0; bit < scene.bits(); ++bit) {
    scene.flip(bit);
    missed += urad_scene_verify(&scene.pod(), crc32) == URAD_OK;
    scene.flip(bit);
  }
  CHECK(scene.bits() > 2000);
  return missed;
}

}  // namespace

TEST_CASE("every single-bit fault of a scene is found: grids, polygon lists, blockers, repair") {
  CHECK(missed_bits(host::FixedScene(host::load_scene("cube7", {1, 0}))) == 0);
  host::FixedScene plates = host::FixedScene::of_polygons(
      {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}}, {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}}, {}}},
      {{{{0.2, 0.2, 0.5}, {0.8, 0.2, 0.5}, {0.5, 0.8, 0.5}}, {}}});
  plates.set_scale({1, 0.5});
  CHECK(missed_bits(plates) == 0);
  const host::Scene louvre = host::load_scene("louvre", {1, 0});
  host::FixedScene sighted(louvre);
  CHECK(missed_bits(sighted) == 0);
  sighted.set_visibility(
      host::make_visibility(louvre, sighted, host::VisibilityCode::fractions, 16, 0));
  CHECK(missed_bits(sighted) == 0);
}

TEST_CASE("null is refused, and so is another scene's CRC") {
  const host::FixedScene cube(host::load_scene("cube7", {1, 0}));
  const host::FixedScene finer(host::load_scene("cube7", {2, 0}));
  std::uint32_t crc32[2] = {7, 7};
  CHECK(urad_scene_crc32(nullptr, crc32) == URAD_BAD_ARGUMENT);
  CHECK(urad_scene_crc32(&cube.pod(), nullptr) == URAD_BAD_ARGUMENT);
  CHECK(crc32[0] == 7);
  CHECK(urad_scene_verify(nullptr, crc32) == URAD_BAD_SCENE);
  CHECK(urad_scene_verify(&cube.pod(), nullptr) == URAD_BAD_ARGUMENT);
  REQUIRE(urad_scene_crc32(&cube.pod(), crc32) == URAD_OK);
  CHECK(urad_scene_verify(&finer.pod(), crc32) == URAD_BAD_SCENE);
}
