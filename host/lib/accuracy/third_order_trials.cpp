#include "accuracy/third_order_trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "accuracy/error_training.hpp"
#include "accuracy/lopsided_pairs.hpp"
#include "accuracy/method_trials.hpp"
#include "accuracy/trial_pairs.hpp"
#include "base/parallel.hpp"
#include "base/quantile.hpp"
#include "form_factor/kernel.hpp"
#include "form_factor/reference.hpp"
#include "form_factor/third_order.hpp"
#include "network/random.hpp"
#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"

namespace host {

namespace {

constexpr double kLeastSkew = 1e-4;
constexpr double kWanted[] = {0.1, 0.03, 0.01, 0.003, 0.001};
constexpr double kHolds = 0.99;
constexpr int kGuessSteps = 8000;
constexpr double kThirdMacs = 2 * 33;  // 12 for four components, 3 for a square, 18 for sums
constexpr double kRho[] = {1e-4, 1e-3, 1e-2, 0.1, 0.35};  // of moments_do()

struct Off {
  double second = 0, third = 0;  // |K - exact| / exact
};

Off off_of(const Polygon& p, const Polygon& q, double exact) {
  const Moments i = moments(p), j = moments(q);
  const double second = second_order(i, j);
  const double third = third_order(i, third_moments(p, i), j, third_moments(q, j));
  const auto off = [&](double terms) { return std::fabs(bent_kernel(i, j, terms) / exact - 1); };
  return {off(second), off(second + third)};
}

/// What the kernel of one pair is off by, and what auto does about it.
struct Asked {
  ErrorSample second, graded, third;  // graded: second, and how lopsided the two are
  std::array<double, std::size(kWanted)> macs{};
};

float log2_off(double off) { return float(std::log2(std::clamp(off, 1e-6, 4.0))); }

/// Of a triangle about 0.3, of a parallelogram 0.
double skew(const Polygon& polygon) {
  const Moments m = moments(polygon);
  double sum = 0;
  for (const double value : third_moments(polygon, m).value) sum += std::fabs(value);
  return sum / std::pow(squared_size(m), 1.5);
}

/// Nothing for pairs that are cut or symmetric, or of which moments say nothing.
std::optional<Asked> ask(const PolygonPair& pair, double exact, const urad_net* net) {
  const FixedScene fixed = FixedScene::of_polygons({pair.p, pair.q}, {});
  const urad_scene& scene = fixed.pod();
  const urad::Patch i = urad::patch_at(scene, 0), j = urad::patch_at(scene, 1);
  urad::PairTraits traits;
  std::int32_t log2_g_q24 = 0;
  if (!urad::exchange_by(scene, i, j, urad::Way::kernel, nullptr, &log2_g_q24, &traits) ||
      traits.pair_class != urad::PairClass::lopsided || !urad::moments_do(traits))
    return std::nullopt;
  Asked asked;
  for (std::size_t t = 0; t < urad::kPairTraits; ++t)
    asked.second.trait[t] = asked.third.trait[t] = float(traits.log2_q8[t]) / 256;
  const Off off = off_of(pair.p, pair.q, exact);
  asked.second.error = log2_off(off.second), asked.third.error = log2_off(off.third);
  asked.graded = asked.second;
  asked.graded.trait[urad::trait_shapes] = asked.third.trait[urad::trait_shapes] =
      float(std::log2(skew(pair.p) + skew(pair.q) + kLeastSkew));
  for (std::size_t w = 0; w < std::size(kWanted); ++w) {
    urad_counters counters{};
    asked.macs[w] = auto_multiply_adds(
        urad::cheapest_exchange(scene, i, j, net,
                                std::int16_t(std::floor(256 * std::log2(kWanted[w]))), &counters),
        net);
  }
  return asked;
}

std::vector<Asked> asked_of(const std::vector<PolygonPair>& pairs, const std::vector<double>& exact,
                            const urad_net* net, int threads) {
  std::vector<std::optional<Asked>> all(pairs.size());
  parallel_for(pairs.size(), threads, [&](std::size_t k) {
    const double g = exact.empty() ? reference_exchange(pairs[k].p, pairs[k].q)
                                   : exact[k] * moments(pairs[k].p).area;
    all[k] = ask(pairs[k], g, net);
  });
  std::vector<Asked> asked;
  for (const auto& one : all)
    if (one) asked.push_back(*one);
  return asked;
}

/// Pairs of a kind, rho spread evenly over decades.
std::vector<Asked> asked_of(const PatchKind& kind, std::uint64_t seed, std::size_t count,
                            const urad_net* net, int threads) {
  std::vector<PolygonPair> pairs(count);
  parallel_for(count, threads, [&](std::size_t k) {
    Random random(seed, k);
    pairs[k] = draw_pair(kind, kRho[0], kRho[std::size(kRho) - 1], random);
  });
  return asked_of(pairs, {}, net, threads);
}

/// Pairs of a scene that has both kinds of patches.
std::vector<Asked> asked_of_scene(const char* name, std::uint64_t seed, std::size_t count,
                                  const urad_net* net, int threads) {
  const Scene scene = load_scene(name);
  Random random(seed);
  std::vector<PolygonPair> pairs;
  while (pairs.size() < count) {
    const ScenePatch& p = scene.patches[std::size_t(random.below(int(scene.patches.size())))];
    const ScenePatch& q = scene.patches[std::size_t(random.below(int(scene.patches.size())))];
    if (wholly_in_front(q.polygon, p.moments) && wholly_in_front(p.polygon, q.moments))
      pairs.push_back({p.polygon, q.polygon});
  }
  return asked_of(pairs, {}, net, threads);
}

/// A guess at the error that holds for 99 % of other pairs.
class Guess {
 public:
  Guess(const std::vector<Asked>& fit, const std::vector<Asked>& others, ErrorSample Asked::*kernel,
        std::uint64_t seed)
      : kernel_(kernel) {
    std::vector<ErrorSample> samples;
    samples.reserve(fit.size());
    for (const Asked& one : fit) samples.push_back(one.*kernel);
    model_ = train_error_model(samples, urad::kPairTraits, kHolds, seed, kGuessSteps);
    std::vector<double> off;
    off.reserve(others.size());
    for (const Asked& one : others) off.push_back(double((one.*kernel).error) - at(one));
    shift_ = quantile(off, kHolds);
  }
  bool below(const Asked& one, double error) const { return at(one) <= std::log2(error); }
  bool holds(const Asked& one, double error) const {
    return double((one.*kernel_).error) <= std::log2(error);
  }

 private:
  double at(const Asked& one) const {
    urad::PairTraits traits{};
    for (std::size_t t = 0; t < urad::kPairTraits; ++t)
      traits.log2_q8[t] = std::int16_t(std::lround(256 * (one.*kernel_).trait[t]));
    return urad::error_q8(model_, traits) / 256.0 + shift_;
  }
  ErrorSample Asked::*kernel_;
  urad::ErrorModel model_{};
  double shift_ = 0;
};

void judge(const std::string& family, const std::vector<Asked>& pairs, const Guess& two,
           const Guess& graded, const Guess& three, std::vector<ThirdOrderCost>* rows) {
  const double kernel = auto_multiply_adds({0, 0, urad::Way::kernel, 0}, nullptr) + kThirdMacs;
  for (std::size_t w = 0; w < std::size(kWanted); ++w) {
    ThirdOrderCost row{family, kWanted[w]};
    for (const Asked& one : pairs) {
      const double share = 1 / double(pairs.size());
      const bool by_two = two.below(one, row.error), by_three = three.below(one, row.error);
      row.two += by_two * share, row.three += by_three * share;
      row.held2 += (by_two && two.holds(one, row.error)) * share;
      row.held3 += (by_three && three.holds(one, row.error)) * share;
      row.macs2 += one.macs[w] * share;
      row.macs_graded += (graded.below(one, row.error) ? kernel - kThirdMacs : one.macs[w]) * share;
      row.macs3 += (by_three ? kernel : one.macs[w] + kThirdMacs) * share;
    }
    if (row.two > 0) row.held2 /= row.two;
    if (row.three > 0) row.held3 /= row.three;
    rows->push_back(row);
  }
}

}  // namespace

std::vector<ThirdOrderCost> try_third_moments_in_auto(std::uint64_t seed, std::size_t pairs,
                                                      const urad_net* net, int threads) {
  std::vector<Asked> fit, others;
  std::uint64_t stream = 256 * seed;
  for (const PatchKind& kind : kPatchKinds)
    for (std::vector<Asked>* set : {&fit, &others}) {
      const std::vector<Asked> more = asked_of(kind, ++stream, pairs, net, threads);
      set->insert(set->end(), more.begin(), more.end());
    }
  const Guess two(fit, others, &Asked::second, seed), graded(fit, others, &Asked::graded, seed),
      three(fit, others, &Asked::third, seed);
  std::vector<ThirdOrderCost> rows;
  for (const PatchKind& kind : kPatchKinds)
    if (!kind.symmetric)
      judge(kind.name, asked_of(kind, ++stream, pairs, net, threads), two, graded, three, &rows);
  for (const TrialFamily& family : trial_families()) {
    const PairSet set = trial_pairs(family, TrialUse::test, seed, pairs, threads);
    const std::vector<Asked> asked = asked_of(set.pairs, set.exact, net, threads);
    if (8 * asked.size() > pairs) judge(family.name, asked, two, graded, three, &rows);
  }
  judge("the Cornell box", asked_of_scene("cornell", ++stream, pairs, net, threads), two, graded,
        three, &rows);
  return rows;
}

std::string third_order_table(const std::vector<ThirdOrderCost>& rows) {
  std::string text =
      "| pairs | error asked for | by the kernel, two moments | three | of these within it | three "
      "| "
      "multiply-adds | told how lopsided | with three, told |\n| --- | ---: | ---: | ---: | ---: | "
      "---: | ---: | ---: | ---: |\n";
  for (const ThirdOrderCost& row : rows)
    text += fmt::format(
        "| {} | {:g} | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} % | {:.0f} | {:.0f} | {:.0f} |\n",
        row.family, row.error, 100 * row.two, 100 * row.three, 100 * row.held2, 100 * row.held3,
        row.macs2, row.macs_graded, row.macs3);
  return text;
}

std::vector<ThirdOrderRow> try_third_moments(std::uint64_t seed, std::size_t pairs, int threads) {
  std::vector<ThirdOrderRow> rows;
  for (const PatchKind& kind : kPatchKinds)
    for (std::size_t d = 0; d + 1 < std::size(kRho); ++d) {
      std::vector<double> second(pairs), third(pairs);
      parallel_for(pairs, threads, [&](std::size_t k) {
        Random random(16 * seed + rows.size(), k);
        const PolygonPair pair = draw_pair(kind, kRho[d], kRho[d + 1], random);
        const Off off = off_of(pair.p, pair.q, reference_exchange(pair.p, pair.q));
        second[k] = off.second, third[k] = off.third;
      });
      const auto within = [&](const std::vector<double>& off) {
        return double(std::count_if(off.begin(), off.end(), [](double x) { return x <= 0.01; })) /
               double(pairs);
      };
      rows.push_back({kind.name, kRho[d], kRho[d + 1], quantile(second, 0.5),
                      quantile(second, 0.95), within(second), quantile(third, 0.5),
                      quantile(third, 0.95), within(third)});
    }
  return rows;
}

std::string third_order_table(const std::vector<ThirdOrderRow>& rows) {
  std::string text =
      "| both patches are | rho | median, two moments | three | p95, two | three | within 1 %, two "
      "| three |\n| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const ThirdOrderRow& row : rows)
    text += fmt::format(
        "| {} | {:g} .. {:g} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.1f} % | {:.1f} % |\n",
        row.kind, row.least_rho, row.most_rho, row.median2, row.median3, row.p95_2, row.p95_3,
        100 * row.within2, 100 * row.within3);
  return text;
}

}  // namespace host
