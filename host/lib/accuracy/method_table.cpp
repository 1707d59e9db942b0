#include "accuracy/method_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/stopwatch.hpp"
#include "method/engine_source.hpp"
#include "method/pair_method.hpp"
#include "network/evaluate.hpp"

namespace host {

namespace {

constexpr std::size_t kChunk = 256;  // pairs that are prepared at once
constexpr double kLeastNs = 2e6;     // of all passes over the same pairs together
constexpr int kLeastPasses = 3;
constexpr double kPerFactor = 1.0 / 4294967296.0;

/// This thread's time of the fastest pass of several: others may use the machine, too.
template <class Pass>
double fastest_ns(const Pass& pass) {
  double best = std::numeric_limits<double>::infinity(), all = 0;
  for (int passes = 0; passes < kLeastPasses || all < kLeastNs; ++passes) {
    const Stopwatch watch;
    pass();
    const double took = 1e9 * watch.seconds();
    best = std::min(best, took);
    all += took;
  }
  return best;
}

using Values = MethodValues;

Values by_vertices(const PairSet& set, const TableMethod& method) {
  const FreePairMethod run = pair_method(method.spec, method.nets);
  Values values{std::vector<double>(set.pairs.size())};
  values.ns = fastest_ns([&] {
    for (std::size_t k = 0; k < set.pairs.size(); ++k)
      values.f[k] = run.run(set.pairs[k].p, set.pairs[k].q).estimate.f;
  });
  return values;
}

Values by_engine(const PairSet& set, const TableMethod& method) {
  Values values;
  for (std::size_t first = 0; first < set.pairs.size(); first += kChunk) {
    const std::size_t end = std::min(first + kChunk, set.pairs.size());
    std::vector<FixedScene> scenes;
    std::vector<EngineSource> sources;
    scenes.reserve(end - first);
    sources.reserve(end - first);
    for (std::size_t k = first; k < end; ++k)
      scenes.push_back(FixedScene::of_polygons({set.pairs[k].p, set.pairs[k].q}, {}));
    for (const FixedScene& scene : scenes)
      sources.emplace_back(scene, method.spec, method.nets, EngineOptions{});
    std::vector<std::array<std::uint32_t, 2>> rows(sources.size());
    // A hemicube keeps the row it has; with both directions in turn every row is a new one.
    const auto from = [&](std::uint16_t shooter) {
      for (std::size_t k = 0; k < sources.size(); ++k) sources[k].row(shooter, rows[k].data());
    };
    values.ns += fastest_ns([&] { from(1), from(0); }) / 2;
    for (const auto& row : rows) values.f.push_back(row[1] * kPerFactor);
  }
  return values;
}

/// [patch][patch]; pairs that are not in the dataset stay 0.
Values scene_by_vertices(const Scene& scene, const SceneDataset& dataset,
                         const TableMethod& method) {
  const FreePairMethod run = pair_method(method.spec, method.nets);
  const std::size_t n = scene.patches.size();
  Values values{std::vector<double>(n * n)};
  values.ns = fastest_ns([&] {
    for (const ScenePair& pair : dataset.pairs) {
      const Polygon &p = scene.patches[pair.i].polygon, &q = scene.patches[pair.j].polygon;
      values.f[pair.i * n + pair.j] = run.run(p, q).estimate.f;
      values.f[pair.j * n + pair.i] = run.run(q, p).estimate.f;
    }
  });
  return values;
}

Values scene_by_engine(const Scene& scene, const TableMethod& method) {
  const FixedScene fixed(scene);
  Values values;
  EngineRows rows;
  EngineOptions options;
  options.rays = 0;
  values.ns = fastest_ns([&] { rows = engine_rows(fixed, method.spec, method.nets, options, 1); });
  for (const std::uint32_t f_uq32 : rows.f_uq32) values.f.push_back(f_uq32 * kPerFactor);
  return values;
}

}  // namespace

double rms(const ErrorRow& row) { return std::sqrt(row.std * row.std + row.bias * row.bias); }

MethodValues method_values(const PairSet& set, const TableMethod& method) {
  return is_engine_method(method.spec) ? by_engine(set, method) : by_vertices(set, method);
}

std::vector<MethodRow> measure_pairs(const PairSet& set, const std::vector<TableMethod>& methods) {
  std::vector<MethodRow> table;
  for (const TableMethod& method : methods) {
    const Values values = method_values(set, method);
    std::vector<Measured> measured;
    for (std::size_t k = 0; k < values.f.size(); ++k)
      measured.push_back({set.exact[k], values.f[k], PairKind::middle});
    table.push_back({method.label, error_row(method.label, measured),
                     values.ns / double(std::max<std::size_t>(1, values.f.size()))});
  }
  return table;
}

std::vector<SceneMethodRow> measure_scene(const Scene& scene, const SceneDataset& dataset,
                                          const std::vector<TableMethod>& methods) {
  std::vector<SceneMethodRow> rows;
  const std::size_t n = scene.patches.size();
  for (const TableMethod& method : methods) {
    const Values values = is_engine_method(method.spec) ? scene_by_engine(scene, method)
                                                        : scene_by_vertices(scene, dataset, method);
    SceneMethodRow row;
    row.table = evaluate(method.label, dataset,
                         [&](std::size_t i, std::size_t j) { return values.f[i * n + j]; });
    row.row = {method.label, row.table.front(), values.ns / double(2 * dataset.pairs.size())};
    rows.push_back(std::move(row));
  }
  return rows;
}

ErrorShare error_share(const std::vector<ErrorRow>& table, PairKind kind) {
  const auto squares = [](const ErrorRow& row) { return double(row.pairs) * rms(row) * rms(row); };
  ErrorShare result;
  for (const ErrorRow& row : table) {
    if (row.name != name(kind)) continue;
    result.pairs = row.pairs;
    const double all = squares(table.front());
    result.share = all > 0 ? squares(row) / all : 0;
  }
  return result;
}

}  // namespace host
