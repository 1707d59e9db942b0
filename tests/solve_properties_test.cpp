// Physics of whole solves by the engine: furnace, energy, linearity, mirror symmetry bit for bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scene/builtin.hpp"
#include "solve/scene_solver.hpp"
#include "weights/cube7.h"
#include "weights/general.h"

namespace {

using host::Vec3;

const host::NetChoice kNets{[](const std::string& name) -> const urad_net* {
  return name == "cube7" ? &urad_cube7 : &urad_general;
}};

host::MethodRun solved(const host::Scene& scene, const std::string& method, double error) {
  host::SceneSolver solver(scene, 0, true, 64);
  host::SolveGoal goal;
  goal.error = error;
  return solver.run(host::parse_method(method), kNets, goal);
}

host::Scene cube_with(double reflectance, const Vec3& exitance) {
  host::Scene scene = host::load_scene("cube7");
  for (host::Material& material : scene.materials) {
    material.reflectance = Vec3(reflectance);
    material.exitance = exitance;
  }
  return scene;
}

/// The scene seen in a mirror, patch by patch in the same order; grids would change their order,
/// lists do not.
host::Scene mirrored(host::Scene scene) {
  for (host::ScenePatch& patch : scene.patches) {
    for (Vec3& x : patch.polygon.outer) x.x = -x.x;
    std::reverse(patch.polygon.outer.begin(), patch.polygon.outer.end());
    patch.moments = host::moments(patch.polygon);
  }
  for (host::Material& material : scene.materials) {
    std::swap(material.reflectance.x, material.reflectance.z);
    std::swap(material.exitance.x, material.exitance.z);
  }
  return scene;
}

host::Scene as_lists(host::Scene scene) {
  for (host::Surface& surface : scene.surfaces) surface.grid.reset();
  return scene;
}

}  // namespace

TEST_CASE("white furnace: B = E / (1 - rho) at every patch, by network and by hemicube") {
  for (const double rho : {0.0, 0.5, 0.9}) {
    for (const char* method : {"net:cube7", "hemicube:32"}) {
      CAPTURE(rho);
      CAPTURE(method);
      const host::MethodRun run = solved(cube_with(rho, Vec3(1, 0.5, 0.25)), method, 1e-5);
      REQUIRE(run.solution.status == URAD_OK);
      // A hemicube's rows sum to 1, but its columns, into which light is shot, do so only about.
      const double bound = rho == 0 ? 1e-6 : method[0] == 'n' ? 2e-4 : 0.06 * rho / (1 - rho);
      for (const Vec3& b : run.solution.radiosity) CHECK(std::fabs(b.x * (1 - rho) - 1) <= bound);
    }
  }
}

TEST_CASE("the ledger is exact, and nothing escapes a closed scene") {
  const host::MethodRun closed = solved(host::load_scene("cube7"), "net:cube7", 1e-3);
  CHECK(closed.solution.ledger_exact);
  const host::MethodRun open = solved(host::load_scene("cornell"), "hybrid:32", 1e-3);
  CHECK(open.solution.ledger_exact);
  for (int c = 0; c < 3; ++c) {
    CHECK(closed.solution.ledger.escaped[c] == 0);
    CHECK(open.solution.ledger.escaped[c] > 0);
    for (const host::MethodRun* run : {&closed, &open}) {
      const urad_ledger& l = run->solution.ledger;
      CHECK(l.emitted[c] == l.absorbed[c] + l.unshot[c] + l.escaped[c]);
    }
  }
}

TEST_CASE("light is linear in the lamp") {
  host::Scene scene = host::load_scene("cube7");
  const host::MethodRun one = solved(scene, "net:cube7", 1e-5);
  for (host::Material& material : scene.materials) material.exitance *= 3.0;
  const host::MethodRun three = solved(scene, "net:cube7", 1e-5);
  for (std::size_t k = 0; k < scene.patches.size(); ++k) {
    for (int c = 0; c < 3; ++c) {
      CHECK(three.solution.radiosity[k][c] ==
            doctest::Approx(3 * one.solution.radiosity[k][c]).epsilon(2e-4));
    }
  }
}

TEST_CASE("a mirrored scene with red and blue swapped has mirrored light, bit for bit") {
  const host::Scene scene = as_lists(host::load_scene("cube7"));
  const host::MethodRun here = solved(scene, "net:cube7", 1e-3),
                        there = solved(mirrored(scene), "net:cube7", 1e-3);
  CHECK(here.rows.f_uq32 == there.rows.f_uq32);
  REQUIRE(here.solution.raw.size() == there.solution.raw.size());
  for (std::size_t k = 0; k < here.solution.raw.size(); k += 3) {
    CHECK(here.solution.raw[k] == there.solution.raw[k + 2]);
    CHECK(here.solution.raw[k + 1] == there.solution.raw[k + 1]);
    CHECK(here.solution.raw[k + 2] == there.solution.raw[k]);
  }
}

TEST_CASE(
    "the cube by its network: radiosity within 0.3 % of exact, and 1 % by hemicube and near "
    "network") {
  const host::Scene scene = host::load_scene("cube7");
  CHECK(solved(scene, "net:cube7", 1e-4).rms <= 0.003);
  host::SceneSolver solver(scene, 0, true);
  const host::NetChoice cube{kNets.shipped, &urad_cube7};
  host::SolveGoal goal;
  goal.error = 1e-4;
  CHECK(solver.run(host::parse_method("hybrid:32"), cube, goal).rms <= 0.01);
}

TEST_CASE("the Cornell box by hybrid: within 3 % of exact factors with traced visibility") {
  CHECK(solved(host::load_scene("cornell"), "hybrid:64", 1e-4).rms <= 0.03);
}

TEST_CASE("walls of a single patch keep their size: the unit cube's two factors") {
  host::MeshOptions whole;
  whole.subdivide = 1;
  const host::Scene scene = host::load_scene("cube7", whole);
  REQUIRE(scene.patches.size() == 6);
  const host::EngineRows f = host::engine_rows(host::FixedScene(scene),
                                               host::parse_method("fixed-lambert:3"), kNets, {}, 0);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      const double facing =
          glm::dot(scene.patches[i].moments.normal, scene.patches[j].moments.normal);
      const double exact = i == j ? 0 : facing < -0.5 ? 0.199824895698387 : 0.200043776075403;
      CHECK(std::fabs(f(i, j) - exact) <= 1e-4);
    }
  }
}

TEST_CASE("a lamp that holds all the light of a scene fits the engine's powers") {
  host::MeshOptions whole;
  whole.subdivide = 1;
  for (const double rho : {0.0, 0.5, 0.9}) {
    host::Scene scene = host::load_scene("cube7", whole);
    for (host::Material& material : scene.materials) {
      if (material.exitance == Vec3(0)) material.reflectance = Vec3(rho);
    }
    CHECK(solved(scene, "net", 1e-3).solution.status == URAD_OK);
  }
}
