#include "accuracy/third_order_trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

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

constexpr double kWanted[] = {0.1, 0.03, 0.01, 0.003, 0.001};
constexpr double kHolds = 0.99;
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

/// What auto makes of a pair at one error asked for.
struct Found {
  double macs = 0, macs_without_kernel = 0;
  bool by_kernel = false, computed = false, holds = false;
};

/// A pair, by the kernel without third moments and by auto.
struct Asked {
  double off = 0, said = 0;  // log2, of the kernel
  std::array<Found, std::size(kWanted)> found{};
};

double log2_off(double off) { return std::log2(std::clamp(off, 1e-6, 4.0)); }

/// The engine's constants, with a guess at the kernel that nobody accepts.
const urad::ErrorModels& without_kernel() {
  static const urad::ErrorModels models = [] {
    urad::ErrorModels never = urad::error_models();
    for (std::int16_t& shift : never.kernel.shift_q8) shift = INT16_MAX;
    return never;
  }();
  return models;
}

/// Nothing for pairs that are cut or symmetric, or of which moments say nothing.
std::optional<Asked> ask(const PolygonPair& pair, double exact, const urad_net* net) {
  const FixedScene fixed = FixedScene::of_polygons({pair.p, pair.q}, {});
  const urad_scene& scene = fixed.pod();
  const urad::Patch i = urad::patch_at(scene, 0), j = urad::patch_at(scene, 1);
  const auto off = [&](std::int32_t log2_g_q24) {
    const double f = std::exp2((log2_g_q24 - i.shape->log2_area_q24) * 0x1p-24);
    return log2_off(std::fabs(f / exact - 1));
  };
  urad::PairTraits traits;
  std::int32_t log2_g_q24 = 0;
  if (!urad::exchange_by(scene, i, j, urad::Way::kernel, nullptr, &log2_g_q24, &traits) ||
      traits.pair_class != urad::PairClass::lopsided || !urad::moments_do(traits))
    return std::nullopt;
  Asked asked{off(log2_g_q24), urad::error_q8(urad::error_models().kernel, traits) / 256.0, {}};
  for (std::size_t w = 0; w < std::size(kWanted); ++w) {
    urad_counters counters{};
    const auto by = [&](const urad::ErrorModels& models) {
      return urad::cheapest_exchange(models, scene, i, j, net,
                                     std::int16_t(std::floor(256 * std::log2(kWanted[w]))),
                                     &counters);
    };
    const urad::CheapestPair found = by(urad::error_models());
    asked.found[w] = {auto_multiply_adds(found, net), auto_multiply_adds(by(without_kernel()), net),
                      found.way == urad::Way::kernel, found.cubics > 0,
                      off(found.log2_exchange_q24) <= found.log2_error_q8 / 256.0};
  }
  return asked;
}

std::vector<Asked> asked_of(const std::vector<PolygonPair>& pairs, const std::vector<double>& exact,
                            const urad_net* net, int threads) {
  std::vector<std::optional<Asked>> all(pairs.size());
  parallel_for(pairs.size(), threads, [&](std::size_t k) {
    const Polygon &p = pairs[k].p, &q = pairs[k].q;
    all[k] =
        ask(pairs[k], exact.empty() ? reference_exchange(p, q) / moments(p).area : exact[k], net);
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

void judge(const std::string& family, const std::vector<Asked>& pairs, double moved,
           std::vector<ThirdOrderCost>* rows) {
  const double kernel = auto_multiply_adds({0, 0, urad::Way::kernel, 0, 0}, nullptr);
  for (std::size_t w = 0; w < std::size(kWanted); ++w) {
    ThirdOrderCost row{family, kWanted[w]};
    for (const Asked& one : pairs) {
      const double share = 1 / double(pairs.size());
      const Found& found = one.found[w];
      const bool by_two = one.said + moved <= std::log2(row.error);
      row.two += by_two * share, row.three += found.by_kernel * share;
      row.computed += found.computed * share;
      row.held2 += (by_two && one.off <= one.said + moved) * share;
      row.held3 += (found.by_kernel && found.holds) * share;
      row.macs2 += (by_two ? kernel : found.macs_without_kernel) * share;
      row.macs3 += found.macs * share;
    }
    if (row.two > 0) row.held2 /= row.two;
    if (row.three > 0) row.held3 /= row.three;
    rows->push_back(row);
  }
}

}  // namespace

std::vector<ThirdOrderCost> try_third_moments_in_auto(std::uint64_t seed, std::size_t pairs,
                                                      const urad_net* net, int threads) {
  std::uint64_t stream = 256 * seed;
  std::vector<double> unsaid;
  for (const PatchKind& kind : kPatchKinds)
    for (const Asked& one : asked_of(kind, ++stream, pairs, net, threads))
      unsaid.push_back(one.off - one.said);
  const double moved = quantile(unsaid, kHolds);
  std::vector<ThirdOrderCost> rows;
  for (const PatchKind& kind : kPatchKinds)
    if (!kind.symmetric)
      judge(kind.name, asked_of(kind, ++stream, pairs, net, threads), moved, &rows);
  for (const TrialFamily& family : trial_families()) {
    const PairSet set = trial_pairs(family, TrialUse::test, seed, pairs, threads);
    const std::vector<Asked> asked = asked_of(set.pairs, set.exact, net, threads);
    if (8 * asked.size() > pairs) judge(family.name, asked, moved, &rows);
  }
  judge("the Cornell box", asked_of_scene("cornell", ++stream, pairs, net, threads), moved, &rows);
  return rows;
}

std::string third_order_table(const std::vector<ThirdOrderCost>& rows) {
  std::string text =
      "| pairs | error asked for | by the kernel, two moments | three | third moments computed | "
      "guesses hold, two | three | multiply-adds, two | three | saved |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const ThirdOrderCost& row : rows)
    text += fmt::format(
        "| {} | {:g} | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} % | {:.0f} | {:.0f} | "
        "{:.1f} % |\n",
        row.family, row.error, 100 * row.two, 100 * row.three, 100 * row.computed, 100 * row.held2,
        100 * row.held3, row.macs2, row.macs3, 100 * (1 - row.macs3 / row.macs2));
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
