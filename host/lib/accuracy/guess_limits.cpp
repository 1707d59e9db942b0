#include "accuracy/guess_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "accuracy/error_training.hpp"
#include "accuracy/trial_pairs.hpp"
#include "base/parallel.hpp"
#include "base/quantile.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"

namespace host {

namespace {

constexpr double kWanted[] = {0.1, 0.03, 0.01, 0.003, 0.001};
constexpr int kMostStops = 64;
constexpr double kHolds = 0.99;
constexpr double kLeastError = -23;  // log2: of the reference and the last bits of a factor

/// Where the two touch.
struct Corners {
  int shared = 0, on_plane_p = 0, on_plane_q = 0;
};

Corners corners_of(const PolygonPair& pair) {
  constexpr double kRounding = 1e-9;
  const Moments p = moments(pair.p), q = moments(pair.q);
  const double size = std::sqrt(std::max(p.area, q.area));
  Corners corners;
  for (const Vec3& x : pair.p.outer) {
    corners.on_plane_q += std::fabs(glm::dot(q.normal, x - q.centroid)) < kRounding * size;
    for (const Vec3& y : pair.q.outer) corners.shared += glm::distance(x, y) < kRounding * size;
  }
  for (const Vec3& y : pair.q.outer)
    corners.on_plane_p += std::fabs(glm::dot(p.normal, y - p.centroid)) < kRounding * size;
  return corners;
}

/// What auto made of a pair, and all that it knew then.
struct Outcome {
  std::size_t family = 0;
  double error = 0, said = 0;  // log2
  urad::Way way = urad::Way::none;
  urad::PairTraits traits{};
  Corners corners;
};

/// The traits auto had before it when it stopped.
bool traits_at(const urad_scene& scene, const urad::Patch& p, const urad::Patch& q,
               const urad_net* net, const urad::CheapestPair& pair, urad::PairTraits* traits) {
  std::int32_t log2_g_q24 = 0;
  if (pair.way < urad::Way::nine_points)
    return urad::exchange_by(scene, p, q, pair.way, net, &log2_g_q24, traits);
  urad::RefinedStop stops[kMostStops];
  const int count = urad::refined_stops(scene, p, q, stops, kMostStops);
  const auto* const at = std::find_if(stops, stops + count, [&](const urad::RefinedStop& stop) {
    return stop.log2_exchange_q24 == pair.log2_exchange_q24;
  });
  if (at == stops + count) return false;
  *traits = at->traits;
  return true;
}

void ask(const PolygonPair& pair, double exact, std::size_t family, const urad_net* net,
         std::vector<Outcome>* outcomes) {
  const FixedScene fixed = FixedScene::of_polygons({pair.p, pair.q}, {});
  const urad_scene& scene = fixed.pod();
  const urad::Patch p = urad::patch_at(scene, 0), q = urad::patch_at(scene, 1);
  const Corners corners = corners_of(pair);
  for (const double wanted : kWanted) {
    urad_counters counters{};
    const urad::CheapestPair found = urad::cheapest_exchange(
        scene, p, q, net, std::int16_t(std::floor(256 * std::log2(wanted))), &counters);
    Outcome outcome{family, 0, found.log2_error_q8 / 256.0, found.way, {}, corners};
    if (found.way == urad::Way::none || !traits_at(scene, p, q, net, found, &outcome.traits))
      continue;
    const double f = std::exp2((found.log2_exchange_q24 - p.shape->log2_area_q24) * 0x1p-24);
    outcome.error = std::max(std::log2(std::fabs(f / exact - 1)), kLeastError);
    outcomes->push_back(outcome);
  }
}

std::vector<Outcome> outcomes_of(const GuessLimitRequest& request, TrialUse use,
                                 std::uint64_t seed) {
  std::vector<Outcome> all;
  const std::vector<TrialFamily> families = trial_families();
  for (std::size_t f = 0; f < families.size(); ++f) {
    if (families[f].test_only) continue;
    const PairSet set = trial_pairs(families[f], use, seed, request.pairs, request.threads);
    std::vector<std::vector<Outcome>> parts(set.pairs.size());
    parallel_for(set.pairs.size(), request.threads, [&](std::size_t k) {
      ask(set.pairs[k], set.exact[k], f, request.net, &parts[k]);
    });
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

Eigen::VectorXd errors_of(const std::vector<Outcome>& outcomes) {
  Eigen::VectorXd errors(Eigen::Index(outcomes.size()));
  for (std::size_t k = 0; k < outcomes.size(); ++k) errors[Eigen::Index(k)] = outcomes[k].error;
  return errors;
}

enum class Told { nothing, corners, family };

/// Traits, way, class and what auto said, and what it is told besides.
Eigen::MatrixXd rows_of(const std::vector<Outcome>& outcomes, Told told, std::size_t families) {
  constexpr int kWay = urad::kTraits, kClass = kWay + urad::kWays;
  constexpr int kSaid = kClass + urad::kPairClasses, kMore = kSaid + 1, kCorners = 5;
  const auto more = told == Told::nothing ? 0 : told == Told::corners ? kCorners : int(families);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(Eigen::Index(outcomes.size()), kMore + more);
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const Outcome& one = outcomes[k];
    const auto row = Eigen::Index(k);
    for (int t = 0; t < urad::kTraits; ++t) rows(row, t) = one.traits.log2_q8[t] / 256.0;
    rows(row, kWay + int(one.way)) = 1;
    rows(row, kClass + int(one.traits.pair_class)) = 1;
    rows(row, kSaid) = one.said;
    if (told == Told::family) rows(row, kMore + Eigen::Index(one.family)) = 1;
    if (told == Told::corners) {
      rows(row, kMore + std::min(one.corners.shared, 2)) = 1;
      rows(row, kMore + 3) = one.corners.on_plane_p;
      rows(row, kMore + 4) = one.corners.on_plane_q;
    }
  }
  return rows;
}

/// guess less error, log2, of one family.
std::vector<double> margins(const std::vector<Outcome>& outcomes, const Eigen::VectorXd& guess,
                            std::size_t family) {
  std::vector<double> all;
  for (std::size_t k = 0; k < outcomes.size(); ++k)
    if (outcomes[k].family == family) all.push_back(guess[Eigen::Index(k)] - outcomes[k].error);
  return all;
}

GuessQuality quality(const std::vector<double>& margins, double shift) {
  const auto held = std::count_if(margins.begin(), margins.end(),
                                  [&](double margin) { return margin + shift >= 0; });
  return {double(held) / double(std::max<std::size_t>(1, margins.size())),
          std::exp2(quantile(margins, 0.5) + shift), std::exp2(quantile(margins, 0.9) + shift)};
}

/// What must be added so that a guess holds for 99 %.
double shift_of(const std::vector<double>& margins) { return -quantile(margins, 1 - kHolds); }

}  // namespace

std::vector<GuessLimit> try_guesses(const GuessLimitRequest& request) {
  const std::vector<TrialFamily> families = trial_families();
  const std::vector<Outcome> fit = outcomes_of(request, TrialUse::fit, request.seed);
  const std::vector<Outcome> moving = outcomes_of(request, TrialUse::fit, request.seed + 1);
  const std::vector<Outcome> test = outcomes_of(request, TrialUse::test, request.seed);
  // Both sets are asked about in one go.
  std::vector<Outcome> asked = moving;
  asked.insert(asked.end(), test.begin(), test.end());
  const Eigen::VectorXd errors = errors_of(fit);
  struct Asked {
    Told told;
    double quantile;
  };
  constexpr Asked kAsked[] = {{Told::nothing, kHolds},
                              {Told::corners, kHolds},
                              {Told::family, kHolds},
                              {Told::family, 0.5}};
  Eigen::VectorXd said(Eigen::Index(asked.size())), guess[std::size(kAsked)];
  for (std::size_t k = 0; k < asked.size(); ++k) said[Eigen::Index(k)] = asked[k].said;
  parallel_for(std::size(kAsked), request.threads, [&](std::size_t k) {
    guess[k] = guess_errors(rows_of(fit, kAsked[k].told, families.size()), errors,
                            rows_of(asked, kAsked[k].told, families.size()),
                            {request.hidden, kAsked[k].quantile, request.seed, request.steps});
  });
  std::vector<GuessLimit> limits;
  for (std::size_t f = 0; f < families.size(); ++f) {
    if (families[f].test_only) continue;
    const auto judged = [&](const Eigen::VectorXd& all, bool move) {
      const auto moved = margins(moving, all.head(Eigen::Index(moving.size())), f);
      return quality(margins(test, all.tail(Eigen::Index(test.size())), f),
                     move ? shift_of(moved) : 0);
    };
    const auto about = margins(test, guess[3].tail(Eigen::Index(test.size())), f);
    limits.push_back({families[f].name, about.size(), judged(said, false), judged(said, true),
                      judged(guess[0], true), judged(guess[1], true), judged(guess[2], true),
                      std::exp2(quantile(about, 0.5) - quantile(about, 0.01)),
                      std::exp2(quantile(about, 0.9) - quantile(about, 0.5))});
  }
  return limits;
}

std::string guess_table(const std::vector<GuessLimit>& limits) {
  std::string text =
      "| pairs | outcomes | auto says | moved for this kind | a wide network | told what touches | "
      "told the kind | p99 / median of errors | median / p10 |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  const auto cell = [](const GuessQuality& quality) {
    return fmt::format("{:.1f} %, {:.1f}, {:.0f}", 100 * quality.holds, quality.median,
                       quality.p90);
  };
  for (const GuessLimit& limit : limits)
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.1f} | {:.1f} |\n", limit.family,
                        limit.outcomes, cell(limit.engine), cell(limit.moved), cell(limit.wide),
                        cell(limit.corners), cell(limit.told), limit.scatter, limit.crossing);
  return text;
}

}  // namespace host
