// The report's open questions in small: each table exists, and what it is quoted for holds.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "legacy/adam.hpp"
#include "legacy/experiments.hpp"
#include "network/random.hpp"
#include "weights/cube7.h"
#include "weights/general.h"

namespace {

namespace fs = std::filesystem;

const urad_net* shipped(const std::string& name) {
  return name == "cube7" ? &urad_cube7 : name == "general" ? &urad_general : nullptr;
}

host::ExperimentRequest small() {
  host::ExperimentRequest request{{}, {shipped}};
  request.base.folder = std::string(URAD_SCRATCH_DIR) + "/experiments";
  request.base.epochs = 3;
  request.base.share = 0.02;
  request.base.quiet = true;
  fs::create_directories(request.base.folder);
  return request;
}

const host::CubeExperiment& cube() {
  static const host::CubeExperiment experiment = host::cube_experiment(small().base, 50);
  return experiment;
}

/// The number at the start of a cell.
double number(const host::ResultTable& table, const std::string& row, const std::string& column) {
  for (const auto& cells : table.rows) {
    if (cells[0] != row) continue;
    for (std::size_t k = 0; k < table.header.size(); ++k)
      if (table.header[k] == column) return std::stod(cells[k]);
  }
  FAIL("no such cell: ", row, ", ", column);
  return 0;
}

}  // namespace

TEST_CASE("vertex orders: raw networks tell them apart, invariant ones do not") {
  const host::ResultTable table = host::experiment_orders(small(), cube());
  CHECK(number(table, "the report's linear50", "spread") > 0);
  CHECK(number(table, "net:general", "spread") == 0);
  CHECK(number(table, "net:general", "widest") == 0);
  CHECK(number(table, "net:cube7", "widest") == 0);
}

TEST_CASE("normals: learned for the order of training only") {
  host::ExperimentRequest request = small();
  request.base.epochs = 15;
  const host::ResultTable table = host::experiment_normals(request, cube());
  CHECK(number(table, "cube7, held out", "std of error") <
        number(table, "cube7, other vertex orders", "std of error") / 2);
  CHECK(number(table, "cube7, held out", "std of error") <
        number(table, "cube7, held out", "std of the target") / 2);
}

TEST_CASE("Adam learns a product, and refuses what it has no loss for") {
  host::Random random(7);
  std::vector<host::LegacySample> samples(3000);
  for (host::LegacySample& sample : samples) {
    for (float& x : sample.input) x = float(random.uniform());
    sample.target = float(host::legacy_scaled(host::LegacyScaling::linear,
                                              double(sample.input[0]) * double(sample.input[13])));
  }
  const host::LegacySplit split = host::legacy_split(samples, 7);
  host::AdamSettings settings;
  settings.hidden = 12;
  settings.epochs = 150;
  settings.floor = 0.05;
  const auto relative = [&](const host::LegacyNet& net) {
    double sum = 0;
    for (const host::LegacySample& sample : split.training) {
      const double f = host::legacy_unscaled(net.scaling, double(sample.target));
      sum += std::pow((net.form_factor(sample.input) - f) / (f + settings.floor), 2);
    }
    return sum / double(split.training.size());
  };
  const host::LegacyNet squared = host::train_adam(split, settings);
  settings.loss = host::LegacyLoss::relative;
  const host::LegacyNet weighed = host::train_adam(split, settings);
  CHECK(host::legacy_error(squared, split.test) < 0.031 / 30);  // of the target's variance
  CHECK(relative(weighed) < relative(squared));
  settings.scaling = host::LegacyScaling::log;
  CHECK_THROWS_AS(host::train_adam(split, settings), host::Error);
  CHECK_THROWS_AS(host::train_adam({}, {}), host::Error);
}

TEST_CASE("larger networks: every size and loss has a row, measured where trained and held out") {
  host::ExperimentRequest request = small();
  request.base.share = 0.002;  // one pass
  const host::ResultTable table = host::experiment_sizes(request, cube());
  REQUIRE(table.rows.size() == 9);
  for (const auto& row : table.rows) {
    REQUIRE(row.size() == table.header.size());
    CHECK(std::stod(row[2]) > 1e-3);  // std after one pass: nobody has learned the cube
    CHECK(std::stod(row[2]) < 0.05);
    CHECK(std::stod(row[5]) > 5);  // median where held out, per cent
  }
}

TEST_CASE("sampled kernels: Gauss's points have the median, softening the near pairs") {
  const host::ResultTable table = host::experiment_sampling(small(), cube());
  CHECK(number(table, "2 x 2 Gauss", "rooms: median") < number(table, "1 point", "rooms: median"));
  CHECK(number(table, "3 x 3 Gauss", "rooms: median") <
        number(table, "2 x 2 Gauss", "rooms: median"));
  CHECK(number(table, "2 x 2 Gauss", "cube: median") < number(table, "1 point", "cube: median"));
  CHECK(table.rows.size() == 10);
}

TEST_CASE("visibility: more rays are nearer, one ray is worst where pairs are half seen") {
  const host::ResultTable table = host::experiment_visibility(small());
  REQUIRE(table.rows.size() == 27);
  const auto rms = [&](std::size_t row) { return std::stod(table.rows[row][2]); };
  for (std::size_t scene = 0; scene < 27; scene += 9) {
    CAPTURE(table.rows[scene][0]);
    CHECK(table.rows[scene + 1][1] == "one ray between the centres");
    CHECK(rms(scene + 5) < rms(scene + 2));        // 256 rays against 4
    CHECK(rms(scene + 5) < 0.2 * rms(scene + 1));  // and against one
  }
}

TEST_CASE(
    "bias is worse than noise of its size, in light and in the picture; noise has the edges") {
  const host::ResultTable table = host::experiment_spread(small(), cube());
  for (const char* column : {"rms of B", "picture rms of 255"})
    CHECK(number(table, "bias 4.1e-04", column) > 5 * number(table, "noise 4.1e-04", column));
  CHECK(number(table, "bias 4.1e-04", "false edges") <
        number(table, "noise 4.1e-04", "false edges"));
}

TEST_CASE("thirty years: every method has a row, the reference no error") {
  const host::ResultTable table = host::experiment_years(small(), cube());
  CHECK(number(table, "reference", "cube: std") == 0);
  CHECK(number(table, "net:cube7", "cube: std") < 1e-5);
  CHECK(number(table, "the report's linear50 (for the cube)", "cube: std") > 1e-3);
  CHECK(number(table, "lambert:3", "random: std") < number(table, "kernel", "random: std"));
}

TEST_CASE("documents get the tables between their marks, and nothing else") {
  const host::ResultTable table{"name", "A title", {"a"}, {{"1"}}, {"A note."}};
  const std::string filled =
      host::with_tables("before\n<!-- name -->\nold\n<!-- end -->\nafter\n", {table}, "x.md");
  CHECK(filled == "before\n<!-- name -->\n" + host::to_markdown(table) + "<!-- end -->\nafter\n");
  CHECK(host::with_tables(filled, {table}, "x.md") == filled);
  CHECK(host::with_tables("none", {table}, "x.md") == "none");
  CHECK_THROWS_AS(host::with_tables("<!-- name -->\n", {table}, "x.md"), host::Error);
}
