// Is Levenberg-Marquardt the right way to train a small network, and does it need all its inputs?
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace host {

struct TrainingTrialRequest {
  int hidden = 8;
  std::vector<std::uint64_t> seeds{1, 2, 3};
  double effort = 1;  ///< of the data and of the steps: TrainRequest
  int threads = 0;
};

/// One way over all seeds: from one random start each, the loss of `urad train --general` on pairs
/// to train on and on others; roots, log2 units.
struct TrainingTrial {
  std::string name;
  std::vector<double> training, validation;  ///< [seed]
  double seconds = 0;                        ///< of a seed, the mean
};

/// Levenberg-Marquardt to its end, then L-BFGS [Nocedal 1980] and Adam [Kingma and Ba 2015] from
/// the same starts for as long as it took, and for five times that.
std::vector<TrainingTrial> try_optimisers(const TrainingTrialRequest& request);

/// Levenberg-Marquardt with all inputs, and without each of them.
std::vector<TrainingTrial> try_inputs(const TrainingTrialRequest& request);

/// A table in Markdown, a row a way.
std::string training_table(const std::vector<TrainingTrial>& trials);

}  // namespace host
