#include "network/scene_dataset.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "form_factor/reference.hpp"
#include "network/engine_pair.hpp"
#include "network/random.hpp"

namespace host {

namespace {

constexpr double kSmallFactorShare = 0.02;
constexpr double kRowWeight = 1;

std::vector<ScenePair> candidates(const Scene& scene, std::uint64_t seed, std::size_t limit) {
  std::vector<ScenePair> pairs;
  const std::size_t n = scene.patches.size();
  // Above the limit every pair is kept with the same probability, so that memory stays bounded.
  const double all = double(n) * double(n - 1) / 2;
  const double keep = all > double(limit) ? double(limit) / all : 1;
  Random random(seed, 77);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const int surface = scene.patches[i].surface;
      if (surface == scene.patches[j].surface && scene.surfaces[std::size_t(surface)].planar)
        continue;
      if (keep < 1 && random.uniform() >= keep) continue;
      ScenePair pair;
      pair.i = std::uint32_t(i), pair.j = std::uint32_t(j);
      pairs.push_back(pair);
    }
  return pairs;
}

// What the engine would run the network on; the order makes a configuration.
struct Bits {
  std::array<std::int16_t, urad::kPairInputs> input;
  std::uint16_t gate;
  auto operator<=>(const Bits&) const = default;
};

}  // namespace

SceneDataset scene_dataset(const Scene& scene, const FixedScene& fixed, double far_rho,
                           std::uint64_t seed, std::size_t limit, int threads) {
  if (scene.patches.size() > 65535) throw Error("a scene has at most 65535 patches");
  SceneDataset dataset;
  dataset.patches = scene.patches.size();
  dataset.far_rho = far_rho;
  const std::vector<ScenePair> all = candidates(scene, seed, limit);
  std::vector<std::optional<Sample>> seen(all.size());
  std::vector<ScenePair> measured = all;
  const double log2_unit = 2 * std::log2(fixed.units_per_length());
  const auto far_rho_uq16 = std::uint32_t(std::lround(far_rho * 65536));

  parallel_for(all.size(), threads, [&](std::size_t k) {
    ScenePair& pair = measured[k];
    const auto engine = engine_pair(fixed.pod(), pair.i, pair.j);
    if (!engine) return;
    const ScenePatch &p = scene.patches[pair.i], &q = scene.patches[pair.j];
    const double exchange = reference_exchange(p.polygon, q.polygon);
    if (!(exchange > 0)) return;
    pair.f_ij = exchange / p.moments.area;
    pair.f_ji = exchange / q.moments.area;
    pair.rho = engine->rho();
    pair.clipped = engine->clipped;
    pair.kind = kind_of(contact(p.polygon, q.polygon), engine->clipped, engine->rho(), far_rho);
    Sample sample;
    std::copy_n(engine->invariants.input_q15, urad::kPairInputs, sample.input_q15.begin());
    sample.gate_uq16 = engine->invariants.rho_uq16 < far_rho_uq16 ? std::uint16_t{0}
                                                                  : engine->invariants.gate_uq16;
    sample.target = std::log2(exchange) + log2_unit - engine->log2_kernel();
    sample.weight = 0;
    seen[k] = sample;
  });

  std::map<Bits, std::uint32_t> numbers;
  for (const auto& sample : seen)
    if (sample) numbers.emplace(Bits{sample->input_q15, sample->gate_uq16}, 0);
  std::uint32_t next = 0;
  for (auto& [bits, number] : numbers) number = next++;
  dataset.configurations.resize(numbers.size());
  std::vector<double> weight(numbers.size(), 0);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (!seen[k]) continue;
    ScenePair& pair = measured[k];
    pair.configuration = numbers.at(Bits{seen[k]->input_q15, seen[k]->gate_uq16});
    Sample& configuration = dataset.configurations[pair.configuration];
    double& sum = weight[pair.configuration];
    const double f2 = pair.f_ij * pair.f_ij + pair.f_ji * pair.f_ji;
    const double target = configuration.target;
    configuration = *seen[k];
    configuration.target = (target * sum + seen[k]->target * f2) / (sum + f2);
    sum += f2;
    dataset.pairs.push_back(pair);
  }
  return dataset;
}

TrainingSet scene_training_set(const SceneDataset& dataset, const std::vector<char>& use,
                               double near_rho) {
  TrainingSet set;
  set.samples = dataset.configurations;
  if (near_rho > 0) {
    std::vector<char> kept(set.samples.size(), 0);
    for (const ScenePair& pair : dataset.pairs)
      if (!handed_over(pair, near_rho)) kept[pair.configuration] = 1;
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (!kept[k]) set.samples[k].gate_uq16 = 0;
  }
  double sum_f = 0, sum_f2 = 0;
  for (const ScenePair& pair : dataset.pairs) {
    sum_f += pair.f_ij + pair.f_ji;
    sum_f2 += pair.f_ij * pair.f_ij + pair.f_ji * pair.f_ji;
  }
  for (const ScenePair& pair : dataset.pairs) {
    if (!use[pair.configuration] || handed_over(pair, near_rho)) continue;
    set.samples[pair.configuration].weight +=
        (pair.f_ij * pair.f_ij + pair.f_ji * pair.f_ji) / sum_f2 +
        kSmallFactorShare * (pair.f_ij + pair.f_ji) / sum_f;
  }
  if (std::find(use.begin(), use.end(), char{0}) == use.end()) {
    set.rows = std::uint32_t(dataset.patches);
    set.row_weight = kRowWeight;
    for (const ScenePair& pair : dataset.pairs) {
      if (handed_over(pair, near_rho)) continue;
      set.row_terms.push_back({pair.i, pair.configuration, pair.f_ij});
      set.row_terms.push_back({pair.j, pair.configuration, pair.f_ji});
    }
    std::stable_sort(set.row_terms.begin(), set.row_terms.end(),
                     [](const RowTerm& a, const RowTerm& b) { return a.sample < b.sample; });
  }
  return set;
}

std::vector<char> hold_out(const SceneDataset& dataset, double share, std::uint64_t seed) {
  std::vector<std::size_t> order(dataset.configurations.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  Random random(seed, 78);
  random.shuffle(order);
  std::vector<char> use(order.size(), 1);
  const auto held = std::size_t(std::lround(share * double(order.size())));
  for (std::size_t k = 0; k < held; ++k) use[order[k]] = 0;
  return use;
}

}  // namespace host
