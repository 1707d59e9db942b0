// The cheapest way to a form factor: as accurate as asked for, sure of its error, the same bits
// both ways round. On test pairs, of which none served to fit its constants.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "accuracy/pair_families.hpp"
#include "accuracy/trial_pairs.hpp"
#include "geometry/order.hpp"
#include "method/engine_source.hpp"
#include "method/pair_method.hpp"
#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "solve/scene_solver.hpp"
#include "urad/cheapest.hpp"
#include "urad/lambert.hpp"
#include "urad/third_order.hpp"
#include "weights/general.h"

namespace {

constexpr std::uint64_t kSeed = 20090419;
constexpr double kHundredth = 0.01;

std::int16_t q8(double error) { return std::int16_t(std::floor(256 * std::log2(error))); }

struct Answer {
  double f = 0, estimate = 0;
  urad::Way way = urad::Way::none;
  std::int32_t log2_g_q24 = 0;
  std::uint16_t cubics = 0;
};

Answer answer(const host::FixedScene& scene, double error, const urad_net* net,
              std::uint16_t i = 0) {
  urad_counters counters{};
  const urad::Patch p = urad::patch_at(scene.pod(), i);
  const urad::Patch q = urad::patch_at(scene.pod(), std::uint16_t(1 - i));
  const urad::CheapestPair pair =
      urad::cheapest_exchange(scene.pod(), p, q, net, q8(error), &counters);
  CHECK(counters.evaluated + counters.skipped_facing == 1);
  if (pair.way == urad::Way::none) return {};
  return {std::exp2((pair.log2_exchange_q24 - p.shape->log2_area_q24) * 0x1p-24),
          std::exp2(pair.log2_error_q8 / 256.0), pair.way, pair.log2_exchange_q24, pair.cubics};
}

host::FixedScene scene_of(const host::PolygonPair& pair) {
  return host::FixedScene::of_polygons({pair.p, pair.q}, {});
}

/// log2 G of a pair that is not cut.
std::int32_t by_third_moments(const urad_scene& scene, const urad::Patch& p, const urad::Patch& q) {
  urad::PairKernel kernel;
  REQUIRE(urad::pair_kernel(*p.shape, p.centroid, *q.shape, q.centroid, &kernel));
  const std::int32_t t3_q22 = urad::third_order(scene, p, q, kernel).t3_q22;
  return std::min({kernel.log2_kernel_q24 + urad::log2_bend_q24(kernel, t3_q22),
                   p.shape->log2_area_q24, q.shape->log2_area_q24});
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[std::size_t(share * double(values.size() - 1))];
}

struct Outcome {
  std::vector<double> error, usefulness;
  double unsaid = 0;  // the greatest error of those said to be within three times the wanted
  std::size_t misses = 0;
};

Outcome outcome(const host::PairSet& set, double wanted, const urad_net* net) {
  Outcome result;
  for (std::size_t k = 0; k < set.pairs.size(); ++k) {
    const Answer a = answer(scene_of(set.pairs[k]), wanted, net);
    const double error = std::fabs(a.f / set.exact[k] - 1);
    result.error.push_back(error);
    result.usefulness.push_back(a.estimate / std::max(error, 1e-9));
    result.misses += error > a.estimate;
    if (a.estimate <= 3 * wanted) result.unsaid = std::max(result.unsaid, error);
  }
  return result;
}

host::PairSet test_pairs(const host::TrialFamily& family, std::size_t count) {
  return host::trial_pairs(family, host::TrialUse::test, kSeed, count, 0);
}

}  // namespace

TEST_CASE("by auto, test pairs of every family are as accurate as asked for, and it knows") {
  std::vector<double> usefulness;
  std::size_t misses = 0, pairs = 0;
  for (const host::TrialFamily& family : host::trial_families()) {
    const host::PairSet set = test_pairs(family, 200);
    const Outcome with = outcome(set, kHundredth, &urad_general);
    const Outcome without = outcome(set, kHundredth, nullptr);
    for (const Outcome* one : {&with, &without}) {
      MESSAGE(family.name, ": median ", quantile(one->error, 0.5), " p99 ",
              quantile(one->error, 0.99), " max ", quantile(one->error, 1), ", estimate missed ",
              one->misses, " of ", set.pairs.size(), ", estimate/error median ",
              quantile(one->usefulness, 0.5), " p90 ", quantile(one->usefulness, 0.9));
      CHECK(quantile(one->error, 0.5) <= 1e-3);
      CHECK(one->unsaid <= 0.1);
      // Plates beside each other, a thousandth apart, are more than halving resolves: that is said.
      if (family.name != "aligned rectangles") {
        CHECK(quantile(one->error, 0.99) <= 0.03);
        CHECK(quantile(one->error, 1) <= 0.1);
      }
      CHECK(one->misses <= set.pairs.size() / 40);  // 1 % and what chance may add in 200 draws
      misses += one->misses;
      pairs += set.pairs.size();
      usefulness.insert(usefulness.end(), one->usefulness.begin(), one->usefulness.end());
    }
    if (family.name == "shared edge") CHECK(quantile(with.error, 1) <= 0.02);
  }
  MESSAGE("all: missed ", misses, " of ", pairs, ", estimate/error median ",
          quantile(usefulness, 0.5), " p90 ", quantile(usefulness, 0.9));
  CHECK(misses <= pairs / 100);
  CHECK(quantile(usefulness, 0.5) <= 40);
  CHECK(quantile(usefulness, 0.9) <= 1000);
}

TEST_CASE("the exchange is one integer, whoever asks") {
  for (const host::TrialFamily& family : host::trial_families()) {
    const host::PairSet set = test_pairs(family, 20);
    for (const host::PolygonPair& pair : set.pairs) {
      const host::FixedScene scene = scene_of(pair);
      for (const double error : {0.1, 0.01, 0.001}) {
        const Answer there = answer(scene, error, &urad_general, 0);
        const Answer back = answer(scene, error, &urad_general, 1);
        REQUIRE(there.log2_g_q24 == back.log2_g_q24);
        REQUIRE(there.way == back.way);
        REQUIRE(there.estimate == back.estimate);
      }
    }
  }
}

TEST_CASE("the points of a sum are those of its rules: one, four, nine, eighteen more a halving") {
  std::size_t pairs[urad::kWays] = {};
  for (const host::TrialFamily& family : host::trial_families()) {
    const host::PairSet set = test_pairs(family, 40);
    for (const host::PolygonPair& pair : set.pairs) {
      if (pair.p.outer.size() != 4 || pair.q.outer.size() != 4) continue;
      if (host::is_concave(pair.p) || host::is_concave(pair.q)) continue;  // more than one piece
      const host::FixedScene scene = scene_of(pair);
      const urad::Patch p = urad::patch_at(scene.pod(), 0), q = urad::patch_at(scene.pod(), 1);
      for (const double error : {0.3, 0.1, 0.03, 0.01, 0.001}) {
        urad_counters counters{};
        const urad::CheapestPair found =
            urad::cheapest_exchange(scene.pod(), p, q, nullptr, q8(error), &counters);
        if (counters.clipped != 0) continue;
        ++pairs[int(found.way)];
        // What was tried first, and was not enough.
        const int points = found.point_sums;
        const auto after = [&](int rule, int halvings) {
          const int sums = rule + 18 * halvings;
          return points == sums || points == sums + 1 || points == sums + 4 || points == sums + 5;
        };
        if (found.way <= urad::Way::network) REQUIRE(points == 0);
        if (found.way == urad::Way::point) REQUIRE(points == 1);
        if (found.way == urad::Way::four_points) REQUIRE((points == 4 || points == 5));
        if (found.way == urad::Way::nine_points) REQUIRE(after(9, 0));
        if (found.way == urad::Way::refined) REQUIRE(after(9, (points - 9) / 18));
      }
    }
  }
  CHECK(pairs[int(urad::Way::point)] > 0);
  CHECK(pairs[int(urad::Way::four_points)] > 0);
  CHECK(pairs[int(urad::Way::refined)] > 0);
}

TEST_CASE("a way that is asked for by itself gives what the search finds on it") {
  std::size_t pairs[urad::kWays] = {}, with_third_moments = 0;
  for (const host::TrialFamily& family : host::trial_families()) {
    const host::PairSet set = test_pairs(family, 25);
    for (const host::PolygonPair& pair : set.pairs) {
      const host::FixedScene fixed = scene_of(pair);
      const urad_scene& scene = fixed.pod();
      const urad::Patch p = urad::patch_at(scene, 0), q = urad::patch_at(scene, 1);
      for (const double error : {0.3, 0.03, 0.003}) {
        const Answer found = answer(fixed, error, &urad_general);
        std::int32_t log2_g_q24 = 0;
        urad::PairTraits traits;
        if (found.way == urad::Way::none) continue;
        ++pairs[int(found.way)];
        if (found.way == urad::Way::refined) {
          // One of its stops, and the first of them are the nine points.
          std::array<urad::RefinedStop, urad::kMostRefinedCells> stop;
          const int stops = urad::refined_stops(scene, p, q, stop.data(), int(stop.size()));
          REQUIRE(stops > 0);
          CHECK(std::any_of(stop.begin(), stop.begin() + stops, [&](const urad::RefinedStop& s) {
            return s.log2_exchange_q24 == found.log2_g_q24;
          }));
          CHECK(urad::refined_stops(scene, p, q, stop.data(), 1) == 1);
          CHECK(urad::exchange_by(scene, p, q, urad::Way::nine_points, nullptr, &log2_g_q24,
                                  &traits));
          CHECK(stop[0].log2_exchange_q24 == log2_g_q24);
          continue;
        }
        CHECK(urad::exchange_by(scene, p, q, found.way, &urad_general, &log2_g_q24, &traits));
        if (found.cubics > 0) {
          CHECK(found.way == urad::Way::kernel);
          log2_g_q24 = by_third_moments(scene, p, q);
          ++with_third_moments;
        }
        CHECK(log2_g_q24 == found.log2_g_q24);
        CHECK_FALSE(
            urad::exchange_by(scene, p, q, urad::Way::network, nullptr, &log2_g_q24, &traits));
      }
    }
  }
  for (const urad::Way way : {urad::Way::kernel, urad::Way::network, urad::Way::point,
                              urad::Way::four_points, urad::Way::refined})
    CHECK(pairs[int(way)] > 0);
  CHECK(with_third_moments > 0);
  // Back to back: nothing by any way.
  const host::Polygon floor{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}};
  const host::Polygon below{{{0, 0, -1}, {0, 1, -1}, {1, 1, -1}, {1, 0, -1}}, {}};
  const host::FixedScene apart = scene_of({floor, below});
  const urad::Patch p = urad::patch_at(apart.pod(), 0), q = urad::patch_at(apart.pod(), 1);
  std::int32_t log2_g_q24 = 0;
  urad::PairTraits traits;
  urad::RefinedStop stop;
  CHECK_FALSE(
      urad::exchange_by(apart.pod(), p, q, urad::Way::kernel, nullptr, &log2_g_q24, &traits));
  CHECK(urad::refined_stops(apart.pod(), p, q, &stop, 1) == 0);
  CHECK(urad::lambert_refined(apart.pod(), p, q, 3, 4).log2_exchange_q24 == urad::kNoExchange);
}

TEST_CASE("less error never comes cheaper, and a first vertex decides nothing but rounding") {
  for (const host::TrialFamily& family : host::trial_families()) {
    const host::PairSet set = test_pairs(family, 20);
    for (const host::PolygonPair& pair : set.pairs) {
      const host::FixedScene scene = scene_of(pair);
      urad::Way last = urad::Way::none;
      for (const double error : {0.3, 0.1, 0.03, 0.01, 0.003, 0.001, 1e-4}) {
        const Answer a = answer(scene, error, &urad_general);
        REQUIRE(a.way >= last);
        last = a.way;
      }
      host::PolygonPair turned = pair;
      std::rotate(turned.p.outer.begin(), turned.p.outer.begin() + 1, turned.p.outer.end());
      std::rotate(turned.q.outer.begin(), turned.q.outer.begin() + 2, turned.q.outer.end());
      const Answer a = answer(scene, kHundredth, &urad_general);
      const Answer b = answer(scene_of(turned), kHundredth, &urad_general);
      REQUIRE(std::fabs(a.f - b.f) <= (a.estimate + b.estimate) * std::max(a.f, b.f));
    }
  }
}

TEST_CASE("the command's method auto gives the row of the source, and an error") {
  const host::NetChoice nets{[](const std::string&) { return &urad_general; }};
  const host::MethodSpec spec = host::parse_method("auto:0.003");
  const host::FreePairMethod method = host::pair_method(spec, nets);
  CHECK(method.knows_error);
  for (const host::TrialFamily& family : host::trial_families()) {
    const host::PairSet set = test_pairs(family, 10);
    for (const host::PolygonPair& pair : set.pairs) {
      // The command starts both loops, and the pair, where their text does not decide.
      const host::Polygon p = host::standard_order(pair.p), q = host::standard_order(pair.q);
      const bool swapped = host::written_before(q, p);
      const host::FixedScene scene = swapped ? scene_of({q, p}) : scene_of({p, q});
      const host::EngineSource source(scene, spec, nets, {});
      std::array<std::uint32_t, 2> row{};
      source.row(swapped ? 1 : 0, row.data());
      const host::PairResult result = method.run(pair.p, pair.q);
      CHECK(result.estimate.f == row[swapped ? 0 : 1] / 4294967296.0);
      CHECK(result.estimate.relative_error > 0);
      const auto& ways = source.ways();
      CHECK(std::accumulate(ways.begin(), ways.end(), 0u) == 1);
    }
  }
  for (const char* wrong : {"auto:0", "auto:1", "auto:x", "auto:-0.1", "auto:nan"})
    CHECK_THROWS(host::pair_method(host::parse_method(wrong), nets));
}

TEST_CASE("light of cube7 by auto") {
  const host::NetChoice nets{[](const std::string&) { return &urad_general; }};
  const host::Scene scene = host::load_scene("cube7");
  host::SceneSolver solver(scene, 0, true);
  host::SolveGoal goal;
  goal.error = 1e-5;
  const host::MethodRun run = solver.run(host::parse_method("auto"), nets, goal);
  MESSAGE("cube7 by auto: rms ", run.rms, " max ", run.max, ", factors std ", run.factors.std,
          " worst row ", run.factors.row_worst);
  CHECK(run.rms <= 5e-4);
  CHECK(run.max <= 2e-3);
}
