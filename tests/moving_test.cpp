// Objects of scenes that move, by the engine's own factors: as from the start, in fewer shots.
#include "solve/moving.hpp"

#include <doctest/doctest.h>

#include "scene/builtin.hpp"
#include "solve/fixed_solve.hpp"
#include "urad/radiosity.hpp"
#include "weights/general.h"

namespace {

using host::Moving;
using host::Vec3;

const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_general; }};
const host::EngineOptions kOptions{.rays = 8};

Moving started(const host::Scene& scene) {
  return Moving(scene, host::parse_method("net"), kNets, kOptions, true);
}

int shots_to(Moving* light, const std::vector<Vec3>& truth, double error) {
  int shots = 0;
  while (host::relative_rms(light->scene(), light->radiosity(), truth) > error) {
    REQUIRE(shots++ < 3000);
    REQUIRE(light->step(1) == 1);
  }
  return shots;
}

}  // namespace

TEST_CASE("an object of a scene moves as far as it can, and back again") {
  for (const char* name : {"cornell", "louvre"}) {
    const host::Scene scene = host::load_scene(name, {.subdivide = 3});
    const std::vector<int> object = host::smallest_object(scene);
    const host::Motion there{glm::dmat3(1), host::free_way(scene, object, scene.camera.up)};
    REQUIRE(there.by != Vec3(0));
    Moving light = started(scene), truth = started(host::moved_scene(scene, object, there)),
           scratch = started(truth.scene());
    light.step(2000);
    truth.step(2000);
    const std::vector<Vec3> first = light.radiosity();
    const int all = shots_to(&scratch, truth.radiosity(), 0.01);
    light.move(object, there);
    const double before = host::relative_rms(light.scene(), light.radiosity(), truth.radiosity());
    const int shots = shots_to(&light, truth.radiosity(), 0.01);
    const urad_move& last = light.last();
    MESSAGE(name << ": " << object.size() << " surfaces, " << last.made << " of "
                 << last.made + last.kept << " pairs, " << shots << " shots (" << all
                 << " from the start), error before " << before);
    CHECK(before > 0.01);
    CHECK(4 * last.kept > last.made);
    CHECK(shots < all);
    CHECK(urad::radiosity_audit(light.state(), nullptr));

    light.move(object, {glm::dmat3(1), -there.by});
    light.step(2000);
    CHECK(host::relative_rms(scene, light.radiosity(), first) < 2e-3);
  }
}

TEST_CASE("a scene of walls alone has no object to move") {
  CHECK(host::smallest_object(host::load_scene("cube7", {.subdivide = 2})).empty());
}
