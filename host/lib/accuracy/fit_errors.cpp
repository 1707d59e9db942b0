#include "accuracy/fit_errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "accuracy/trial_pairs.hpp"
#include "base/parallel.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"
#include "urad/lambert.hpp"

namespace host {

namespace {

using urad::kTraits;
using urad::Way;

constexpr double kQuantile = 0.99;
constexpr double kSlopeQuantile = 0.9;  // slopes follow the large errors, not the lucky ones
constexpr double kLeastError = 0x1p-24;
constexpr double kUsefulEstimate = -3;  // log2: estimates above 1/8 decide nothing
constexpr double kLeastEstimate = -12;  // below 1/4096 nobody asks
constexpr std::size_t kLeastGroup = 100;
constexpr double kNever = 100;  // log2 of the error of a way that was not seen to be right
constexpr double kRidge = 1e-4;
constexpr int kPasses = 40, kRounds = 6;
constexpr double kWanted[] = {-3, -5, -6.64, -8, -10};  // log2 of what auto may be asked for
constexpr double kFloor = -16;
constexpr double kDoubts[] = {-4, -7, -10, -13};

struct Row {
  std::array<double, kTraits> trait{};
  double error = 0;  // log2
  std::size_t family = 0;
  int decade = 0;
};

struct Fit {
  double base = 0;
  std::array<double, kTraits> weight{};
  double estimate(const Row& row) const {
    double sum = base;
    for (int k = 0; k < kTraits; ++k) sum += weight[std::size_t(k)] * row.trait[std::size_t(k)];
    return sum;
  }
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[std::size_t(std::lround(share * double(values.size() - 1)))];
}

/// Weighted least squares again and again, weights turned so that the sum of quantile losses falls
/// [iteratively reweighted: Schlossmacher 1973]. Families weigh the same.
Fit fit_slopes(const std::vector<Row>& rows, const std::vector<int>& traits) {
  std::map<std::size_t, double> count;
  for (const Row& row : rows) count[row.family] += 1;
  Fit fit;
  const auto n = Eigen::Index(traits.size() + 1);
  for (int pass = 0; pass < kPasses; ++pass) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    double all = 0;
    for (const Row& row : rows) {
      const double estimate = fit.estimate(row), off = row.error - estimate;
      double weight = 1 / count[row.family];
      if (pass > 0) {
        weight *= (off > 0 ? kSlopeQuantile : 1 - kSlopeQuantile) / std::max(std::fabs(off), 0.25);
        if (estimate > kUsefulEstimate || estimate < kLeastEstimate) weight *= 0.05;
      }
      Eigen::VectorXd x(n);
      x[0] = 1;
      for (Eigen::Index k = 1; k < n; ++k)
        x[k] = row.trait[std::size_t(traits[std::size_t(k - 1)])];
      normal += weight * x * x.transpose();
      right += weight * row.error * x;
      all += weight;
    }
    for (Eigen::Index k = 1; k < n; ++k) normal(k, k) += kRidge * all;
    const Eigen::VectorXd solution = normal.ldlt().solve(right);
    fit.base = solution[0];
    for (Eigen::Index k = 1; k < n; ++k)
      fit.weight[std::size_t(traits[std::size_t(k - 1)])] = solution[k];
  }
  return fit;
}

struct Trial {
  PolygonPair pair;
  double exact = 0;
  std::size_t family = 0;
};

/// What one way makes of every pair; a refined sum at each of kDoubts.
struct Seen {
  Row row;
  int pair_class = -1;  ///< -1: nothing
};
using WaySeen = std::vector<std::vector<Seen>>;  // [stop][trial]

WaySeen see(const std::vector<Trial>& trials, Way way, const ErrorFitRequest& request) {
  const std::size_t stops = way == Way::refined ? std::size(kDoubts) : 1;
  WaySeen seen(stops, std::vector<Seen>(trials.size()));
  parallel_for(trials.size(), request.threads, [&](std::size_t k) {
    const Trial& trial = trials[k];
    const FixedScene scene = FixedScene::of_polygons({trial.pair.p, trial.pair.q}, {});
    const urad::Patch p = urad::patch_at(scene.pod(), 0), q = urad::patch_at(scene.pod(), 1);
    for (std::size_t stop = 0; stop < stops; ++stop) {
      urad::PairTraits traits;
      std::int32_t log2_g_q24 = 0;
      if (!urad::exchange_by(scene.pod(), p, q, way, request.net,
                             std::int32_t(kDoubts[stop] * 0x1p24), &log2_g_q24, &traits))
        continue;
      Seen& one = seen[stop][k];
      one.pair_class = int(traits.pair_class);
      const double f = std::exp2((log2_g_q24 - p.shape->log2_area_q24) * 0x1p-24);
      one.row.error = std::log2(std::max(std::fabs(f / trial.exact - 1), kLeastError));
      one.row.family = trial.family;
      one.row.decade = trial_decade(trial.exact);
      for (std::size_t t = 0; t < kTraits; ++t) one.row.trait[t] = traits.log2_q8[t] / 256.0;
    }
  });
  return seen;
}

std::vector<Row> rows_of(const WaySeen& seen, int pair_class) {
  std::vector<Row> rows;
  for (const auto& stop : seen)
    for (const Seen& one : stop)
      if (one.pair_class == pair_class) rows.push_back(one.row);
  return rows;
}

/// Fits of one class of pairs.
struct Models {
  std::array<Fit, urad::kWays> way;
  std::array<Fit, urad::kWays> before;  ///< of four and nine points, before their doubt is known
};

/// Error less estimate of the pairs that a way is chosen for.
class Residuals {
 public:
  void add(const Row& row, double estimate) {
    const double off = row.error - estimate;
    all_.push_back(off);
    groups_[{row.family, -1}].push_back(off);
    groups_[{row.family, row.decade}].push_back(off);
  }
  /// What the base must rise by so that the estimate covers its share of every family and decade.
  double shift() const {
    if (all_.size() < kLeastGroup) return 0;
    double shift = quantile(all_, kQuantile);
    for (const auto& [key, off] : groups_)
      if (off.size() >= kLeastGroup) shift = std::max(shift, quantile(off, kQuantile));
    return shift;
  }

 private:
  std::vector<double> all_;
  std::map<std::pair<std::size_t, int>, std::vector<double>> groups_;
};

/// Chooses ways as the engine does and moves the bases until the estimates of what is chosen hold:
/// choosing the lowest estimate favours those that are too low.
void calibrate(const std::array<WaySeen, urad::kWays>& seen, int pair_class, bool refined,
               Models* models) {
  std::array<Residuals, urad::kWays> residuals;
  const auto chosen = [&](std::size_t k, double wanted) {
    for (std::size_t w = std::size_t(Way::kernel); w < std::size_t(Way::refined); ++w) {
      if (w == std::size_t(Way::network) && pair_class == int(urad::PairClass::cut)) continue;
      const bool sums = w >= std::size_t(Way::four_points);
      const Seen& one = seen[w].front()[k];
      if (one.pair_class < 0 || (sums && models->before[w].estimate(one.row) > wanted)) continue;
      const double estimate = models->way[w].estimate(one.row);
      if (estimate > wanted) continue;
      residuals[w].add(one.row, std::max(estimate, kFloor));
      return true;
    }
    return false;
  };
  for (std::size_t k = 0; k < seen[1].front().size(); ++k) {
    if (seen[1].front()[k].pair_class != pair_class) continue;
    bool open = false;
    for (const double wanted : kWanted) open = !chosen(k, wanted) || open;
    if (!open || !refined) continue;
    for (const auto& stop : seen[std::size_t(Way::refined)]) {
      const double estimate = models->way[std::size_t(Way::refined)].estimate(stop[k].row);
      if (stop[k].pair_class >= 0 && estimate > kLeastEstimate && estimate < kUsefulEstimate)
        residuals[std::size_t(Way::refined)].add(stop[k].row, estimate);
    }
  }
  for (std::size_t w = 1; w < urad::kWays; ++w) models->way[w].base += residuals[w].shift();
}

std::vector<int> traits_of(Way way, bool before) {
  using namespace urad;
  if (way == Way::refined) return {trait_rho, trait_cosine_least, trait_fill, trait_doubt};
  std::vector<int> traits{trait_bend_sum, trait_rho, trait_cosine_least, trait_cosine_most,
                          trait_fill};
  if (way == Way::kernel || way == Way::network) {
    traits.push_back(trait_bend);
  } else {
    traits.push_back(trait_size);
    traits.push_back(trait_slant);
  }
  if (way >= Way::four_points && !before) traits.push_back(trait_doubt);
  return traits;
}

/// Whether the way has enough pairs that it may be good for.
bool ever_right(const std::vector<Row>& rows, const Fit& fit) {
  return std::size_t(std::count_if(rows.begin(), rows.end(), [&](const Row& row) {
           return fit.estimate(row) < kWanted[0];
         })) >= kLeastGroup;
}

std::string text_of(const Fit& fit) {
  const auto q8 = [](double x) { return std::clamp(std::lround(x * 256), -32767L, 32767L); };
  std::vector<long> weights;
  for (const double w : fit.weight) weights.push_back(q8(w));
  return fmt::format("{{{}, {{{}}}}}", q8(fit.base), fmt::join(weights, ", "));
}

}  // namespace

std::string fitted_error_models(const ErrorFitRequest& request) {
  std::vector<Trial> trials;
  const std::vector<TrialFamily> families = trial_families();
  int fitted = 0;
  for (std::size_t f = 0; f < families.size(); ++f) {
    if (families[f].test_only) continue;
    ++fitted;
    const PairSet set =
        trial_pairs(families[f], TrialUse::fit, request.seed, request.pairs, request.threads);
    for (std::size_t k = 0; k < set.pairs.size(); ++k)
      trials.push_back({set.pairs[k], set.exact[k], f});
  }
  std::array<WaySeen, urad::kWays> seen;
  for (std::size_t w = 1; w < urad::kWays; ++w) seen[w] = see(trials, static_cast<Way>(w), request);
  std::array<Models, urad::kPairClasses> models;
  for (int c = 0; c < urad::kPairClasses; ++c) {
    Models& of_class = models[std::size_t(c)];
    for (std::size_t w = 1; w < urad::kWays; ++w) {
      const auto way = static_cast<Way>(w);
      const std::vector<Row> rows = rows_of(seen[w], c);
      of_class.way[w] = fit_slopes(rows, traits_of(way, false));
      if (!ever_right(rows, of_class.way[w])) of_class.way[w] = {kNever, {}};
      if (way == Way::four_points || way == Way::nine_points)
        of_class.before[w] = fit_slopes(rows, traits_of(way, true));
    }
    for (int round = 0; round < kRounds; ++round)
      calibrate(seen, c, round + 1 == kRounds, &of_class);
  }
  constexpr const char* kNames[] = {"none",        "kernel",      "network", "point",
                                    "four points", "nine points", "refined"};
  std::string table = "    {},  // none\n", before;
  std::vector<long> inverse;
  for (std::size_t w = 1; w < urad::kWays; ++w) {
    const bool sums = w == std::size_t(Way::four_points) || w == std::size_t(Way::nine_points);
    table += fmt::format("    {{  // {}\n", kNames[w]);
    if (sums) before += "    {\n";
    for (const Models& of_class : models) {
      table += fmt::format("        {},\n", text_of(of_class.way[w]));
      if (sums) before += fmt::format("        {},\n", text_of(of_class.before[w]));
    }
    table += "    },\n";
    if (sums) before += "    },\n";
  }
  for (const Models& of_class : models)
    inverse.push_back(
        std::lround(256 / of_class.way[std::size_t(Way::refined)].weight[urad::trait_doubt]));
  return fmt::format(
      R"(// cheapest_models.hpp -- what each way to a form factor is off by: constants for cheapest.hpp.
//
//   Written by  {}
//   Pairs       {} of each of {} families (accuracy/trial_pairs.hpp), stream TrialUse::fit
//   Fit         log2 of the true error against the traits: quantile regression for the slopes, then
//               bases such that the estimate holds for 99 % of every family and every decade of F
//               among the pairs for which the way is chosen
//   Evidence    other pairs: tests/cheapest_test.cpp
//
// An entry is base and weights in the order of Trait; a row is a PairClass.
#pragma once
#include "urad/cheapest.hpp"

namespace urad {{

struct ErrorModel {{
  int16_t base_q8;
  int16_t weight_q8[kTraits];
}};

/// By way, then by class of pair.
inline constexpr ErrorModel kErrorModel[kWays][kPairClasses] = {{
{}}};

/// Guesses at four and nine points before they are computed: about as often too low as too high.
inline constexpr ErrorModel kErrorBefore[2][kPairClasses] = {{
{}}};

/// 1 / weight of the doubt of a refined sum.
inline constexpr int16_t kRefinedInverse_q8[kPairClasses] = {{{}}};

/// Rounding: of a kernel relative to itself; of a sum relative to a factor of 1.
inline constexpr int16_t kKernelFloor_q8 = -16 * 256, kSumRounding_q8 = -31 * 256;

}}  // namespace urad
)",
      request.command, request.pairs, fitted, table, before, fmt::join(inverse, ", "));
}

}  // namespace host
