// The tool behind docs/ACCURACY.md, and its bounds where nobody could have tuned for them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <random>

#include "accuracy/closed_form_checks.hpp"
#include "accuracy/method_table.hpp"
#include "accuracy/occluded_checks.hpp"
#include "accuracy/pair_families.hpp"
#include "accuracy/reference_checks.hpp"
#include "accuracy/scene_trials.hpp"
#include "base/file.hpp"
#include "form_factor/reference.hpp"
#include "network/evaluate.hpp"
#include "network/train_net.hpp"
#include "random_room.hpp"
#include "scene/builtin.hpp"
#include "weights/general.h"

namespace {

constexpr std::uint64_t kSeed = 19960501;
const double kFarRho = host::TrainRequest().far_rho;

host::TableMethod method(const char* text, const urad_net* net = nullptr) {
  return {text, host::parse_method(text), {{}, net}};
}

/// A room that nobody has seen, as a file and back.
host::Scene written_room(unsigned seed, double scale, int finer = 1) {
  std::mt19937 random(seed);
  const test::RandomRoom room = test::random_room(random, scale, finer);
  const std::string folder = fmt::format("{}/accuracy_{}_{}", URAD_SCRATCH_DIR, seed, finer);
  std::filesystem::create_directories(folder);
  host::write_file_atomically(folder + "/room.obj", room.obj);
  host::write_file_atomically(folder + "/room.mtl", room.mtl);
  return host::load_scene(folder + "/room.obj");
}

/// The patch of `coarse` that patch `k` of the same room cut finer x finer lies in.
int coarse_patch(const host::Scene& coarse, const host::Scene& fine, int finer, int k) {
  const int s = fine.patches[std::size_t(k)].surface;
  const host::Surface& from = fine.surfaces[std::size_t(s)];
  const host::Surface& to = coarse.surfaces[std::size_t(s)];
  const int u = (k - from.first_patch) % from.grid->count_u,
            v = (k - from.first_patch) / from.grid->count_u;
  return to.first_patch + v / finer * to.grid->count_u + u / finer;
}

/// Standard deviation of hemicube factors between patches of a room on different walls, each the
/// mean over finer x finer hemicubes.
double std_of_cut_hemicubes(host::SceneSolver& room, const host::Scene& fine, int finer,
                            int resolution) {
  const host::Scene& coarse = room.scene();
  const auto rows = host::engine_rows(host::FixedScene(fine),
                                      {"hemicube", std::to_string(resolution)}, {}, {}, 2);
  Eigen::MatrixXd error = -room.exact().form_factors;
  for (int i = 0; i < int(rows.patches); ++i)
    for (int j = 0; j < int(rows.patches); ++j)
      error(coarse_patch(coarse, fine, finer, i), coarse_patch(coarse, fine, finer, j)) +=
          rows(std::size_t(i), std::size_t(j)) / (finer * finer);
  double sum = 0, squares = 0;
  int pairs = 0;
  for (int i = 0; i < error.rows(); ++i)
    for (int j = 0; j < error.cols(); ++j) {
      if (coarse.patches[std::size_t(i)].surface == coarse.patches[std::size_t(j)].surface)
        continue;
      sum += error(i, j);
      squares += error(i, j) * error(i, j);
      ++pairs;
    }
  return std::sqrt(squares / pairs - sum * sum / pairs / pairs);
}

}  // namespace

TEST_CASE("every known value within its last printed digit") {
  const std::vector<host::KnownValue> values = host::known_values();
  CHECK(values.size() >= 50);
  for (const host::KnownValue& value : values) {
    INFO(value.name);
    CHECK(value.tolerance >= 1e-12);
    CHECK(value.tolerance <= 1e-7);
    CHECK(std::fabs(host::reference_form_factor(value.p, value.q) - value.f) <= value.tolerance);
  }
  const host::KnownCheck check = host::check_known_values(values);
  CHECK(check.cases == values.size());
  CHECK(check.of_bound <= 1);
}

TEST_CASE("a wrong known value, and one without a number, are noticed") {
  std::vector<host::KnownValue> values = host::known_values();
  values.resize(3);
  values[1].f += 3e-12;
  host::KnownCheck check = host::check_known_values(values);
  CHECK(check.of_bound == doctest::Approx(3).epsilon(0.01));
  CHECK(check.worst == doctest::Approx(3e-12).epsilon(0.01));
  CHECK(check.worst_name == values[1].name);
  values[2].f = std::nan("");
  check = host::check_known_values(values);
  CHECK_FALSE(check.of_bound <= 1);
}

TEST_CASE("rows of a matrix: worst sum, largest and smallest factor") {
  Eigen::MatrixXd f(2, 2);
  f << 0, 1, 0.75, 0.125;
  const host::RowCheck check = host::check_rows(f);
  CHECK(check.worst == doctest::Approx(0.125));
  CHECK(check.largest == 1);
  CHECK(check.smallest == 0.125);
}

TEST_CASE("the reference on hostile pairs: finite, not negative, the same at every scale") {
  INFO("seed ", kSeed);
  const auto families = host::check_degenerate(kSeed, 50, 2);
  CHECK(families.size() == 9);
  for (const host::HostileCheck& family : families) {
    INFO(family.name);
    CHECK(family.draws == 50);
    CHECK(family.not_finite + family.negative + family.above_one == 0);
    CHECK(family.asymmetry < 1e-12);
  }
  const host::ScaleCheck scales = host::check_scales(kSeed, 5, 2);
  CHECK(scales.counts.draws == 10 * 5 * 9);
  CHECK(scales.counts.not_finite + scales.counts.negative == 0);
  CHECK(scales.worst_change < 1e-12);
}

TEST_CASE("statistics: rms from std and bias, the share of a kind of pair") {
  // Errors +3 and +1 and, on an edge, -8 (hundredths).
  const std::vector<host::Measured> pairs = {{0.5, 0.53, host::PairKind::middle},
                                             {0.5, 0.51, host::PairKind::middle},
                                             {0.5, 0.42, host::PairKind::edge}};
  const auto table = host::error_table("three", pairs);
  CHECK(host::rms(table.front()) == doctest::Approx(0.01 * std::sqrt((9 + 1 + 64) / 3.0)));
  const host::ErrorShare edge = host::error_share(table, host::PairKind::edge);
  CHECK(edge.pairs == 1);
  CHECK(edge.share == doctest::Approx(64 / 74.0));
  CHECK(host::error_share(table, host::PairKind::corner).pairs == 0);
}

TEST_CASE("free quads: decades hold what they say, whatever the number of threads") {
  const auto sets = host::free_quads_by_decade(kSeed, 6, 2);
  const auto again = host::free_quads_by_decade(kSeed, 6, 1);
  REQUIRE(sets.size() == 6);
  for (std::size_t d = 0; d < sets.size(); ++d) {
    REQUIRE(sets[d].pairs.size() == 6);
    CHECK(sets[d].exact == again[d].exact);
    for (std::size_t k = 0; k < 6; ++k) {
      const double f = sets[d].exact[k];
      CHECK(f >= std::pow(10, double(d) - 6));
      CHECK(f < std::pow(10, double(d) - 5));
      CHECK(f == host::reference_form_factor(sets[d].pairs[k].p, sets[d].pairs[k].q));
    }
  }
  const auto convex = host::concave_part(sets, false), concave = host::concave_part(sets, true);
  CHECK(convex.pairs.size() + concave.pairs.size() == 36);
  CHECK(concave.pairs.size() > convex.pairs.size());  // three of four pairs hold one
}

TEST_CASE(
    "methods on pairs: the reference is right, the engine says the same alone and in a table") {
  const host::PairSet set = host::room_pairs(kSeed, 300, 2);
  const auto rows = host::measure_pairs(set, {method("reference"), method("net", &urad_general),
                                              method("hemicube:64"), method("kernel")});
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].errors.max == 0);
  CHECK(rows[0].errors.std == 0);
  std::vector<host::Measured> direct;
  const host::PairMethod net = host::engine_method(&urad_general);
  for (std::size_t k = 0; k < set.pairs.size(); ++k)
    direct.push_back({set.exact[k], net(set.pairs[k].p, set.pairs[k].q), host::PairKind::middle});
  CHECK(host::error_row("net", direct).std == rows[1].errors.std);
  for (const host::MethodRow& row : rows) {
    INFO(row.label);
    CHECK(row.errors.pairs == set.pairs.size());
    CHECK(row.ns > 0);
  }
}

TEST_CASE("cube7, general network that never saw it: bound, and better than both kernels") {
  const host::Scene scene = host::load_scene("cube7");
  const host::FixedScene fixed(scene);
  const host::SceneDataset dataset = host::scene_dataset(scene, fixed, kFarRho);
  const auto rows = host::measure_scene(
      scene, dataset,
      {method("net", &urad_general), method("fixed-kernel"), method("fixed-moment")});
  CHECK(rows[0].row.errors.pairs == 72030);
  CHECK(rows[0].row.errors.std <= 6e-4);
  CHECK(rows[0].row.errors.std < rows[1].row.errors.std);
  CHECK(rows[0].row.errors.std < rows[2].row.errors.std);
  CHECK(host::error_share(rows[2].table, host::PairKind::edge).pairs == 168);
  CHECK(host::error_share(rows[2].table, host::PairKind::edge).share > 0.9);
}

TEST_CASE("occluded plates within the bound of the hybrid") {
  for (const host::OccludedCheck& check :
       host::check_occluded(host::known_square_obstructions(), 2)) {
    INFO(check.name);
    CHECK(std::fabs(check.hybrid - check.f) <= 1e-2);
    CHECK(std::fabs(check.rays_cut - check.f) <= 3e-3);
  }
}

TEST_CASE("general network on pairs from a seed of this moment: better than both kernels") {
  const auto seed = std::uint64_t(std::random_device()());
  INFO("seed ", seed);
  const auto families = host::measure_general(
      {host::engine_method(&urad_general), host::engine_method(nullptr)}, seed, 1500, kFarRho, 2);
  for (const host::GeneralMeasurement& family : families) {
    INFO(std::string(host::name(family.family)));
    const host::ErrorRow net = host::error_row("net", family.by_method[0]);
    const host::ErrorRow moment = host::error_row("moment", family.by_method[1]);
    CHECK(host::rms(net) < host::rms(moment));
  }
  const host::PairSet rooms = host::room_pairs(seed, 3000, 2);
  const auto rows = host::measure_pairs(
      rooms, {method("net", &urad_general), method("fixed-kernel"), method("fixed-moment")});
  CHECK(rows[0].errors.std < rows[1].errors.std);
  CHECK(rows[0].errors.std < rows[2].errors.std);
  CHECK(rows[0].errors.median < rows[1].errors.median);
  CHECK(rows[0].errors.median < rows[2].errors.median);
}

TEST_CASE("a room written at run time: cube7's bounds within a factor of two") {
  for (const unsigned seed : {4u, 7u}) {
    const double scale = seed == 4 ? 1e-3 : 1e3;
    const host::Scene scene = written_room(seed, scale);
    CAPTURE(seed);
    CAPTURE(scale);
    CHECK(scene.closed);
    CHECK(scene.convex);
    host::TrainRequest request;
    request.hidden = 8;
    request.seed = seed;
    request.threads = 2;
    request.effort = 0.1;
    host::SceneSolver solver(scene, 2, true, 1);
    const host::SceneNetTrial trial =
        host::try_scene_net(solver, host::train_scene_net(scene, request).value());
    CHECK(trial.factors.std <= 2 * 3e-5);
    CHECK(trial.held_out_std > 0);
    CHECK(trial.factors.row_worst <= 2 * 0.003);
    CHECK(trial.light <= 2 * 0.003);
    const urad_net& own = trial.net.quantised16.pod();
    CHECK(host::light_by_near_hybrid(solver, own, 32) <= 2 * 0.01);

    const host::SceneDataset dataset = host::scene_dataset(scene, host::FixedScene(scene), kFarRho);
    const auto rows = host::measure_scene(scene, dataset,
                                          {method("net", &urad_general), method("fixed-kernel"),
                                           method("fixed-moment"), method("lambert:1")});
    const double general = rows[0].row.errors.std;
    CHECK(general <= 2 * 6e-4);
    CHECK(general < rows[1].row.errors.std);
    CHECK(general < rows[2].row.errors.std);

    // A hemicube looks from the centre: however fine, it has the error of the exact factor from
    // there, and walls of 3 x 3 patches have more of it than cube7's. Cut patches hold the bound.
    const host::HemicubeTrial hemicube = host::try_hemicube(solver, 64, 2);
    CHECK(hemicube.exact_rows == hemicube.rows);
    CHECK(hemicube.factors.std <= 2 * rows[3].row.errors.std);
    CHECK(std_of_cut_hemicubes(solver, written_room(seed, scale, 3), 3, 64) <= 2 * 8e-4);
  }
}

TEST_CASE("the closed form on random and degenerate pairs and on a cube") {
  std::vector<host::ClosedFormCheck> checks = host::check_closed_form(7, 60, 0);
  CHECK(checks.size() == 11);
  const host::Scene scene = host::load_scene("cube7");
  Eigen::MatrixXd exact = Eigen::MatrixXd::Zero(294, 294);
  for (int i = 0; i < 294; ++i)
    for (int j = 0; j < i; ++j)
      exact(i, j) = exact(j, i) = host::reference_form_factor(
          scene.patches[std::size_t(i)].polygon, scene.patches[std::size_t(j)].polygon);
  checks.push_back(host::check_closed_form(scene, exact, 0));
  CHECK(checks.back().pairs == 294 * 294);
  for (const host::ClosedFormCheck& check : checks) {
    INFO(check.name);
    CHECK(check.refused == 0);
    CHECK(check.understated == 0);
    CHECK(check.worst < 1e-11);
    CHECK(check.largest_bound <= 1e-9);
  }
  exact(20, 100) += 1e-8;  // a wrong factor is seen
  const host::ClosedFormCheck wrong = host::check_closed_form(scene, exact, 0);
  CHECK(wrong.understated == 1);
  CHECK(wrong.worst == doctest::Approx(1e-8).epsilon(0.01));
}
