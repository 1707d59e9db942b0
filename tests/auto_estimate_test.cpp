// What auto says of its error where the grid of coordinates, moments and points fail: it may be off
// there, but not in silence. Hostile pairs, none of which served to fit a constant.
#include <doctest/doctest.h>

#include <cmath>

#include "accuracy/pair_families.hpp"
#include "form_factor/reference.hpp"
#include "geometry/validate.hpp"
#include "method/pair_method.hpp"
#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "stress/hostile_pairs.hpp"
#include "urad/auto.h"
#include "urad/cheapest.hpp"
#include "weights/general.h"

namespace {

constexpr std::uint64_t kSeed = 20261122;
constexpr int kCases = 150;  // of each family
constexpr double kLeastFactor = 1e-6;
constexpr std::uint32_t kAll_uq32 = 0xFFFFFFFF;

urad_auto_factor answer(const urad_scene& scene, std::uint16_t from, std::uint16_t to) {
  urad_auto_factor factor{};
  REQUIRE(urad_form_factor_auto(&scene, from, to, &urad_general, URAD_PERCENT, &factor, nullptr) ==
          URAD_OK);
  return factor;
}

urad_auto_factor answer(const host::PolygonPair& pair) {
  const host::FixedScene scene = host::FixedScene::of_polygons({pair.p, pair.q}, {});
  return answer(scene.pod(), 0, 1);
}

/// Unit squares face to face.
host::PolygonPair plates(double gap) {
  return {host::rectangle(1, 1), host::flipped(host::rectangle(1, 1, gap))};
}

}  // namespace

TEST_CASE("where auto is off by more than a tenth, it says a third of that at least") {
  const host::NetChoice nets{[](const std::string&) { return &urad_general; }};
  const host::FreePairMethod method = host::pair_method(host::parse_method("auto"), nets);
  int off = 0, cases = 0;
  double worst = 0;
  for (const host::HostileFamily& family : host::hostile_families())
    for (int k = 0; k < kCases; ++k) {
      host::Random random(kSeed, std::uint64_t(k));
      const host::PolygonPair pair = family.draw(random);
      if (host::validate(pair.p, pair.q) != host::PolygonStatus::ok) continue;
      const double exact = host::reference_form_factor(pair.p, pair.q);
      const host::PairResult result = method.run(pair.p, pair.q);
      if (exact < kLeastFactor || result.status != "ok") continue;
      const double error = std::fabs(result.estimate.f / exact - 1);
      INFO(family.name, " ", k, ": exact ", exact, " auto ", result.estimate.f, " says ",
           result.estimate.relative_error);
      CHECK(error <= std::max(0.1, 3 * result.estimate.relative_error));
      ++cases;
      off += error > 0.1;
      worst = std::max(worst, error);
    }
  MESSAGE(cases, " pairs, ", off, " off by more than a tenth, worst ", worst);
  CHECK(cases > 1000);
  CHECK(worst > 0.01);  // or these pairs are none to learn from
}

TEST_CASE("squares face to face, where all points of a sum see the same, are no better than said") {
  const host::NetChoice nets{[](const std::string&) { return &urad_general; }};
  for (const double wanted : {0.1, 0.05, 0.02, 0.01, 0.003}) {
    const auto method = host::pair_method({"auto", std::to_string(wanted)}, nets);
    for (int k = 0; k < 49; ++k) {
      const double gap = 0.01 * std::pow(1.1, k);  // up to 0.97
      const host::PolygonPair pair = plates(gap);
      const host::Estimate factor = method.run(pair.p, pair.q).estimate;
      const double error = std::fabs(factor.f / host::reference_form_factor(pair.p, pair.q) - 1);
      INFO("gap ", gap, ", wanted ", wanted, ", off by ", error, ", said ", factor.relative_error);
      CHECK(error <= 1.5 * std::max(wanted, factor.relative_error));
    }
  }
}

TEST_CASE("pairs nearer than the grid are out of range for methods of the engine, not dark") {
  const host::NetChoice nets{[](const std::string&) { return &urad_general; }};
  host::PolygonPair pair = plates(1e-9);
  for (const char* name : {"fixed-moment", "net", "auto", "fixed-lambert:2"}) {
    const auto method = host::pair_method(host::parse_method(name), nets);
    CHECK(method.run(pair.p, pair.q).status == "unsupported_range");
    CHECK(method.run(pair.p, plates(0).q).status == "ok");  // one plane
    CHECK(method.run(pair.p, plates(0).q).estimate.f == 0);
  }
}

TEST_CASE("a gap that the grid does not have leaves all of the factor open") {
  const urad_auto_factor none = answer(plates(1e-9));
  CHECK(none.f_uq32 == 0);
  CHECK(none.way == URAD_WAY_NONE);
  CHECK(none.error_uq32 == kAll_uq32);
}

TEST_CASE("a gap of a few units leaves open what a unit of it makes") {
  const double gap = 200 * 0x1p-29;  // of a box two units wide: 100 units of the scene
  host::PolygonPair pair = plates(gap);
  for (host::Vec3& x : pair.q.outer) x.x += 1 + 1e-3;  // beside each other: F goes with the square
  const urad_auto_factor factor = answer(pair);
  CHECK(factor.error_uq32 >= kAll_uq32 / 100);
}

TEST_CASE("what is behind, and what lies on the same wall, exchanges nothing for sure") {
  host::PolygonPair pair = plates(1);
  for (host::Vec3& x : pair.q.outer) x.z = -x.z;
  const urad_auto_factor behind = answer(pair);
  CHECK(behind.way == URAD_WAY_NONE);
  CHECK(behind.f_uq32 == 0);
  CHECK(behind.error_uq32 == 0);
  const host::FixedScene cube(host::load_scene("cube7"));
  const urad_auto_factor wall = answer(cube.pod(), 0, 1);
  CHECK(wall.way == URAD_WAY_NONE);
  CHECK(wall.error_uq32 == 0);
}

TEST_CASE("two crossed strips longer than they are apart are no case for moments") {
  host::PolygonPair pair{host::rectangle(10, 1e-5), host::flipped(host::rectangle(1e-5, 10, 0.01))};
  for (host::Vec3& x : pair.q.outer) x += host::Vec3(5, -5, 0);
  const urad_auto_factor factor = answer(pair);
  CHECK(factor.way > URAD_WAY_NETWORK);
  const double exact = host::reference_form_factor(pair.p, pair.q);
  CHECK(std::fabs(factor.f_uq32 * 0x1p-32 / exact - 1) <= factor.error_uq32 * 0x1p-32);
}

TEST_CASE("cells beside a narrow overlap are halved although no point of theirs sees it") {
  // Plates of which a hundredth lies over each other, a ten-thousandth apart.
  host::PolygonPair pair = plates(1e-4);
  for (host::Vec3& x : pair.q.outer) x += host::Vec3(0.99, 0.3, 0);
  const double exact = host::reference_form_factor(pair.p, pair.q);
  const urad_auto_factor factor = answer(pair);
  const double error = std::fabs(factor.f_uq32 * 0x1p-32 / exact - 1);
  MESSAGE("exact ", exact, " off by ", error, " says ", factor.error_uq32 * 0x1p-32);
  CHECK(factor.way == URAD_WAY_REFINED);
  CHECK(error <= 3 * factor.error_uq32 * 0x1p-32);
}
