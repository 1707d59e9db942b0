#include "accuracy/method_trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/quantile.hpp"
#include "method/engine_source.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"
#include "urad/lambert.hpp"

namespace host {

namespace {

constexpr double kLeastError = 1e-9;  // of the reference, at most

// Multiply-adds of one pair, from the formulas.
constexpr double kCentreMacs = 13, kMomentMacs = 55, kInputMacs = 60;
// Of the network that icount.json counts, cube7: 4 hidden neurons, 14 inputs and what makes them.
constexpr double kCountedNetMacs = 4 * 15 + 14 + kInputMacs;
constexpr double kPointMacs = 4 * 31 + 20;  // four edges, and the place of the point
constexpr double kCubicMacs = 14;             // 12, and 2 for its weight

/// What a method made of one pair.
struct One {
  double exact = 0, f = 0, ns = 0;
  std::optional<double> multiply_adds, instructions, estimate;
  urad::Way way = urad::Way::none;
};

double net_macs(const urad_net& net) {
  return kMomentMacs + kInputMacs + net.hidden * (net.inputs + 1) + net.inputs;
}

/// What the engine did for a pair.
struct Work {
  const urad_net* net = nullptr;  ///< run on it, or none
  double points = 0;              ///< of exact sums
  double guesses = 0;             ///< multiply-adds of the guesses at errors
};

double legacy_macs(const urad_legacy_net& net) { return net.hidden * (24 + 1); }

std::optional<double> multiply_adds(const TableMethod& method, const Work& work) {
  const std::string& name = method.spec.name;
  if (name == "kernel" || name == "fixed-kernel") return kCentreMacs;
  if (name == "moment" || name == "fixed-moment") return kMomentMacs;
  if (name == "lambert") return kPointMacs * std::pow(method.spec.number(1, 1, 32), 2);
  if (name == "gauss") return kCentreMacs * std::pow(method.spec.number(2, 1, 32), 4);
  if (name == "contour") return 16 * 6 * std::pow(method.spec.number(2, 1, 32), 2);
  if (name == "legacy") return legacy_macs(method.nets.find_legacy(method.spec.argument));
  if (name == "fixed-lambert") return kPointMacs * work.points;
  if (name == "net" || name == "auto")
    return (work.net ? net_macs(*work.net) : kMomentMacs) + kPointMacs * work.points + work.guesses;
  return std::nullopt;
}

std::optional<double> instructions(const TableMethod& method, const InstructionCounts& counts,
                                   const Work& work) {
  const std::string& name = method.spec.name;
  if (name != "auto" && name != "fixed-lambert" && name != "net")
    return counts.per_pair(method.spec.text());
  const auto moment = counts.per_pair("fixed-moment"), net = counts.per_pair("net");
  const auto point = counts.per_point();
  if (!moment || !net || !point) return std::nullopt;
  const double kernel = name == "fixed-lambert" ? 0 : work.net ? *net : *moment;
  // A guess is charged what a network's multiply-add costs with all that goes with it.
  const double per_mac = (*net - *moment) / kCountedNetMacs;
  return kernel + *point * work.points + per_mac * work.guesses;
}

double points_of(const urad_scene& scene, const urad::Patch& p, const urad::Patch& q, int points) {
  std::uint32_t sums = 0;
  urad::lambert_exchange_log2_q24(scene, p, q, points, &sums);
  return sums;
}

/// Whether a network leaves the pair to the exact sum.
bool hands_over(const urad_scene& scene, const urad::Patch& p, const urad::Patch& q,
                const urad_net& net) {
  urad_counters counters{};
  urad::exchange_log2_q24(scene, p, q, urad::Kernel::moment, &net, 0, &counters);
  return counters.near_pairs > 0;
}

/// Multiply-adds of the guesses that led to a way: one before each, one after each sum.
double guess_macs(const urad::CheapestPair& pair) {
  const auto macs = [](int traits) { return double(urad::kErrorHidden * (traits + 1) + traits); };
  const double before = std::min(int(pair.way), 4), sums = pair.way >= urad::Way::four_points;
  const double halvings = pair.way == urad::Way::refined ? pair.point_sums / 18.0 : 0;
  return before * macs(urad::kPairTraits) + (sums + halvings) * macs(urad::kTraits);
}

}  // namespace

double auto_multiply_adds(const urad::CheapestPair& pair, const urad_net* net) {
  const bool by_net = pair.way == urad::Way::network;
  return (by_net ? net_macs(*net) : kMomentMacs) + kCubicMacs * pair.cubics +
         kPointMacs * pair.point_sums + guess_macs(pair);
}

namespace {

/// What auto thought of the pair.
void judge(const TableMethod& method, const urad_scene& scene, const urad::Patch& p,
           const urad::Patch& q, One* one, Work* work) {
  urad_counters counters{};
  const urad::CheapestPair pair = urad::cheapest_exchange(scene, p, q, method.nets.general(),
                                                          auto_error_q8(method.spec), &counters);
  // F as it is delivered, rounded to 32 bits.
  one->estimate =
      std::exp2(pair.log2_error_q8 / 256.0) + (one->f > 0 ? 0.5 / 4294967296.0 / one->f : 1);
  one->way = pair.way;
  work->points = pair.point_sums;
  work->guesses = guess_macs(pair);
  if (pair.way == urad::Way::network) work->net = method.nets.general();
}

std::vector<One> try_one(const PairSet& set, const TableMethod& method,
                         const TrialRequest& request) {
  const MethodValues values = method_values(set, method);
  const bool is_auto = method.spec.name == "auto";
  std::vector<One> result(set.pairs.size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    One& one = result[k];
    one = {set.exact[k], values.f[k], values.ns / double(result.size()), {}, {}, {}, {}};
    Work work;
    const bool is_net = method.spec.name == "net";
    if (is_net) work.net = &method.nets.find(method.spec.argument);
    if (is_auto || is_net || method.spec.name == "fixed-lambert") {
      const FixedScene scene = FixedScene::of_polygons({set.pairs[k].p, set.pairs[k].q}, {});
      const urad::Patch p = urad::patch_at(scene.pod(), 0), q = urad::patch_at(scene.pod(), 1);
      if (is_auto)
        judge(method, scene.pod(), p, q, &one, &work);
      else if (!is_net || hands_over(scene.pod(), p, q, *work.net))
        work.points = points_of(scene.pod(), p, q,
                                is_net ? urad::kHandOverPoints : method.spec.number(3, 1, 4));
    }
    one.multiply_adds = multiply_adds(method, work);
    if (request.instructions) one.instructions = instructions(method, *request.instructions, work);
  }
  return result;
}

MethodTrialRow row_of(const std::string& label, const std::vector<One>& ones) {
  MethodTrialRow row;
  row.label = label;
  row.pairs = ones.size();
  std::vector<double> errors, by_error;
  double missed = 0, macs = 0, counted = 0;
  for (const One& one : ones) {
    const double error = one.f / one.exact - 1;
    errors.push_back(std::fabs(error));
    row.bias += error / double(ones.size());
    row.ns += one.ns / double(ones.size());
    macs += one.multiply_adds.value_or(0) / double(ones.size());
    counted += one.instructions.value_or(0) / double(ones.size());
    if (!one.estimate) continue;
    missed += std::fabs(error) > *one.estimate;
    by_error.push_back(*one.estimate / std::max(std::fabs(error), kLeastError));
  }
  std::sort(errors.begin(), errors.end());
  std::sort(by_error.begin(), by_error.end());
  row.median = quantile_of_sorted(errors, 0.5), row.p95 = quantile_of_sorted(errors, 0.95);
  row.p99 = quantile_of_sorted(errors, 0.99), row.max = quantile_of_sorted(errors, 1);
  if (!ones.empty() && ones.front().multiply_adds) row.multiply_adds = macs;
  if (!ones.empty() && ones.front().instructions) row.instructions = counted;
  if (!by_error.empty()) {
    row.estimate = {missed / double(by_error.size()), quantile_of_sorted(by_error, 0.5),
                    quantile_of_sorted(by_error, 0.9)};
  }
  return row;
}

std::string ways_of(const std::string& family, const std::string& label,
                    const std::vector<One>& ones) {
  constexpr const char* kNames[] = {"none",        "kernel",      "network", "point",
                                    "four points", "nine points", "refined"};
  std::array<double, urad::kWays> share{};
  for (const One& one : ones) share[std::size_t(one.way)] += 100 / double(ones.size());
  std::string line = fmt::format("| {} | {} |", family, label);
  for (std::size_t w = 1; w < share.size(); ++w) line += fmt::format(" {:.0f} |", share[w]);
  static_assert(std::size(kNames) == urad::kWays);
  return line;
}

/// The pairs that a method can be asked for: a network of the report reads four vertices.
PairSet readable(PairSet set, const TableMethod& method) {
  if (method.spec.name != "legacy") return set;
  const auto few = [](const Polygon& p) { return p.outer.size() <= 4 && p.holes.empty(); };
  PairSet kept{set.name, {}, {}};
  for (std::size_t k = 0; k < set.pairs.size(); ++k) {
    if (!few(set.pairs[k].p) || !few(set.pairs[k].q)) continue;
    kept.pairs.push_back(std::move(set.pairs[k]));
    kept.exact.push_back(set.exact[k]);
  }
  return kept;
}

}  // namespace

MethodTrials try_methods(const TrialRequest& request) {
  MethodTrials trials;
  std::array<std::vector<std::vector<One>>, kTrialDecades> by_decade;
  for (auto& methods : by_decade) methods.resize(request.methods.size());
  for (const TrialFamily& family : trial_families()) {
    const PairSet set =
        trial_pairs(family, TrialUse::test, request.seed, request.pairs, request.threads);
    std::array<PairSet, kTrialDecades> parts;
    for (std::size_t k = 0; k < set.pairs.size(); ++k) {
      PairSet& part = parts[std::size_t(trial_decade(set.exact[k]))];
      part.pairs.push_back(set.pairs[k]);
      part.exact.push_back(set.exact[k]);
    }
    MethodTrialTable table{
        fmt::format("{}{}, {} pairs", family.name,
                    family.test_only ? " (no constant was fitted on these)" : "", set.pairs.size()),
        {}};
    for (std::size_t m = 0; m < request.methods.size(); ++m) {
      const TableMethod& method = request.methods[m];
      std::vector<One> all;
      for (std::size_t d = 0; d < parts.size(); ++d) {
        const std::vector<One> ones = try_one(readable(parts[d], method), method, request);
        all.insert(all.end(), ones.begin(), ones.end());
        by_decade[d][m].insert(by_decade[d][m].end(), ones.begin(), ones.end());
      }
      table.rows.push_back(row_of(method.label, all));
      if (method.spec.name == "auto")
        trials.ways.push_back(ways_of(family.name, method.label, all));
    }
    trials.families.push_back(std::move(table));
  }
  for (int d = 0; d < kTrialDecades; ++d) {
    const auto& methods = by_decade[std::size_t(d)];
    const std::size_t pairs = methods.empty() ? 0 : methods.front().size();
    const double high = std::pow(10, d + 1 - kTrialDecades);
    MethodTrialTable table{
        d == 0
            ? fmt::format("F below {:.0e}, {} pairs of all families", high, pairs)
            : fmt::format("F {:.0e} to {:.0e}, {} pairs of all families", high / 10, high, pairs),
        {}};
    for (std::size_t m = 0; m < methods.size(); ++m)
      table.rows.push_back(row_of(request.methods[m].label, methods[m]));
    trials.decades.push_back(std::move(table));
  }
  return trials;
}

std::vector<TableMethod> trial_methods(const NetChoice& nets) {
  std::vector<TableMethod> methods;
  for (const char* text : {"kernel",          "moment",          "lambert:1",
                           "lambert:2",       "lambert:3",       "lambert:4",
                           "gauss:2",         "gauss:4",         "contour:2",
                           "contour:4",       "closed-form",     "legacy:linear50",
                           "fixed-kernel",    "fixed-moment",    "net",
                           "fixed-lambert:1", "fixed-lambert:2", "fixed-lambert:3",
                           "auto:0.1",        "auto:0.03",       "auto",
                           "auto:0.003",      "auto:0.001"}) {
    const MethodSpec spec = parse_method(text);
    if (spec.name == "net" && !nets.general()) continue;
    if (spec.name == "legacy" && !nets.shipped_legacy) continue;
    methods.push_back({spec.name == "net" ? "net, general" : text, spec, nets});
  }
  return methods;
}

}  // namespace host
