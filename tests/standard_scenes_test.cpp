// The five standard scenes: what they are, and light in them against the kept exact solutions.
#include <doctest/doctest.h>

#include "base/csv.hpp"
#include "method/engine_source.hpp"
#include "scene/builtin.hpp"
#include "solve/fixed_solve.hpp"
#include "solve/pair_statistics.hpp"
#include "solve/repair.hpp"
#include "weights/general.h"

namespace {

using host::Vec3;

const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_general; }};
constexpr const char* kScenes[] = {"cube7", "cornell", "room", "louvre", "gallery"};

/// tests/vectors/exact_SCENE.csv, written by: urad solve SCENE --method exact --rays 16384.
std::vector<Vec3> kept_solution(const std::string& name, const host::Scene& scene) {
  const host::CsvTable table =
      host::read_csv(std::string(URAD_SOURCE_DIR) + "/tests/vectors/exact_" + name + ".csv");
  std::vector<Vec3> radiosity(scene.patches.size());
  REQUIRE(table.rows.size() == radiosity.size());
  for (std::size_t row = 0; row < radiosity.size(); ++row) {
    for (int c = 0; c < 3; ++c)
      radiosity[scene.patch_of_row(row)][c] = std::stod(table.rows[row].cells[std::size_t(c) + 1]);
  }
  return radiosity;
}

/// B by the engine, solved to the end: all error is the factors'.
std::vector<Vec3> engine_radiosity(const host::Scene& scene, const std::string& method,
                                   const host::EngineOptions& options) {
  host::FixedScene fixed(scene);
  const host::MethodSpec spec = host::parse_method(method);
  host::EngineRows rows = host::engine_rows(fixed, spec, kNets, options, 0);
  if (scene.closed) {
    Eigen::MatrixXd f(rows.patches, rows.patches);
    for (std::size_t i = 0; i < rows.patches; ++i) {
      for (std::size_t j = 0; j < rows.patches; ++j)
        f(Eigen::Index(i), Eigen::Index(j)) = rows(i, j);
    }
    fixed.set_scale(host::symmetric_scale(scene, f));
    rows = host::engine_rows(fixed, spec, kNets, options, 0);
  }
  host::SolveGoal goal;
  goal.shots = 8 * int(rows.patches);
  const host::FixedSolution solution =
      host::fixed_solve(scene, fixed, rows, std::vector<Vec3>(rows.patches, Vec3(0)), goal);
  REQUIRE(solution.status == URAD_OK);
  CHECK(solution.ledger_exact);
  return solution.radiosity;
}

}  // namespace

TEST_CASE("patches, walls and how many pairs see each other") {
  struct Facts {
    const char* name;
    std::size_t patches, blockers;
    bool convex, closed;
    double facing, seen_or_half;  // shares; half: a pair seen in part counts as one half
  };
  for (const Facts& facts : {Facts{"cube7", 294, 0, true, true, 0.836, 1},
                             Facts{"cornell", 354, 11, false, false, 0.72, 0.69},
                             Facts{"room", 238, 26, false, true, 0.625, 0.71},
                             Facts{"louvre", 290, 8, false, true, 0.675, 0.565},
                             Facts{"gallery", 228, 0, true, true, 0.819, 1}}) {
    CAPTURE(facts.name);
    const host::Scene scene = host::load_scene(facts.name);
    CHECK(scene.patches.size() == facts.patches);
    CHECK(scene.blockers.size() == facts.blockers);
    CHECK(scene.convex == facts.convex);
    CHECK(scene.closed == facts.closed);
    const host::PairStatistics pairs = host::pair_statistics(scene, 0, 16);
    CHECK(pairs.all == facts.patches * (facts.patches - 1) / 2);
    CHECK(pairs.facing_share() == doctest::Approx(facts.facing).epsilon(0.01));
    const double half = 0.5 * double(pairs.partly);
    CHECK((double(pairs.seen) + half) / double(pairs.facing) ==
          doctest::Approx(facts.seen_or_half).epsilon(0.02));
  }
}

TEST_CASE(
    "radiosity against the kept exact solutions: rays, also adaptive, to 2 %, hybrid:64 to 3 % "
    "rms") {
  for (const char* name : kScenes) {
    CAPTURE(name);
    const host::Scene scene = host::load_scene(name);
    const std::vector<Vec3> exact = kept_solution(name, scene);
    const double by_rays =
        host::relative_rms(scene, engine_radiosity(scene, "net", {.rays = 16}), exact);
    // As many as a pair is worth, and patches cut where rays disagree.
    const host::EngineOptions worth{.rays = 64, .ray_error = 1.0 / 64, .cuts = 2};
    const double adaptive = host::relative_rms(scene, engine_radiosity(scene, "net", worth), exact);
    const double by_hybrid =
        host::relative_rms(scene, engine_radiosity(scene, "hybrid:64", {.rays = 16}), exact);
    MESSAGE(std::string(name) << ": rays " << 100 * by_rays << " % rms, adaptive " << 100 * adaptive
                              << " %, hybrid:64 " << 100 * by_hybrid << " %");
    CHECK(by_rays < 0.02);
    CHECK(adaptive < 0.02);
    CHECK(by_hybrid < 0.03);
  }
}
