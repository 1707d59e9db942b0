#include "network/train_net.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "base/file.hpp"
#include "network/checkpoint.hpp"
#include "network/evaluate.hpp"
#include "network/quantise.hpp"
#include "network/trainer.hpp"

namespace host {

namespace {

constexpr double kHeldOut = 0.2;
constexpr double kSceneDecay = 1e-10, kGeneralDecay = 3e-7;
constexpr double kGeneralRobust =
    0.03;  // log2 units: relative errors above 2 % count less and less
// Of the integers of 8 bits, which are to repeat the net as close as they can. Squares: a robust loss
// leaves more error to hard pairs, where p95 is made.
constexpr double kWordRobust = 0, kWordDecay = 1e-11;
// A scene net that leaves more than this error hands its near pairs over to the exact sum, from the
// greatest of these rho on that keeps it below.
constexpr double kEnoughStd = 3e-5;
constexpr double kNearRho[] = {0.6, 0.45, 0.3, 0.2, 0.14, 0.1};
// Random pairs of a family to report errors on: of a quarter as many, p95 is uncertain by 2 %.
constexpr std::size_t kJudged = 8000;

std::vector<Stage> stages(std::vector<Stage> full, double effort) {
  for (Stage& stage : full)
    stage.iterations = std::max(1, int(std::lround(stage.iterations * effort)));
  return full;
}

// Trainings in a row that share one checkpoint file.
class Session {
 public:
  Session(const TrainRequest& request, int trainings) : request_(request), trainings_(trainings) {
    checkpoint_.command = request.command;
    if (request.checkpoint.empty() || !std::filesystem::exists(request.checkpoint)) return;
    if (auto found = checkpoint_from_json(read_file(request.checkpoint), request.command,
                                          request.checkpoint)) {
      checkpoint_ = *found;
      resumed_ = true;
    }
  }

  // Number `done_` of the trainings: from the checkpoint when it is finished there.
  std::optional<FloatNet> train(const TrainingSet& training, const TrainingSet& validation,
                                const TrainerSettings& settings) {
    const std::size_t number = done_++;
    FloatNet net(urad::kPairInputs, settings.hidden);
    if (number < checkpoint_.finished.size()) {
      const std::vector<double>& p = checkpoint_.finished[number];
      if (p.size() != std::size_t(net.parameters.size()))
        throw Error(request_.checkpoint + ": belongs to another training; delete it");
      net.parameters = Eigen::Map<const Eigen::VectorXd>(p.data(), Eigen::Index(p.size()));
      return net;
    }
    TrainerHooks hooks;
    if (resumed_ && number == checkpoint_.finished.size() && !checkpoint_.state.candidates.empty())
      hooks.resume = checkpoint_.state;
    hooks.step = [&](const TrainerProgress& progress, const TrainerState& state) {
      if (request_.progress)
        request_.progress((double(number) + progress.done) / double(trainings_));
      const bool stop = request_.stop && request_.stop();
      const auto now = std::chrono::steady_clock::now();
      if (stop || now - saved_ > std::chrono::seconds(1)) {
        checkpoint_.state = state;
        save();
        saved_ = now;
      }
      return !stop;
    };
    auto trained = run(training, validation, settings, hooks);
    if (!trained) return std::nullopt;
    const Eigen::VectorXd& p = trained->parameters;
    checkpoint_.finished.emplace_back(p.data(), p.data() + p.size());
    checkpoint_.state = {};
    return trained;
  }

  void finish() const {
    std::error_code none;  // what cannot be removed is resumed, and then done at once
    if (!request_.checkpoint.empty()) std::filesystem::remove(request_.checkpoint, none);
  }

 private:
  std::optional<FloatNet> run(const TrainingSet& training, const TrainingSet& validation,
                              const TrainerSettings& settings, const TrainerHooks& hooks) const {
    try {
      return host::train(training, validation, settings, hooks);
    } catch (const Error& error) {
      if (!hooks.resume) throw;
      throw Error(request_.checkpoint + ": " + error.what());
    }
  }

  void save() const {
    if (!request_.checkpoint.empty())
      write_file_atomically(request_.checkpoint, to_json(checkpoint_));
  }

  const TrainRequest& request_;
  int trainings_;
  std::size_t done_ = 0;
  bool resumed_ = false;
  Checkpoint checkpoint_;
  std::chrono::steady_clock::time_point saved_ = std::chrono::steady_clock::now();
};

ErrorRow named(ErrorRow row, const std::string& name) {
  row.name = name;
  return row;
}

std::vector<Measured> together(const std::vector<GeneralMeasurement>& families,
                               std::size_t method) {
  std::vector<Measured> all;
  for (const GeneralMeasurement& family : families)
    all.insert(all.end(), family.by_method[method].begin(), family.by_method[method].end());
  return all;
}

}  // namespace

std::optional<NetFile> train_scene_net(const Scene& scene, const TrainRequest& request) {
  const FixedScene fixed(scene);
  const SceneDataset dataset =
      scene_dataset(scene, fixed, request.far_rho, request.seed, 400000, request.threads);
  if (dataset.pairs.empty())
    throw Error(
        fmt::format("{}: no two patches exchange light, there is nothing to train", scene.name));
  const std::vector<char> all(dataset.configurations.size(), 1);
  const std::vector<char> most = hold_out(dataset, kHeldOut, request.seed);

  // Few configurations are cheap: more starts.
  const auto near = std::count_if(dataset.configurations.begin(), dataset.configurations.end(),
                                  [](const Sample& sample) { return sample.gate_uq16 != 0; });
  const bool small = near < 2000;
  TrainerSettings settings;
  settings.hidden = request.hidden;
  settings.seed = request.seed;
  settings.decay = kSceneDecay;
  settings.threads = request.threads;
  settings.stages = stages(small ? std::vector<Stage>{{10, 40, 0}, {3, 100, 0}, {1, 400, 0}}
                                 : std::vector<Stage>{{6, 20, 0}, {3, 40, 0}, {1, 160, 0}},
                           request.effort);
  Session session(request, 2);
  struct Fit {
    double near_rho;
    FloatNet net;
    QuantisedNet wide;
    ErrorRow error;
  };
  const auto judge = [&](const QuantisedNet& q, const char* name) {
    return named(evaluate(name, dataset, engine_method(fixed, &q.pod())).front(), name);
  };
  const auto fit = [&](double near_rho) -> std::optional<Fit> {
    const auto net = session.train(scene_training_set(dataset, all, near_rho), {}, settings);
    if (!net) return std::nullopt;
    const QuantisedNet wide = with_near_rho(quantise(*net, 16, request.far_rho, {}), near_rho);
    return Fit{near_rho, *net, wide, judge(wide, "int16")};
  };
  std::optional<Fit> best = fit(0);
  if (!best) return std::nullopt;
  for (const double near_rho : kNearRho) {
    if (best->error.std <= kEnoughStd) break;
    const auto other = fit(near_rho);
    if (!other) return std::nullopt;
    if (other->error.std < best->error.std) best = other;
  }
  const double near_rho = best->near_rho;
  const TrainingSet set = scene_training_set(dataset, all, near_rho);
  const auto twin = session.train(scene_training_set(dataset, most, near_rho), {}, settings);
  if (!twin) return std::nullopt;

  const QuantisedNet narrow = with_near_rho(
      quantise(best->net, 8, request.far_rho, {&set, 0, kSceneDecay, request.threads}), near_rho);
  const QuantisedNet wide_twin = with_near_rho(quantise(*twin, 16, request.far_rho, {}), near_rho);
  const SceneMethod twin_method = engine_method(fixed, &wide_twin.pod());
  NetFile file{
      request.command,
      scene.name,
      fmt::format(
          "{} configurations, all trained on; train and held_out: a second net from the same seed, "
          "trained on 80 % of them, on these and on the others",
          dataset.configurations.size()),
      request.seed,
      request.far_rho,
      best->net,
      best->wide,
      narrow,
      {evaluate_part("train", dataset, most, 1, twin_method),
       evaluate_part("held_out", dataset, most, 0, twin_method),
       named(evaluate("kernel", dataset, engine_method(fixed, nullptr)).front(), "kernel"),
       best->error, judge(narrow, "int8")}};
  session.finish();
  return file;
}

GeneralDataset general_training(const TrainRequest& request) {
  return general_dataset(request.far_rho, request.seed, 0.6 * request.effort, request.threads);
}

TrainerSettings general_settings(const TrainRequest& request) {
  TrainerSettings settings;
  settings.hidden = request.hidden;
  settings.seed = request.seed;
  settings.decay = kGeneralDecay;
  settings.threads = request.threads;
  settings.stages = stages(
      {{6, 20, kGeneralRobust}, {3, 40, kGeneralRobust}, {1, 80, kGeneralRobust}}, request.effort);
  return settings;
}

std::optional<NetFile> train_general_net(const TrainRequest& request) {
  const GeneralDataset dataset = general_training(request);
  Session session(request, 1);
  const auto net = session.train(dataset.training, dataset.validation, general_settings(request));
  if (!net) return std::nullopt;

  const QuantisedNet wide = with_near_rho(quantise(*net, 16, request.far_rho, {}), kGeneralNearRho);
  const TrainingSet own_word = with_word_of(*net, dataset.training);
  const QuantisedNet narrow = with_near_rho(
      quantise(*net, 8, request.far_rho, {&own_word, kWordRobust, kWordDecay, request.threads}),
      kGeneralNearRho);
  const std::vector<PairMethod> methods{engine_method(&wide.pod()), engine_method(&narrow.pod()),
                                        engine_method(nullptr)};
  const auto judged = std::size_t(double(kJudged) * request.effort) + 1;
  const auto seen = measure_general({methods[0]}, general_seed(request.seed, PairUse::training),
                                    judged, request.far_rho, request.threads);
  const auto unseen = measure_general(methods, general_seed(request.seed, PairUse::test), judged,
                                      request.far_rho, request.threads);
  NetFile file{
      request.command,
      "general",
      fmt::format(
          "{} random pairs trained on, {} others to choose the net; held_out, int16, int8 and "
          "kernel: {} of neither",
          dataset.training.samples.size(), dataset.validation.samples.size(),
          together(unseen, 0).size()),
      request.seed,
      request.far_rho,
      *net,
      wide,
      narrow,
      {error_row("train", together(seen, 0)), error_row("held_out", together(unseen, 0)),
       error_row("kernel", together(unseen, 2)), error_row("int16", together(unseen, 0)),
       error_row("int8", together(unseen, 1))}};
  for (const GeneralMeasurement& family : unseen)
    file.errors.push_back(
        error_row("int16 " + std::string(name(family.family)), family.by_method[0]));
  session.finish();
  return file;
}

}  // namespace host
