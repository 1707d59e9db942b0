#include "accuracy/fit_errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "accuracy/error_training.hpp"
#include "accuracy/trial_pairs.hpp"
#include "base/parallel.hpp"
#include "base/quantile.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"

namespace host {

namespace {

using urad::kPairClasses;
using urad::kPairTraits;
using urad::kTraits;
using urad::Way;

constexpr double kQuantile = 0.985;                  // of the networks; shifts see to the rest
constexpr double kGuess = 0.7;                       // of guesses that only spare a sum
constexpr double kCovered = 0.992;                   // of the pairs of a way and class
constexpr double kGroupCovered = 0.991;              // the same, of one family or decade among them
constexpr std::size_t kLeastGroup = 1000;            // outcomes, up to ten of a pair
constexpr double kLeastError = -20, kMostError = 2;  // log2: beyond these nobody asks
constexpr std::size_t kHalvings[] = {0, 1, 2, 4, 7, 12, 20, 31};
constexpr int kMostStops = 32;
constexpr int kPasses = 3;
constexpr std::int16_t kWorthTrying_q8 = -2 * 256;
constexpr double kWanted[] = {-3.32, -5, -6.64, -8.3, -9.97};  // log2 of what may be asked for
constexpr int kRounds = 5;

struct Trial {
  FixedScene scene;
  double exact = 0;
  std::size_t family = 0;
};

std::vector<Trial> trials_of(const ErrorFitRequest& request, std::uint64_t seed) {
  std::vector<Trial> trials;
  const std::vector<TrialFamily> families = trial_families();
  for (std::size_t f = 0; f < families.size(); ++f) {
    if (families[f].test_only) continue;
    const PairSet set =
        trial_pairs(families[f], TrialUse::fit, seed, request.pairs, request.threads);
    for (std::size_t k = 0; k < set.pairs.size(); ++k)
      trials.push_back(
          {FixedScene::of_polygons({set.pairs[k].p, set.pairs[k].q}, {}), set.exact[k], f});
  }
  return trials;
}

double log2_error(const Trial& trial, std::int32_t log2_g_q24) {
  const urad::Patch p = urad::patch_at(trial.scene.pod(), 0);
  const double f = std::exp2((log2_g_q24 - p.shape->log2_area_q24) * 0x1p-24);
  return std::clamp(std::log2(std::fabs(f / trial.exact - 1)), kLeastError, kMostError);
}

ErrorSample sample_of(const Trial& trial, const urad::PairTraits& traits, std::int32_t log2_g_q24) {
  ErrorSample sample;
  sample.error = float(log2_error(trial, log2_g_q24));
  for (std::size_t t = 0; t < kTraits; ++t) sample.trait[t] = float(traits.log2_q8[t]) / 256;
  return sample;
}

/// What one way makes of every pair for which `wanted` (or null) says that it may be asked.
std::vector<ErrorSample> samples_of(const std::vector<Trial>& trials, Way way,
                                    const urad::ErrorModel* wanted,
                                    const ErrorFitRequest& request) {
  std::vector<std::optional<ErrorSample>> all(trials.size());
  parallel_for(trials.size(), request.threads, [&](std::size_t k) {
    const urad_scene& scene = trials[k].scene.pod();
    urad::PairTraits traits;
    std::int32_t log2_g_q24 = 0;
    if (!urad::exchange_by(scene, urad::patch_at(scene, 0), urad::patch_at(scene, 1), way,
                           request.net, &log2_g_q24, &traits))
      return;
    if (way <= Way::network && !urad::moments_do(traits)) return;
    if (wanted && urad::error_q8(*wanted, traits) > kWorthTrying_q8) return;
    all[k] = sample_of(trials[k], traits, log2_g_q24);
  });
  std::vector<ErrorSample> samples;
  for (const std::optional<ErrorSample>& one : all)
    if (one) samples.push_back(*one);
  return samples;
}

/// The network of the refined sum: fitted to sums after some numbers of halvings, then to those at
/// which it would stop itself, too. Stopping at the first guess that is low enough favours those
/// that are too low [as imitation does: Ross, Gordon and Bagnell 2011].
urad::ErrorModel refined_model(const std::vector<Trial>& trials, const ErrorFitRequest& request) {
  std::vector<std::vector<urad::RefinedStop>> stops(trials.size());
  parallel_for(trials.size(), request.threads, [&](std::size_t k) {
    const urad_scene& scene = trials[k].scene.pod();
    stops[k].resize(kMostStops);
    stops[k].resize(std::size_t(urad::refined_stops(
        scene, urad::patch_at(scene, 0), urad::patch_at(scene, 1), stops[k].data(), kMostStops)));
  });
  std::vector<ErrorSample> samples;
  const auto add = [&](std::size_t k, std::size_t stop) {
    const urad::RefinedStop& at = stops[k][std::min(stop, stops[k].size() - 1)];
    samples.push_back(sample_of(trials[k], at.traits, at.log2_exchange_q24));
  };
  for (std::size_t k = 0; k < trials.size(); ++k)
    for (const std::size_t stop : kHalvings)
      if (stop < stops[k].size()) add(k, stop);
  urad::ErrorModel model{};
  for (int pass = 0; pass < kPasses; ++pass) {
    model = train_error_model(samples, kTraits, kQuantile, request.seed);
    if (pass + 1 == kPasses) break;
    for (std::size_t k = 0; k < trials.size(); ++k)
      for (const double wanted : kWanted) {
        if (stops[k].empty()) continue;
        const auto good = std::find_if(stops[k].begin(), stops[k].end(), [&](const auto& stop) {
          return urad::error_q8(model, stop.traits) <= 256 * wanted;
        });
        add(k, std::size_t(good - stops[k].begin()));
      }
  }
  return model;
}

/// A network of ErrorModels, the way whose errors it is to guess, and how.
struct Task {
  const char* name;
  urad::ErrorModel urad::ErrorModels::*model;
  Way way;
  int traits;
};
constexpr Task kTasks[] = {
    {"kernel", &urad::ErrorModels::kernel, Way::kernel, kPairTraits},
    {"network", &urad::ErrorModels::network, Way::network, kPairTraits},
    {"point", &urad::ErrorModels::point, Way::point, kPairTraits},
    {"four points", &urad::ErrorModels::four_points, Way::four_points, kTraits},
    {"nine points and refined", &urad::ErrorModels::refined, Way::refined, kTraits},
    {"four points, before", &urad::ErrorModels::before_four, Way::four_points, kPairTraits},
};

std::size_t task_of(Way way) {
  return std::min<std::size_t>(std::size_t(way) - 1, 4);  // nine points and refined share one
}

/// Error less estimate of the pairs of one class that a way was chosen for.
class Residuals {
 public:
  void add(double off, std::size_t family, int decade) {
    all_.push_back(off);
    families_[family].push_back(off);
    decades_[decade].push_back(off);
  }
  /// What the guess must rise by so that it covers its share of them, and of every group.
  double shift() const {
    if (all_.size() < kLeastGroup) return 0;
    double shift = quantile(all_, kCovered);
    const auto cover = [&](const auto& groups) {
      for (const auto& [key, off] : groups)
        if (off.size() >= kLeastGroup) shift = std::max(shift, quantile(off, kGroupCovered));
    };
    cover(families_);
    cover(decades_);
    return shift;
  }

 private:
  std::vector<double> all_;
  std::map<std::size_t, std::vector<double>> families_;
  std::map<int, std::vector<double>> decades_;
};

struct Outcome {
  urad::CheapestPair pair;
  int pair_class = 0;
};

/// Lets the engine choose, and moves what it said until that holds for what it chose: taking the
/// first guess that is low enough favours those that are too low.
void calibrate(const std::vector<Trial>& trials, const ErrorFitRequest& request,
               urad::ErrorModels* models) {
  constexpr std::size_t levels = std::size(kWanted);
  std::vector<Outcome> outcomes(2 * levels * trials.size());
  parallel_for(trials.size(), request.threads, [&](std::size_t k) {
    const urad_scene& scene = trials[k].scene.pod();
    const urad::Patch p = urad::patch_at(scene, 0), q = urad::patch_at(scene, 1);
    urad::PairTraits traits{};
    std::int32_t log2_g_q24 = 0;
    urad::exchange_by(scene, p, q, Way::kernel, nullptr, &log2_g_q24, &traits);
    for (std::size_t level = 0; level < 2 * levels; ++level) {
      urad_counters counters{};
      outcomes[2 * levels * k + level] = {
          urad::cheapest_exchange(*models, scene, p, q, level < levels ? request.net : nullptr,
                                  std::int16_t(256 * kWanted[level % levels]), &counters),
          int(traits.pair_class)};
    }
  });
  std::array<std::array<Residuals, kPairClasses>, std::size(kTasks)> residuals;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const Trial& trial = trials[k / (2 * levels)];
    const urad::CheapestPair& pair = outcomes[k].pair;
    if (pair.way == Way::none) continue;
    residuals[task_of(pair.way)][std::size_t(outcomes[k].pair_class)].add(
        log2_error(trial, pair.log2_exchange_q24) - pair.log2_error_q8 / 256.0, trial.family,
        trial_decade(trial.exact));
  }
  for (std::size_t task = 0; task <= task_of(Way::refined); ++task)
    for (std::size_t c = 0; c < kPairClasses; ++c) {
      std::int16_t& shift = (models->*kTasks[task].model).shift_q8[c];
      shift = std::int16_t(shift + std::lround(256 * residuals[task][c].shift()));
    }
}

std::string text_of(const urad::ErrorModel& model, const char* name) {
  const auto list = [](const auto* values, int count) {
    return fmt::format("{}", fmt::join(values, values + count, ", "));
  };
  std::string text = fmt::format("    {{// {}\n     {},\n     {{\n", name, model.traits);
  for (const auto& weights : model.weight_q10)
    text += fmt::format("         {{{}}},\n", list(weights, model.traits));
  return text +
         fmt::format(
             "     }},\n     {{{}}},\n     {{{}}},\n     {{{}}},\n     {},\n     {{{}}}}},\n",
             list(model.hidden_bias_q18, urad::kErrorHidden),
             list(model.out_q8, urad::kErrorHidden), list(model.skip_q10, model.traits),
             model.bias_q8, list(model.shift_q8, kPairClasses));
}

}  // namespace

std::string fitted_error_models(const ErrorFitRequest& request) {
  const std::vector<Trial> trials = trials_of(request, request.seed);
  urad::ErrorModels models{};
  models.before_four = train_error_model(samples_of(trials, Way::four_points, nullptr, request),
                                         kPairTraits, kGuess, request.seed);
  parallel_for(task_of(Way::refined) + 1, request.threads, [&](std::size_t k) {
    const Task& task = kTasks[task_of(Way::refined) - k];  // the longest first
    ErrorFitRequest alone = request;
    alone.threads = 1;
    models.*task.model =
        task.way == Way::refined
            ? refined_model(trials, alone)
            : train_error_model(
                  samples_of(trials, task.way,
                             task.way == Way::four_points ? &models.before_four : nullptr, alone),
                  task.traits, kQuantile, request.seed);
  });
  const std::vector<Trial> others = trials_of(request, request.seed + 1);
  for (int round = 0; round < kRounds; ++round) calibrate(others, request, &models);
  const std::vector<TrialFamily> families = trial_families();
  std::string tables;
  for (const Task& task : kTasks) tables += text_of(models.*task.model, task.name);
  return fmt::format(
      R"(// cheapest_models.hpp -- what each way to a form factor is off by: constants for cheapest.hpp.
//
//   Written by  {}
//   Pairs       {} of each of {} families (accuracy/trial_pairs.hpp), stream TrialUse::fit
//   Fit         log2 of the true error against the traits: networks of {} hidden neurons by quantile
//               loss; then, on as many other pairs of that stream, shifts such that what is chosen
//               keeps its word for 99 % of every class, family and decade of F
//   Evidence    other pairs: tests/cheapest_test.cpp, docs/ACCURACY.md
//
// The order is that of ErrorModel.
#pragma once
#include "urad/error_model.hpp"

namespace urad {{

// clang-format off
inline constexpr ErrorModels kErrorModels = {{
{}}};
// clang-format on

}}  // namespace urad
)",
      request.command, request.pairs,
      std::count_if(families.begin(), families.end(),
                    [](const TrialFamily& family) { return !family.test_only; }),
      urad::kErrorHidden, tables);
}

}  // namespace host
