// Levenberg-Marquardt training of a small network, full batch, from several random starts.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "network/objective.hpp"

namespace host {

/// The candidates of a stage are trained one after the other; the next stage goes on with the best
/// `keep` of them.
struct Stage {
  int keep = 1;        ///< candidates that take part
  int iterations = 1;  ///< Levenberg-Marquardt steps for each
  double robust = 0;   ///< scale c of Objective's robust loss, 0: squares
};

struct TrainerSettings {
  int hidden = 8;
  std::uint64_t seed = 1;
  double decay = 1e-7;        ///< decay * |p|^2 is added to the objective, p for normalised inputs
  std::vector<Stage> stages;  ///< the first one's keep is the number of random starts
  int threads = 0;            ///< 0: all cores
};

/// One random start.
struct Candidate {
  int id = 0;
  std::vector<double> parameters, best;  ///< for normalised inputs
  double best_value = 0;                 ///< validation objective of `best`
  double damping = 1, growth = 2;        ///< Nielsen's lambda and nu
  bool finished = false;                 ///< no step improves it in this stage
};

/// Everything a run needs to go on where it stopped; the result is then the same, bit for bit.
struct TrainerState {
  int stage = 0;
  int place = 0;      ///< candidate of the stage in work
  int iteration = 0;  ///< its steps done in this stage
  std::vector<Candidate> candidates;
};

struct TrainerProgress {
  double done = 0;  ///< 0 .. 1
  double best_value = 0;
};

struct TrainerHooks {
  /// Called after each step. Returning false stops: train() returns nothing and the state is what
  /// to resume from.
  std::function<bool(const TrainerProgress&, const TrainerState&)> step;
  std::optional<TrainerState> resume;
};

/// Number `id` of a seed's random starts, for normalised inputs: weights of unit variance at the
/// sigmoids' inputs, a weak output, for the kernel alone is nearly right already.
FloatNet random_start(int hidden, std::uint64_t seed, int id, int inputs = urad::kPairInputs);

/// The net that is best on `validation` over all steps of the last stage, for inputs as they are
/// (no normalisation) and within what the engine can hold (engine_range.hpp), or nothing when the hook stopped it. An empty validation set: `training`
/// judges. Error when no sample needs the network or a resumed state belongs to other settings.
std::optional<FloatNet> train(const TrainingSet& training, const TrainingSet& validation,
                              const TrainerSettings& settings, const TrainerHooks& hooks = {});

/// Goes on from `net` (inputs as they are) for so many steps with only parameters p, free[p] != 0,
/// moving. scaling: that of the objective.
FloatNet refine(const FloatNet& net, const Objective& objective, const Normalisation& scaling,
                const std::vector<char>& free, int iterations, double robust, double decay);

}  // namespace host
