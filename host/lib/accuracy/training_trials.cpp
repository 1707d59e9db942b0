#include "accuracy/training_trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <nlopt.hpp>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "network/general_pairs.hpp"
#include "network/random.hpp"
#include "network/train_net.hpp"

namespace host {

namespace {

constexpr std::size_t kBatches = 32;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// What the ways have in common: data, loss, a random start.
struct Task {
  TrainerSettings settings;
  double robust;
  GeneralDataset data;
  Normalisation scaling;
  Objective training, validation;

  /// The settings of `urad train --general` with as many steps from a single start.
  Task(TrainerSettings general, GeneralDataset pairs)
      : settings(std::move(general)),
        robust(settings.stages.front().robust),
        data(std::move(pairs)),
        scaling(normalisation(data.training)),
        training(data.training, scaling, settings.threads),
        validation(data.validation, scaling, settings.threads) {
    int steps = 0;
    for (const Stage& stage : settings.stages) steps += stage.iterations;
    settings.stages = {{1, steps, robust}};
  }

  FloatNet start() const { return random_start(settings.hidden, settings.seed, 0); }

  /// The loss with decay, and its derivatives.
  double loss(const Objective& objective, const FloatNet& net, Eigen::VectorXd* slope) const {
    const double data_loss = objective.slope(net, robust, slope);
    *slope = 2 * (settings.decay * net.parameters - *slope);
    return data_loss + settings.decay * net.parameters.squaredNorm();
  }
};

/// Keeps the net that is best on the validation pairs, from the start on.
class Best {
 public:
  explicit Best(const Task& task) : task_(task) { look(task.start()); }

  void look(const FloatNet& net) {
    const double loss = task_.validation.value(net, task_.robust);
    if (loss < validation_) validation_ = loss, training_ = task_.training.value(net, task_.robust);
  }
  void add_to(TrainingTrial* trial) const {
    trial->training.push_back(std::sqrt(training_));
    trial->validation.push_back(std::sqrt(validation_));
  }

 private:
  const Task& task_;
  double training_ = 0, validation_ = std::numeric_limits<double>::infinity();
};

void by_marquardt(const Task& task, TrainingTrial* trial) {
  const auto net = train(task.data.training, task.data.validation, task.settings);
  Best best(task);
  best.look(unfold_normalisation(*net, task.scaling.mean, task.scaling.deviation));
  best.add_to(trial);
}

void by_lbfgs(const Task& task, double seconds, TrainingTrial* trial) {
  FloatNet net = task.start();
  Best best(task);
  using Loss = std::function<double(const std::vector<double>&, std::vector<double>&)>;
  Loss loss = [&](const std::vector<double>& p, std::vector<double>& slope) {
    net.parameters = Eigen::Map<const Eigen::VectorXd>(p.data(), Eigen::Index(p.size()));
    Eigen::VectorXd slopes;
    const double value = task.loss(task.training, net, &slopes);
    if (!slope.empty()) slope.assign(slopes.begin(), slopes.end());
    best.look(net);
    return value;
  };
  std::vector<double> p(net.parameters.begin(), net.parameters.end());
  nlopt::opt optimiser(nlopt::LD_LBFGS, unsigned(p.size()));
  optimiser.set_min_objective([](const std::vector<double>& x, std::vector<double>& slope,
                                 void* f) { return (*static_cast<Loss*>(f))(x, slope); },
                              &loss);
  optimiser.set_vector_storage(20);
  optimiser.set_maxtime(seconds);
  double least = 0;
  try {
    optimiser.optimize(p, least);
  } catch (const std::runtime_error&) {  // no lower loss along its direction: as far as it comes
  }
  best.add_to(trial);
}

/// The training set in `kBatches` parts, each a loss of its own.
std::vector<Objective> batches_of(const Task& task, Random& random) {
  std::vector<Sample> samples = task.data.training.samples;
  random.shuffle(samples);
  std::vector<Objective> batches;
  for (std::size_t b = 0; b < kBatches; ++b) {
    TrainingSet part;
    for (std::size_t k = b; k < samples.size(); k += kBatches) part.samples.push_back(samples[k]);
    batches.emplace_back(part, task.scaling, 1);
  }
  return batches;
}

void by_adam(const Task& task, double seconds, TrainingTrial* trial) {
  constexpr double kRate = 0.01, kMean = 0.9, kSquare = 0.999, kTiny = 1e-8;
  Random random(task.settings.seed, 1);
  const std::vector<Objective> batches = batches_of(task, random);
  FloatNet net = task.start();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(net.parameters.size()), square = mean;
  Best best(task);
  const auto start = std::chrono::steady_clock::now();
  for (long step = 1;; ++step) {
    const double done = seconds_since(start) / seconds;
    if (done >= 1) break;
    const Objective& batch = batches[std::size_t(random.below(int(kBatches)))];
    Eigen::VectorXd slope;
    task.loss(batch, net, &slope);
    mean = kMean * mean + (1 - kMean) * slope;
    square = kSquare * square + (1 - kSquare) * slope.cwiseAbs2();
    const double rate = kRate * 0.5 * (1 + std::cos(std::numbers::pi * done));  // falls to zero
    net.parameters.array() -=
        rate * (mean.array() / (1 - std::pow(kMean, double(step)))) /
        ((square.array() / (1 - std::pow(kSquare, double(step)))).sqrt() + kTiny);
    if (step % long(kBatches) == 0) best.look(net);
  }
  best.look(net);
  best.add_to(trial);
}

TrainRequest training_of(const TrainingTrialRequest& request, std::uint64_t seed) {
  TrainRequest training;
  training.hidden = request.hidden;
  training.seed = seed;
  training.effort = request.effort;
  training.threads = request.threads;
  return training;
}

}  // namespace

std::vector<TrainingTrial> try_optimisers(const TrainingTrialRequest& request) {
  std::vector<TrainingTrial> trials(5);
  const char* names[] = {"Levenberg-Marquardt", "L-BFGS, as long", "Adam, as long",
                         "L-BFGS, five times as long", "Adam, five times as long"};
  for (std::size_t k = 0; k < trials.size(); ++k) trials[k].name = names[k];
  for (const std::uint64_t seed : request.seeds) {
    const TrainRequest training = training_of(request, seed);
    const Task task(general_settings(training), general_training(training));
    const auto start = std::chrono::steady_clock::now();
    by_marquardt(task, &trials[0]);
    const double seconds = seconds_since(start);
    for (const int times : {1, 5}) {
      by_lbfgs(task, times * seconds, &trials[times == 1 ? 1 : 3]);
      by_adam(task, times * seconds, &trials[times == 1 ? 2 : 4]);
    }
    for (std::size_t k = 0; k < trials.size(); ++k)
      trials[k].seconds += (k < 3 ? 1 : 5) * seconds / double(request.seeds.size());
  }
  return trials;
}

std::vector<TrainingTrial> try_inputs(const TrainingTrialRequest& request) {
  static constexpr const char* kInputs[urad::kPairInputs] = {
      "p/R",       "q/R",    "n_i.n_j", "s of i", "a of i", "c of i",    "d of i",
      "fill of i", "s of j", "a of j",  "c of j", "d of j", "fill of j", "bend"};
  std::vector<TrainingTrial> trials(1 + urad::kPairInputs);
  trials[0].name = "all inputs";
  for (int n = 0; n < urad::kPairInputs; ++n)
    trials[std::size_t(n) + 1].name = fmt::format("without {}: {}", n, kInputs[n]);
  for (const std::uint64_t seed : request.seeds) {
    const TrainRequest training = training_of(request, seed);
    const GeneralDataset whole = general_training(training);
    for (std::size_t k = 0; k < trials.size(); ++k) {
      GeneralDataset data = whole;
      if (k > 0)
        for (auto* set : {&data.training, &data.validation})
          for (Sample& sample : set->samples) sample.input_q15[k - 1] = 0;
      const auto start = std::chrono::steady_clock::now();
      by_marquardt({general_settings(training), std::move(data)}, &trials[k]);
      trials[k].seconds += seconds_since(start) / double(request.seeds.size());
    }
  }
  return trials;
}

std::string training_table(const std::vector<TrainingTrial>& trials) {
  std::string text =
      "| way | training loss | validation loss | by the first row's, worst | seconds |\n"
      "| --- | ---: | ---: | ---: | ---: |\n";
  const auto range = [](const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return fmt::format("{:.4f} .. {:.4f}", *least, *most);
  };
  for (const TrainingTrial& trial : trials) {
    double worst = 0;
    for (std::size_t s = 0; s < trial.validation.size(); ++s)
      worst = std::max(worst, trial.validation[s] / trials.front().validation[s]);
    text += fmt::format("| {} | {} | {} | {:.2f} | {:.1f} |\n", trial.name, range(trial.training),
                        range(trial.validation), worst, trial.seconds);
  }
  return text;
}

}  // namespace host
