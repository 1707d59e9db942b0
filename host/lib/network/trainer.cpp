#include "network/trainer.hpp"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "network/engine_range.hpp"
#include "network/random.hpp"

namespace host {

namespace {

constexpr int kTries = 12;  // dampings to try before a candidate counts as finished

std::vector<double> to_std(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }
Eigen::VectorXd to_eigen(const std::vector<double>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), Eigen::Index(v.size()));
}

struct Damping {
  double lambda = 1e-2, growth = 2;
};

// One step [Marquardt 1963; damping by gain ratio: Nielsen 1999]. False, net untouched, when no
// damping helps to a lower loss that the engine can hold. free empty: all parameters.
bool step(const Objective& objective, const Normalisation& scaling, double robust, double decay,
          const std::vector<int>& free, FloatNet* net, Damping* damping) {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  const double loss =
      objective.model(*net, robust, &hessian, &gradient) + decay * net->parameters.squaredNorm();
  gradient -= decay * net->parameters;
  hessian.diagonal().array() += decay;
  if (!free.empty()) {
    gradient = Eigen::VectorXd(gradient(free));
    hessian = Eigen::MatrixXd(hessian(free, free));
  }
  // A parameter without influence gets a floor relative to the others, so that damping reaches it
  // too.
  const Eigen::VectorXd scale =
      hessian.diagonal().cwiseMax(1e-9 * hessian.diagonal().mean() + decay);

  for (int attempt = 0; attempt < kTries; ++attempt) {
    Eigen::MatrixXd damped = hessian;
    damped.diagonal() += damping->lambda * scale;
    const Eigen::VectorXd move = damped.ldlt().solve(gradient);
    FloatNet moved = *net;
    if (free.empty())
      moved.parameters += move;
    else
      moved.parameters(free) += move;
    const double moved_loss =
        objective.value(moved, robust) + decay * moved.parameters.squaredNorm();
    const double expected = move.dot(damping->lambda * scale.cwiseProduct(move) + gradient);
    if (std::isfinite(moved_loss) && moved_loss < loss && expected > 0 &&
        engine_can_hold(fold_normalisation(moved, scaling.mean, scaling.deviation))) {
      const double gain = (loss - moved_loss) / expected;
      damping->lambda *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
      damping->lambda = std::max(damping->lambda, 1e-12);
      damping->growth = 2;
      *net = moved;
      return true;
    }
    damping->lambda *= damping->growth;
    damping->growth *= 2;
  }
  return false;
}

double total_steps(const std::vector<Stage>& stages) {
  double steps = 0;
  for (const Stage& stage : stages) steps += double(stage.keep) * stage.iterations;
  return steps;
}

double steps_done(const std::vector<Stage>& stages, const TrainerState& state) {
  double steps = state.iteration;
  for (std::size_t k = 0; k < std::size_t(state.stage); ++k)
    steps += double(stages[k].keep) * stages[k].iterations;
  return steps + double(state.place) * stages[std::size_t(state.stage)].iterations;
}

TrainerState first_state(const Objective& judge, const TrainerSettings& settings, int inputs) {
  TrainerState state;
  for (int id = 0; id < settings.stages.front().keep; ++id) {
    const FloatNet net = random_start(settings.hidden, settings.seed, id, inputs);
    Candidate candidate;
    candidate.id = id;
    candidate.parameters = candidate.best = to_std(net.parameters);
    candidate.best_value = judge.value(net, settings.stages.front().robust);
    candidate.damping = Damping{}.lambda;
    state.candidates.push_back(candidate);
  }
  return state;
}

void check_resumed(const TrainerState& state, const TrainerSettings& settings, int inputs) {
  const auto size = std::size_t(FloatNet::count(inputs, settings.hidden));
  bool fits = state.stage >= 0 && std::size_t(state.stage) < settings.stages.size() &&
              state.place >= 0 && state.iteration >= 0;
  if (fits) {
    const Stage& stage = settings.stages[std::size_t(state.stage)];
    fits = state.candidates.size() == std::size_t(stage.keep) && state.place <= stage.keep &&
           state.iteration <= stage.iterations;
  }
  for (const Candidate& c : state.candidates)
    fits = fits && c.parameters.size() == size && c.best.size() == size;
  if (!fits) throw Error("the training state to resume from belongs to other settings: delete it");
}

// Starts a stage: the best go on from their best point, judged by the new stage's loss.
void begin_stage(const Objective& judge, const TrainerSettings& settings, int inputs,
                 TrainerState* state) {
  const Stage& stage = settings.stages[std::size_t(state->stage)];
  std::stable_sort(
      state->candidates.begin(), state->candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.best_value < b.best_value; });
  state->candidates.resize(std::size_t(stage.keep));
  for (Candidate& c : state->candidates) {
    FloatNet net(inputs, settings.hidden);
    net.parameters = to_eigen(c.best);
    c.parameters = c.best;
    c.best_value = judge.value(net, stage.robust);
    c.damping = Damping{}.lambda;
    c.growth = Damping{}.growth;
    c.finished = false;
  }
}

}  // namespace

FloatNet random_start(int hidden, std::uint64_t seed, int id, int inputs) {
  Random random(seed, std::uint64_t(id));
  FloatNet net(inputs, hidden);
  for (int k = 0; k < net.output_at(); ++k)
    net.parameters[k] = random.normal() / (k < net.hidden_bias_at() ? std::sqrt(inputs) : 1);
  for (int h = 0; h < hidden; ++h) net.parameters[net.output_at() + h] = 0.1 * random.normal();
  return net;
}

std::optional<FloatNet> train(const TrainingSet& training, const TrainingSet& validation,
                              const TrainerSettings& settings, const TrainerHooks& hooks) {
  const auto needs_net = [](const Sample& s) { return s.gate_uq16 != 0 && s.weight > 0; };
  if (std::none_of(training.samples.begin(), training.samples.end(), needs_net))
    throw Error("nothing to train: every pair is far enough for the kernel alone");
  for (std::size_t k = 0; k < settings.stages.size(); ++k)
    if (settings.stages[k].keep < 1 || settings.stages[k].iterations < 1 ||
        (k > 0 && settings.stages[k].keep > settings.stages[k - 1].keep))
      throw Error("training stages must keep fewer and fewer candidates, at least 1");
  if (settings.stages.empty()) throw Error("training needs at least one stage");

  const Normalisation scaling = normalisation(training);
  const Objective objective(training, scaling, settings.threads);
  const bool own_judge = !validation.samples.empty();
  const Objective judge(own_judge ? validation : training, scaling, settings.threads);

  TrainerState state = hooks.resume ? *hooks.resume : first_state(judge, settings, training.inputs);
  check_resumed(state, settings, training.inputs);
  const double all_steps = total_steps(settings.stages);

  while (true) {
    const Stage& stage = settings.stages[std::size_t(state.stage)];
    for (; state.place < stage.keep; ++state.place, state.iteration = 0) {
      Candidate& c = state.candidates[std::size_t(state.place)];
      while (state.iteration < stage.iterations && !c.finished) {
        FloatNet net(training.inputs, settings.hidden);
        net.parameters = to_eigen(c.parameters);
        Damping damping{c.damping, c.growth};
        c.finished = !step(objective, scaling, stage.robust, settings.decay, {}, &net, &damping);
        c.damping = damping.lambda, c.growth = damping.growth;
        c.parameters = to_std(net.parameters);
        const double value = judge.value(net, stage.robust);
        if (value < c.best_value) c.best_value = value, c.best = c.parameters;
        ++state.iteration;
        if (hooks.step) {
          double best = c.best_value;
          for (const Candidate& other : state.candidates) best = std::min(best, other.best_value);
          if (!hooks.step({steps_done(settings.stages, state) / all_steps, best}, state))
            return std::nullopt;
        }
      }
    }
    if (std::size_t(state.stage) + 1 == settings.stages.size()) break;
    ++state.stage, state.place = 0, state.iteration = 0;
    begin_stage(judge, settings, training.inputs, &state);
  }

  const auto best = std::min_element(
      state.candidates.begin(), state.candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.best_value < b.best_value; });
  FloatNet net(training.inputs, settings.hidden);
  net.parameters = to_eigen(best->best);
  return fold_normalisation(net, scaling.mean, scaling.deviation);
}

FloatNet refine(const FloatNet& net, const Objective& objective, const Normalisation& scaling,
                const std::vector<char>& free, int iterations, double robust, double decay) {
  std::vector<int> index;
  for (std::size_t p = 0; p < free.size(); ++p)
    if (free[p]) index.push_back(int(p));
  if (index.empty()) return net;
  FloatNet moved = unfold_normalisation(net, scaling.mean, scaling.deviation);
  Damping damping;
  for (int k = 0; k < iterations; ++k)
    if (!step(objective, scaling, robust, decay, index, &moved, &damping)) break;
  return fold_normalisation(moved, scaling.mean, scaling.deviation);
}

}  // namespace host
