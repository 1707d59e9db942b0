#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "legacy/adam.hpp"
#include "legacy/experiments.hpp"
#include "legacy/statistics.hpp"
#include "network/random.hpp"

namespace host {

namespace {

constexpr int kEpochs = 400;

struct Trial {
  int hidden;
  LegacyScaling scaling;
  LegacyLoss loss;
  const char* name;
};

std::string quantile(std::vector<double> values, double share) {
  const auto rank = std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return fmt::format("{:.3g} %", 100 * values[std::size_t(rank)]);
}

/// std of F; median and p99 of the relative error where trained and where held out; mean size of
/// the row error.
std::vector<std::string> figures(const CubeExperiment& cube, const Eigen::MatrixXd& f,
                                 const std::vector<char>& held_out) {
  std::vector<double> off, trained, held;
  for (Eigen::Index k = 0; k < f.size(); ++k) {
    const double exact = cube.exact.data()[k], error = f.data()[k] - exact;
    if (!(exact > 0)) continue;
    off.push_back(error);
    (held_out[std::size_t(k)] ? held : trained).push_back(std::fabs(error) / exact);
  }
  const double rows = (f - cube.exact).rowwise().sum().cwiseAbs().mean();
  return {short_number(summary(off).std), quantile(trained, 0.5),
          quantile(trained, 0.99),        quantile(held, 0.5),
          quantile(held, 0.99),           fmt::format("{:.2g} %", 100 * rows)};
}

}  // namespace

ResultTable experiment_sizes(const ExperimentRequest& request, const CubeExperiment& cube) {
  // Whole configurations are held out, so that no image of a held-out pair trains.
  const auto n = cube.exact.rows();
  std::vector<char> held_out(std::size_t(cube.exact.size()), 0);
  LegacySplit splits[2];
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double exact = cube.exact(i, j);
      if (!(exact > 0)) continue;
      // Pairs of one configuration have one factor to twelve digits: the factor is its name.
      const auto key = std::uint64_t(std::llround(exact * 1e12));
      const double draw = Random(request.base.seed, key).uniform();
      const auto& patches = cube.scene.patches;
      LegacySample sample{
          legacy_input(patches[std::size_t(i)].polygon, patches[std::size_t(j)].polygon), 0};
      held_out[std::size_t(j * n + i)] = draw < 0.2;
      for (const LegacyScaling scaling : {LegacyScaling::linear, LegacyScaling::log}) {
        sample.target = float(legacy_scaled(scaling, exact));
        LegacySplit& split = splits[scaling == LegacyScaling::log];
        (draw < 0.1   ? split.test
         : draw < 0.2 ? split.validation
                      : split.training)
            .push_back(sample);
      }
    }
  }
  std::vector<Trial> trials;
  for (const int hidden : {50, 100, 200}) {
    trials.push_back(
        {hidden, LegacyScaling::linear, LegacyLoss::squared, "squared, linear scaling"});
    trials.push_back({hidden, LegacyScaling::log, LegacyLoss::squared, "squared, log scaling"});
    trials.push_back({hidden, LegacyScaling::linear, LegacyLoss::relative, "relative"});
  }
  ResultTable table{"experiment_sizes",
                    "Larger networks on the raw coordinates of the cube, by Adam",
                    {"hidden", "loss", "std", "median", "p99", "held out: median", "p99",
                     "row error", "training, s"},
                    std::vector<std::vector<std::string>>(trials.size()),
                    {}};
  const int epochs = std::max(1, int(std::lround(kEpochs * request.base.share)));
  Progress progress("larger networks", trials.size(), request.base.quiet);
  parallel_for(trials.size(), request.base.threads, [&](std::size_t place) {
    const std::size_t k = trials.size() - 1 - place;  // the longest first
    const Trial& trial = trials[k];
    AdamSettings settings;
    settings.hidden = trial.hidden;
    settings.scaling = trial.scaling;
    settings.loss = trial.loss;
    settings.epochs = epochs;
    settings.seed = request.base.seed;
    const Stopwatch time;
    const LegacyNet net = train_adam(splits[trial.scaling == LegacyScaling::log], settings);
    const double seconds = time.seconds();
    std::vector<std::string> row{std::to_string(trial.hidden), trial.name};
    for (auto& cell : figures(cube, legacy_factors(cube.scene, net, 1), held_out))
      row.push_back(std::move(cell));
    row.push_back(fmt::format("{:.0f}", seconds));
    table.rows[k] = std::move(row);
    progress.add();
  });
  table.notes = {fmt::format(
      "The 72,030 facing pairs; std: of F, all of them; median and p99: relative. Adam, batches of "
      "64, {} epochs, step 5e-3 falling to 0. A tenth of the cube's configurations (equal up to "
      "motion, mirror image and direction) chose the state, another tenth was never used; held "
      "out: "
      "both. The report's split by pairs tests memory: it leaves every configuration in the "
      "training set many times.",
      epochs)};
  return table;
}

}  // namespace host
