// Section 4.2.3: what the report's training costs today. Epochs are all alike, so a few are timed.
#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "legacy/reproduce.hpp"
#include "report/text.hpp"

namespace host {

namespace {

constexpr int kTimedEpochs = 20, kReportEpochs = 4000;

double seconds_an_epoch(const LegacySplit& data, int hidden) {
  BackpropSettings settings;
  settings.hidden = hidden;
  settings.epochs = kTimedEpochs;
  BackpropState state = backprop_start(settings);
  const Stopwatch time;
  backprop(data, settings, &state);
  return time.seconds() / kTimedEpochs;
}

}  // namespace

std::vector<ResultTable> reproduce_training(const ReproduceRequest& request,
                                            const CubeExperiment& cube) {
  ResultTable table{
      "training",
      fmt::format("Training on the cube, one core: the mean of {} epochs", kTimedEpochs),
      {"hidden units", "samples an epoch", "ns a step", "seconds for 4,000 epochs"},
      {},
      {}};
  const LegacySplit data = legacy_split(legacy_samples(cube, LegacyScaling::linear), request.seed);
  for (const int hidden : {50, 30, 15, 5}) {
    const double epoch = seconds_an_epoch(data, hidden);
    table.rows.push_back({std::to_string(hidden), std::to_string(data.training.size()),
                          short_number(1e9 * epoch / double(data.training.size())),
                          fmt::format("{:.0f}", kReportEpochs * epoch)});
  }
  table.notes = {
      "A step: one sample forward and back, all weights moved; with it the error of the validation "
      "samples after each epoch."};
  return {table};
}

}  // namespace host
