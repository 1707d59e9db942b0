#include "network/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.hpp"
#include "form_factor/reference.hpp"
#include "network/engine_pair.hpp"

namespace host {

namespace {

double factor(const urad_scene& scene, std::size_t i, std::size_t j, const urad_net* net) {
  urad_counters counters{};
  const urad::Patch from = urad::patch_at(scene, std::uint16_t(i));
  const urad::Patch to = urad::patch_at(scene, std::uint16_t(j));
  const std::int32_t exchange_q24 =
      urad::exchange_log2_q24(scene, from, to, urad::Kernel::moment, net, 0, &counters);
  return urad::form_factor_uq32(exchange_q24, from.shape->log2_area_q24) * 0x1p-32;
}

RowSums row_sums(const SceneDataset& dataset, const std::vector<Measured>& measured) {
  std::vector<double> exact(dataset.patches, 0), value(dataset.patches, 0);
  for (std::size_t k = 0; k < dataset.pairs.size(); ++k) {
    const ScenePair& pair = dataset.pairs[k];
    exact[pair.i] += measured[2 * k].exact, value[pair.i] += measured[2 * k].value;
    exact[pair.j] += measured[2 * k + 1].exact, value[pair.j] += measured[2 * k + 1].value;
  }
  RowSums sums;
  double rows = 0;
  for (std::size_t i = 0; i < dataset.patches; ++i) {
    if (!(exact[i] > 0)) continue;
    const double error = std::fabs(value[i] - exact[i]) / exact[i];
    sums.mean += error;
    sums.worst = std::max(sums.worst, error);
    rows += 1;
  }
  if (rows > 0) sums.mean /= rows;
  return sums;
}

}  // namespace

SceneMethod engine_method(const FixedScene& fixed, const urad_net* net) {
  return [&fixed, net](std::size_t i, std::size_t j) { return factor(fixed.pod(), i, j, net); };
}

PairMethod engine_method(const urad_net* net) {
  return [net](const Polygon& p, const Polygon& q) {
    return factor(FixedScene::of_polygons({p, q}, {}).pod(), 0, 1, net);
  };
}

std::vector<Measured> measure(const SceneDataset& dataset, const SceneMethod& method) {
  std::vector<Measured> measured;
  measured.reserve(2 * dataset.pairs.size());
  for (const ScenePair& pair : dataset.pairs) {
    measured.push_back({pair.f_ij, method(pair.i, pair.j), pair.kind});
    measured.push_back({pair.f_ji, method(pair.j, pair.i), pair.kind});
  }
  return measured;
}

std::vector<ErrorRow> evaluate(const std::string& name, const SceneDataset& dataset,
                               const SceneMethod& method) {
  const std::vector<Measured> measured = measure(dataset, method);
  std::vector<ErrorRow> table = error_table(name, measured);
  table.front().rows = row_sums(dataset, measured);
  return table;
}

ErrorRow evaluate_part(const std::string& name, const SceneDataset& dataset,
                       const std::vector<char>& use, char wanted, const SceneMethod& method) {
  SceneDataset part;
  for (const ScenePair& pair : dataset.pairs)
    if (use[pair.configuration] == wanted) part.pairs.push_back(pair);
  return error_row(name, measure(part, method));
}

std::vector<GeneralMeasurement> measure_general(const std::vector<PairMethod>& methods,
                                                std::uint64_t seed, std::size_t count,
                                                double far_rho, int threads) {
  std::vector<GeneralMeasurement> result;
  for (int f = 0; f < kPairFamilies; ++f) {
    const auto family = static_cast<PairFamily>(f);
    std::vector<std::vector<std::optional<Measured>>> seen(
        methods.size(), std::vector<std::optional<Measured>>(count));
    parallel_for(count, threads, [&](std::size_t k) {
      const PolygonPair pair = general_pair(family, seed, k);
      const FixedScene fixed = FixedScene::of_polygons({pair.p, pair.q}, {});
      const double exact = reference_form_factor(pair.p, pair.q);
      const auto engine = engine_pair(fixed.pod(), 0, 1);
      if (!engine || !(exact > 0)) return;
      const PairKind kind =
          kind_of(contact(pair.p, pair.q), engine->clipped, engine->rho(), far_rho);
      for (std::size_t m = 0; m < methods.size(); ++m)
        seen[m][k] = Measured{exact, methods[m](pair.p, pair.q), kind};
    });
    GeneralMeasurement measurement;
    measurement.family = family;
    for (const auto& one : seen) {
      measurement.by_method.emplace_back();
      for (const auto& measured : one)
        if (measured) measurement.by_method.back().push_back(*measured);
    }
    result.push_back(measurement);
  }
  return result;
}

std::string_view name(PairFamily family) {
  constexpr std::string_view names[] = {"free", "edge", "touching", "corner", "room", "rotated"};
  return names[int(family)];
}

}  // namespace host
