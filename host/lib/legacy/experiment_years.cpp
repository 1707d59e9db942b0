#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/file.hpp"
#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "legacy/experiments.hpp"
#include "legacy/random_quads.hpp"
#include "legacy/statistics.hpp"
#include "method/pair_method.hpp"
#include "network/random.hpp"

namespace host {

namespace {

struct Pair {
  const Polygon *p, *q;
  double exact;
};

struct Figures {
  double std = 0, median = 0, p99 = 0, ns = 0;
};

template <class Run>
Figures figures(const std::vector<Pair>& pairs, Run&& run) {
  std::vector<double> off, relative;
  const Stopwatch time;
  for (const Pair& pair : pairs) off.push_back(run(*pair.p, *pair.q) - pair.exact);
  const double seconds = time.seconds();
  for (std::size_t k = 0; k < pairs.size(); ++k)
    relative.push_back(std::fabs(off[k]) / pairs[k].exact);
  std::sort(relative.begin(), relative.end());
  const auto at = [&](double share) {
    return relative[std::size_t(share * double(relative.size() - 1))];
  };
  return {summary(off).std, at(0.5), at(0.99), 1e9 * seconds / double(pairs.size())};
}

std::vector<std::string> cells(const Figures& f) {
  return {short_number(f.std), fmt::format("{:.2g} %", 100 * f.median),
          fmt::format("{:.3g} %", 100 * f.p99), fmt::format("{:.0f}", f.ns)};
}

}  // namespace

ResultTable experiment_years(const ExperimentRequest& request, const CubeExperiment& cube) {
  // The report's own tables: the cube of 4.1, and the sets of 3.1 in proportion.
  std::vector<Pair> on_cube, random;
  const auto& patches = cube.scene.patches;
  Random draw_pairs(request.base.seed, 14);
  const auto count = std::size_t(std::max(200.0, 10000 * request.base.share));
  while (on_cube.size() < count) {
    const int i = draw_pairs.below(int(patches.size())), j = draw_pairs.below(int(patches.size()));
    if (cube.exact(i, j) > 0)
      on_cube.push_back(
          {&patches[std::size_t(i)].polygon, &patches[std::size_t(j)].polygon, cube.exact(i, j)});
  }
  const auto& sets = report_sets();
  std::vector<std::vector<QuadPair>> drawn(sets.size());
  parallel_for(sets.size(), request.base.threads, [&](std::size_t k) {
    const double share = 0.15 * request.base.share;
    drawn[k] = draw(sets[k], request.base.seed + 1000,
                    std::max(10, int(std::lround(share * sets[k].samples))));
  });
  for (const auto& set : drawn)
    for (const QuadPair& pair : set) random.push_back({&pair.p, &pair.q, pair.exact});

  ResultTable table{"experiment_years",
                    "What 30 years changed: error beside cost on the report's two sets of data",
                    {"method", "cube: std", "median", "p99", "ns a pair", "random: std", "median",
                     "p99", "ns a pair"},
                    {},
                    {}};
  const auto add = [&](const std::string& name, auto&& run, bool both) {
    std::vector<std::string> row{name};
    for (auto& cell : cells(figures(on_cube, run))) row.push_back(std::move(cell));
    if (both) {
      for (auto& cell : cells(figures(random, run))) row.push_back(std::move(cell));
    } else {
      row.insert(row.end(), 4, "-");
    }
    table.rows.push_back(std::move(row));
  };
  for (const LegacyNetFile& file : cube.nets)
    if (file.net.hidden >= 30)
      add(
          "the report's " + file.net.name() + " (for the cube)",
          [&](const Polygon& p, const Polygon& q) {
            return file.net.form_factor(legacy_input(p, q));
          },
          false);
  const std::string path = request.base.folder + "/nets/random50.json";
  if (std::filesystem::exists(path)) {
    const LegacyNet net = legacy_from_json(read_file(path), path).net;
    add(
        "the report's linear50 (for random quads)",
        [&](const Polygon& p, const Polygon& q) { return net.form_factor(legacy_input(p, q)); },
        true);
  }
  for (const char* name : {"kernel", "moment", "gauss:2", "lambert:1", "lambert:2", "lambert:3",
                           "reference", "fixed-moment", "net:cube7", "net:general"}) {
    const FreePairMethod method = pair_method(parse_method(name), request.nets);
    add(
        name, [&](const Polygon& p, const Polygon& q) { return method.run(p, q).estimate.f; },
        true);
  }
  table.notes = {fmt::format(
      "{} facing pairs of the cube and {} fresh random pairs of the fifteen sets. std: absolute, "
      "of "
      "F; median and p99: relative. Time on this machine, double precision, from polygons on; the "
      "integer methods (fixed-, net) build a scene for each pair first, which is most of their "
      "time "
      "here: docs/BUDGET.md has their cost on a chip.",
      on_cube.size(), random.size())};
  return table;
}

}  // namespace host
