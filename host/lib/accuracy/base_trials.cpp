#include "accuracy/base_trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/parallel.hpp"
#include "form_factor/area_rule.hpp"
#include "form_factor/kernel.hpp"
#include "form_factor/lambert.hpp"
#include "form_factor/reference.hpp"
#include "form_factor/third_order.hpp"
#include "network/engine_pair.hpp"
#include "network/train_net.hpp"
#include "scene/fixed_scene.hpp"

namespace host {

namespace {

enum Base : std::size_t { moments2, moments3, points16, polygon1, polygon4, kBases };
enum Extra { none, third, by_points };

// Multiply-adds, by the formulas that docs/METHODS.md counts with.
constexpr double kBaseMacs[] = {55, 55 + 66, 16 * 13, 144, 4 * 144};
constexpr double net_macs(int inputs, int hidden) { return 60 + hidden * (inputs + 1) + inputs; }

constexpr std::size_t kPairs[] = {20000, 8000, 4000, 6000, 14000, 8000};  // of each PairFamily
constexpr double kWeight[] = {0.25, 0.20, 0.06, 0.12, 0.27, 0.10};
constexpr double kRange[][2] = {{0.01, kGeneralNearRho}, {kGeneralNearRho, 1}};

struct Way {
  const char* name;
  Base base;
  int hidden;
  Extra extra;
};
constexpr Way kWays[] = {
    {"moment kernel", moments2, 0, none},
    {"with third moments", moments3, 0, none},
    {"16 pairs of points", points16, 0, none},
    {"exact sum at 1 point", polygon1, 0, none},
    {"exact sum at 2 x 2 points", polygon4, 0, none},
    {"moment kernel, 4 hidden", moments2, 4, none},
    {"moment kernel, 8 hidden", moments2, 8, none},
    {"moment kernel, 12 hidden", moments2, 12, none},
    {"moment kernel, 18 hidden", moments2, 18, none},
    {"with third moments, 4 hidden", moments3, 4, none},
    {"with third moments, 8 hidden", moments3, 8, none},
    {"T3 as an input, 8 hidden", moments2, 8, third},
    {"with third moments and T3 as an input, 8 hidden", moments3, 8, third},
    {"16 pairs of points, 8 hidden", points16, 8, none},
    {"16 pairs of points by the kernel as an input, 8 hidden", points16, 8, by_points},
};

/// Exchange by Gauss points, 2 x 2 on each.
double sixteen(const Polygon& p, const Polygon& q, const Moments& i, const Moments& j) {
  double sum = 0;
  const std::vector<AreaPoint> on_q = area_points(q, 2);
  for (const AreaPoint& a : area_points(p, 2))
    for (const AreaPoint& b : on_q) {
      const Vec3 r = b.x - a.x;
      const double r2 = glm::dot(r, r);
      sum += a.area * b.area * std::max(0.0, glm::dot(i.normal, r)) *
             std::max(0.0, -glm::dot(j.normal, r)) / (r2 * r2);
    }
  return sum / 3.14159265358979323846;
}

/// A pair with what every base makes of it: log2 of exact over base.
struct Known {
  Sample sample;
  std::array<double, kBases> target{};
  std::int16_t third_q15 = 0, points_q15 = 0;
};

std::int16_t q15(double x) { return std::int16_t(std::lround(32767 * std::clamp(x, -1.0, 1.0))); }

std::optional<Known> known(const PolygonPair& pair, const double (&range)[2]) {
  const FixedScene fixed = FixedScene::of_polygons({pair.p, pair.q}, {});
  const auto engine = engine_pair(fixed.pod(), 0, 1);
  if (!engine || engine->clipped || engine->rho() < range[0] || engine->rho() >= range[1])
    return std::nullopt;
  const Moments i = moments(pair.p), j = moments(pair.q);
  const double exact = reference_exchange(pair.p, pair.q);
  if (!(exact > 0)) return std::nullopt;
  const double t2 = second_order(i, j);
  const double t3 = third_order(i, third_moments(pair.p, i), j, third_moments(pair.q, j));
  // The smaller patch carries the points, as in the engine.
  const bool first = i.area < j.area;
  const auto sum = [&](int n) {
    return lambert_exchange(first ? pair.p : pair.q, first ? pair.q : pair.p, n);
  };
  const double base[] = {bent_kernel(i, j, t2), bent_kernel(i, j, t2 + t3),
                         sixteen(pair.p, pair.q, i, j), sum(1), sum(2)};
  Known one;
  for (std::size_t b = 0; b < kBases; ++b) {
    if (!(base[b] > 0)) return std::nullopt;
    one.target[b] = std::log2(exact / base[b]);
  }
  std::copy_n(engine->invariants.input_q15, urad::kPairInputs, one.sample.input_q15.begin());
  one.sample.gate_uq16 = engine->invariants.gate_uq16;
  one.third_q15 = q15(t3 / (1 + std::fabs(t3)));
  one.points_q15 = q15(std::log2(base[points16] / base[moments2]) / 4);
  return one;
}

struct Sets {
  std::vector<Known> training, validation, test;
  std::size_t free_tests = 0;  ///< the first so many of `test`
};

std::vector<Known> known_of(std::size_t family, PairUse use, const double (&range)[2],
                            const BaseTrialRequest& request, std::uint64_t seed) {
  const double share = use == PairUse::training ? 1 : 0.125;
  const auto count = std::size_t(double(kPairs[family]) * share * request.effort);
  std::vector<std::optional<Known>> all(count);
  parallel_for(count, request.threads, [&](std::size_t k) {
    all[k] = known(general_pair(PairFamily(family), general_seed(seed, use), k), range);
  });
  std::vector<Known> kept;
  for (const auto& one : all)
    if (one) kept.push_back(*one);
  for (Known& one : kept) one.sample.weight = kWeight[family] / double(kept.size());
  return kept;
}

Sets sets_of(const double (&range)[2], const BaseTrialRequest& request, std::uint64_t seed) {
  Sets sets;
  for (std::size_t family = 0; family < kPairFamilies; ++family)
    for (const PairUse use : {PairUse::training, PairUse::validation, PairUse::test}) {
      std::vector<Known>& set = use == PairUse::training     ? sets.training
                                : use == PairUse::validation ? sets.validation
                                                             : sets.test;
      const std::vector<Known> more = known_of(family, use, range, request, seed);
      set.insert(set.end(), more.begin(), more.end());
      if (family == 0 && use == PairUse::test) sets.free_tests = set.size();
    }
  return sets;
}

Sample sample_of(const Known& one, const Way& way) {
  Sample sample = one.sample;
  sample.target = one.target[way.base];
  if (way.extra != none) sample.more_q15 = way.extra == third ? one.third_q15 : one.points_q15;
  return sample;
}

int inputs_of(const Way& way) { return urad::kPairInputs + (way.extra != none); }

TrainingSet set_of(const std::vector<Known>& known, const Way& way) {
  TrainingSet set;
  set.inputs = inputs_of(way);
  for (const Known& one : known) set.samples.push_back(sample_of(one, way));
  return set;
}

/// |F - exact| / exact of the pairs held out.
std::vector<double> errors_of(const Sets& sets, const Way& way, const BaseTrialRequest& request,
                              std::uint64_t seed) {
  std::optional<FloatNet> net;
  if (way.hidden > 0) {
    TrainRequest general;
    general.hidden = way.hidden;
    general.seed = seed;
    general.effort = request.effort;
    general.threads = request.threads;
    net =
        train(set_of(sets.training, way), set_of(sets.validation, way), general_settings(general));
  }
  std::vector<double> errors;
  for (const Known& one : sets.test) {
    const Sample sample = sample_of(one, way);
    std::array<std::int16_t, urad::kPairInputs + 1> input_q15{};
    std::copy(sample.input_q15.begin(), sample.input_q15.end(), input_q15.begin());
    input_q15.back() = sample.more_q15;
    const double said = net ? sample.gate() * net->run(input_q15.data()) : 0;
    errors.push_back(std::fabs(std::exp2(said - sample.target) - 1));
  }
  return errors;
}

void add(std::vector<double> errors, BaseTrial* trial) {
  std::sort(errors.begin(), errors.end());
  const auto at = [&](double share) {
    return errors.empty() ? 0 : errors[std::size_t(std::lround(share * double(errors.size() - 1)))];
  };
  trial->median.push_back(at(0.5)), trial->p95.push_back(at(0.95)), trial->p99.push_back(at(0.99));
}

double macs_of(const Way& way) {
  const double kernel = way.extra == by_points ? kBaseMacs[moments2] : 0;
  const double t3 = way.extra == third && way.base == moments2 ? 66 : 0;
  const double base = kBaseMacs[way.base] + kernel + t3;
  return way.hidden > 0 ? base + net_macs(inputs_of(way), way.hidden) : base;
}

}  // namespace

std::vector<BaseTrials> try_bases(const BaseTrialRequest& request) {
  std::vector<BaseTrials> all;
  for (const auto& range : kRange) {
    BaseTrials trials{range[0], range[1], {}, {}};
    for (const Way& way : kWays)
      for (auto* set : {&trials.free_quads, &trials.all})
        set->push_back({way.name, macs_of(way), {}, {}, {}});
    for (const std::uint64_t seed : request.seeds) {
      const Sets sets = sets_of(range, request, seed);
      trials.least_quads = seed == request.seeds.front()
                               ? sets.free_tests
                               : std::min(trials.least_quads, sets.free_tests);
      for (std::size_t w = 0; w < std::size(kWays); ++w) {
        const std::vector<double> errors = errors_of(sets, kWays[w], request, seed);
        add({errors.begin(), errors.begin() + std::ptrdiff_t(sets.free_tests)},
            &trials.free_quads[w]);
        add(errors, &trials.all[w]);
      }
    }
    all.push_back(std::move(trials));
  }
  return all;
}

std::string base_table(const std::vector<BaseTrials>& trials) {
  const auto worst = [](const std::vector<double>& seeds) {
    return *std::max_element(seeds.begin(), seeds.end());
  };
  constexpr std::size_t kEnough = 200;  // for a p99
  std::string text =
      "| way | rho | multiply-adds | free quads: median | p95 | p99 | all families: median | p95 | "
      "p99 |\n| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const BaseTrials& range : trials)
    for (std::size_t w = 0; w < range.all.size(); ++w) {
      const BaseTrial &quads = range.free_quads[w], &all = range.all[w];
      const std::string free = range.least_quads < kEnough
                                   ? "- | - | -"
                                   : fmt::format("{:.2g} | {:.2g} | {:.2g}", worst(quads.median),
                                                 worst(quads.p95), worst(quads.p99));
      text += fmt::format("| {} | {:g} .. {:g} | {:.0f} | {} | {:.2g} | {:.2g} | {:.2g} |\n",
                          all.name, range.least_rho, range.most_rho, all.multiply_adds, free,
                          worst(all.median), worst(all.p95), worst(all.p99));
    }
  return text;
}

}  // namespace host
