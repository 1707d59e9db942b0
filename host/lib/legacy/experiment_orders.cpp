#include <fmt/format.h>

#include <cmath>

#include "legacy/experiments.hpp"
#include "legacy/random_quads.hpp"
#include "legacy/statistics.hpp"
#include "method/pair_method.hpp"
#include "network/random.hpp"

namespace host {

namespace {

/// The same polygon from another vertex on.
Polygon started_at(const Polygon& polygon, std::size_t first) {
  Polygon turned = polygon;
  std::rotate(turned.outer.begin(), turned.outer.begin() + std::ptrdiff_t(first),
              turned.outer.end());
  return turned;
}

struct Pair {
  const Polygon *p, *q;
  double exact;
};

/// `count` ordered pairs that see each other.
std::vector<Pair> pairs_of(const CubeExperiment& cube, std::size_t count, std::uint64_t seed) {
  Random random(seed, 6);
  std::vector<Pair> pairs;
  const auto& patches = cube.scene.patches;
  while (pairs.size() < count) {
    const int i = random.below(int(patches.size())), j = random.below(int(patches.size()));
    if (cube.exact(i, j) > 0)
      pairs.push_back(
          {&patches[std::size_t(i)].polygon, &patches[std::size_t(j)].polygon, cube.exact(i, j)});
  }
  return pairs;
}

/// All ordered pairs that see each other, each from two random vertices on.
std::vector<LegacySample> turned_samples(const CubeExperiment& cube, std::uint64_t seed) {
  Random random(seed, 7);
  std::vector<LegacySample> samples;
  const auto& patches = cube.scene.patches;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (std::size_t j = 0; j < patches.size(); ++j) {
      const double exact = cube.exact(Eigen::Index(i), Eigen::Index(j));
      if (!(exact > 0)) continue;
      const auto p = started_at(patches[i].polygon, std::size_t(random.below(4)));
      const auto q = started_at(patches[j].polygon, std::size_t(random.below(4)));
      samples.push_back({legacy_input(p, q), float(legacy_scaled(LegacyScaling::linear, exact))});
    }
  }
  return samples;
}

LegacyJob job_of(const ExperimentRequest& request, const std::string& file,
                 const std::string& subject, const LegacySplit& split) {
  LegacyJob job;
  job.file = file;
  job.subject = subject;
  job.command = fmt::format("urad reproduce experiments --epochs {} --seed {}{}",
                            request.base.epochs, request.base.seed, request.base.command_tail);
  job.settings.epochs = request.base.epochs;
  job.settings.seed = request.base.seed;
  job.data = &split;
  return job;
}

template <class Run>
std::vector<std::string> order_row(const std::string& name, const std::vector<Pair>& pairs,
                                   Run&& run) {
  std::vector<double> first, all;
  double spread = 0, widest = 0;
  for (const Pair& pair : pairs) {
    std::vector<double> orders;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        orders.push_back(run(started_at(*pair.p, a), started_at(*pair.q, b)));
    first.push_back(orders[0] - pair.exact);
    for (const double f : orders) all.push_back(f - pair.exact);
    const Summary s = summary(orders);
    spread += s.std * s.std / double(pairs.size());
    widest = std::max(widest, s.max - s.min);
  }
  return {name, short_number(summary(first).std), short_number(summary(all).std),
          short_number(std::sqrt(spread)), short_number(widest)};
}

}  // namespace

ResultTable experiment_orders(const ExperimentRequest& request, const CubeExperiment& cube) {
  const auto pairs =
      pairs_of(cube, std::size_t(std::max(50.0, 1000 * request.base.share)), request.base.seed);
  ResultTable table{"experiment_orders",
                    "Sixteen orders of the vertices: error of F with the order of training, with "
                    "any, and the spread over the orders of one pair",
                    {"network", "std, its own order", "std, all orders", "spread", "widest"},
                    {},
                    {}};
  const auto raw = [](const LegacyNet& net) {
    return
        [&net](const Polygon& p, const Polygon& q) { return net.form_factor(legacy_input(p, q)); };
  };
  for (const LegacyNetFile& file : cube.nets)
    if (file.net.hidden >= 30)
      table.rows.push_back(order_row("the report's " + file.net.name(), pairs, raw(file.net)));
  const LegacySplit split =
      legacy_split(turned_samples(cube, request.base.seed), request.base.seed);
  const auto turned =
      train_legacy({job_of(request, "orders50", "cube7, random vertex orders", split)},
                   request.base.folder + "/nets", request.base.threads, request.base.quiet);
  table.rows.push_back(order_row("linear50, trained on random orders", pairs, raw(turned[0].net)));
  for (const char* name : {"net:general", "net:cube7"}) {
    const FreePairMethod method = pair_method(parse_method(name), request.nets);
    table.rows.push_back(order_row(name, pairs, [&](const Polygon& p, const Polygon& q) {
      return method.run(p, q).estimate.f;
    }));
  }
  double mean = 0;
  for (const Pair& pair : pairs) mean += pair.exact / double(pairs.size());
  table.notes = {fmt::format(
      "{} pairs of the cube, mean F {:.3g}. Spread: root mean square over the pairs of the "
      "standard "
      "deviation over the sixteen orders; widest: largest difference of two orders of one pair. "
      "The "
      "network of random orders saw each pair in one random order, {} epochs; the others are those "
      "of Table 4.1, {} epochs.",
      pairs.size(), mean, turned[0].epochs, cube.nets[0].epochs)};
  return table;
}

ResultTable experiment_normals(const ExperimentRequest& request, const CubeExperiment& cube) {
  const auto target = [](const Moments& a, const Moments& b) {
    return float(0.5 + 0.4 * glm::dot(a.normal, b.normal));
  };
  std::vector<LegacySample> samples;
  for (const ScenePatch& a : cube.scene.patches)
    for (const ScenePatch& b : cube.scene.patches)
      samples.push_back({legacy_input(a.polygon, b.polygon), target(a.moments, b.moments)});
  const LegacySplit split = legacy_split(samples, request.base.seed);
  LegacyJob job = job_of(request, "normals50", "cube7, dot product of the normals", split);
  const LegacyNet net = train_legacy({job}, request.base.folder + "/nets", request.base.threads,
                                     request.base.quiet)[0]
                            .net;

  ResultTable table{
      "experiment_normals",
      "The report's proposed test: 24-50-1 trained on the dot product of the normals",
      {"pairs", "std of the target", "std of error", "largest", "nearest of -1, 0, 1 right"},
      {},
      {}};
  const auto add = [&](const std::string& name, const std::vector<LegacySample>& set,
                       bool classes) {
    std::vector<double> dots, errors;
    int right = 0;
    double worst = 0;
    for (const LegacySample& sample : set) {
      const double dot = (double(sample.target) - 0.5) / 0.4,
                   said = (net.run(sample.input) - 0.5) / 0.4;
      dots.push_back(dot);
      errors.push_back(said - dot);
      worst = std::max(worst, std::fabs(said - dot));
      right += std::lround(said) == std::lround(dot);
    }
    table.rows.push_back(
        {name, short_number(summary(dots).std), short_number(summary(errors).std),
         short_number(worst),
         classes ? fmt::format("{:.2f} %", 100.0 * right / double(set.size())) : "-"});
  };
  add("cube7, held out", split.test, true);
  Random random(request.base.seed, 8);
  std::vector<LegacySample> turned, free;
  for (int k = 0; k < 8000; ++k) {
    const auto &a = cube.scene.patches[std::size_t(random.below(294))],
               &b = cube.scene.patches[std::size_t(random.below(294))];
    turned.push_back({legacy_input(started_at(a.polygon, std::size_t(random.below(4))),
                                   started_at(b.polygon, std::size_t(random.below(4)))),
                      target(a.moments, b.moments)});
  }
  add("cube7, other vertex orders", turned, true);
  while (free.size() < 2000) {
    const Vec3 x(random.uniform(), random.uniform(), random.uniform()),
        y(random.uniform(), random.uniform(), random.uniform());
    const auto p = random_quad(random, x, 0.3), q = random_quad(random, y, 0.3);
    if (p && q) free.push_back({legacy_input(*p, *q), target(moments(*p), moments(*q))});
  }
  add("random quads", free, false);
  table.notes = {
      fmt::format("{} epochs, linear scaling of the dot product to 0.1 .. 0.9; the six "
                  "walls give only -1, 0 and 1.",
                  request.base.epochs)};
  return table;
}

}  // namespace host
