#include "accuracy/network_trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "network/engine_pair.hpp"
#include "network/evaluate.hpp"
#include "network/quantise.hpp"
#include "network/train_net.hpp"
#include "scene/builtin.hpp"
#include "urad/network.hpp"

namespace host {

namespace {

/// F by a network in double: kernel, gate and thresholds are those of the engine.
double real_factor(const urad_scene& scene, std::size_t i, std::size_t j, const FloatNet& net,
                   const urad_net& limits, const std::function<double()>& by_engine) {
  const auto pair = engine_pair(scene, i, j);
  if (!pair || pair->clipped || pair->invariants.rho_uq16 > limits.near_rho_uq16 ||
      pair->invariants.rho_uq16 < limits.far_rho_uq16)
    return by_engine();
  const double log2_g = pair->log2_kernel() +
                        pair->invariants.gate_uq16 / 65536.0 * net.run(pair->invariants.input_q15);
  const urad::Patch from = urad::patch_at(scene, std::uint16_t(i));
  // Rounded as the engine delivers it: of small factors that is most of the error.
  const std::int32_t log2_g_q24 =
      std::min(std::int32_t(std::lround(log2_g * 0x1p24)), pair->limit_q24);
  return urad::form_factor_uq32(log2_g_q24, from.shape->log2_area_q24) * 0x1p-32;
}

struct Cube {
  Scene scene = load_scene("cube7");
  FixedScene fixed{scene};
  SceneDataset dataset;
  Cube(double far_rho, int threads)
      : dataset(scene_dataset(scene, fixed, far_rho, 1, 400000, threads)) {}
};

double deviation_apart(const std::vector<Measured>& measured) {
  std::vector<Measured> apart;
  for (const Measured& one : measured)
    if (one.kind != PairKind::edge) apart.push_back(one);
  return error_row("apart", apart).std;
}

NetworkTrial judged(const NetFile& file, const Cube& cube, const NetworkRequest& request) {
  NetworkTrial trial{file, {}, {}, {}};
  const urad_net &wide = trial.net.quantised16.pod(), &narrow = trial.net.quantised8.pod();
  const PairMethod by_wide = engine_method(&wide);
  const PairMethod by_real = [&](const Polygon& p, const Polygon& q) {
    const FixedScene scene = FixedScene::of_polygons({p, q}, {});
    return real_factor(scene.pod(), 0, 1, file.net, wide, [&] { return by_wide(p, q); });
  };
  const auto families = measure_general({by_real, by_wide, engine_method(&narrow)},
                                        general_seed(file.seed, PairUse::test), request.pairs,
                                        file.far_rho, request.threads);
  const SceneMethod cube_wide = engine_method(cube.fixed, &wide);
  const SceneMethod on_cube[] = {[&](std::size_t i, std::size_t j) {
                                   return real_factor(cube.fixed.pod(), i, j, file.net, wide,
                                                      [&] { return cube_wide(i, j); });
                                 },
                                 cube_wide, engine_method(cube.fixed, &narrow)};
  NetworkErrors* const forms[] = {&trial.real, &trial.int16, &trial.int8};
  for (std::size_t k = 0; k < std::size(forms); ++k) {
    std::vector<Measured> all;
    for (const GeneralMeasurement& family : families)
      all.insert(all.end(), family.by_method[k].begin(), family.by_method[k].end());
    forms[k]->pairs = error_row("pairs", all);
    forms[k]->cube = evaluate("cube7", cube.dataset, on_cube[k]).front();
    forms[k]->cube_apart_std = deviation_apart(measure(cube.dataset, on_cube[k]));
  }
  return trial;
}

/// The best of a width, or null.
const NetworkTrial* best_of(const std::vector<NetworkTrial>& trials, int hidden) {
  const NetworkTrial* best = nullptr;
  for (const NetworkTrial& trial : trials)
    if (trial.net.net.hidden() == hidden &&
        (!best || trial.int16.pairs.p95 < best->int16.pairs.p95))
      best = &trial;
  return best;
}

}  // namespace

std::vector<NetworkTrial> try_networks(const NetworkRequest& request) {
  TrainRequest train;
  train.effort = request.effort;
  train.threads = request.threads;
  const Cube cube(train.far_rho, request.threads);
  std::vector<NetworkTrial> trials;
  for (const int hidden : request.hidden)
    for (const std::uint64_t seed : request.seeds) {
      train.hidden = hidden;
      train.seed = seed;
      train.command = fmt::format("urad train --general --hidden {} --seed {}", hidden, seed);
      if (request.progress) request.progress(hidden, seed);
      const auto file = train_general_net(train);
      if (!file) throw Error(train.command + " was stopped");
      trials.push_back(judged(*file, cube, request));
    }
  return trials;
}

MethodTrials try_fronts(const NetworkRequest& request, const std::vector<NetworkTrial>& trials) {
  TrialRequest fronts;
  fronts.pairs = request.trials;
  fronts.threads = request.threads;
  for (const char* text :
       {"fixed-kernel", "fixed-moment", "fixed-lambert:1", "fixed-lambert:2", "fixed-lambert:3",
        "auto:0.1", "auto:0.03", "auto", "auto:0.003", "auto:0.001"})
    fronts.methods.push_back({text, parse_method(text), request.nets});
  if (request.nets.shipped_legacy)
    fronts.methods.push_back({"legacy:linear50", parse_method("legacy:linear50"), request.nets});
  std::vector<QuantisedNet> kept;  // methods point to them
  kept.reserve(2 * request.hidden.size());
  for (const int hidden : request.hidden) {
    const NetworkTrial* best = best_of(trials, hidden);
    if (!best) continue;
    for (const bool alone : {true, false}) {
      kept.push_back(alone ? with_near_rho(best->net.quantised16, 0) : best->net.quantised16);
      fronts.methods.push_back(
          {fmt::format("{} hidden, {}", hidden, alone ? "alone" : "handing over"),
           parse_method("net"),
           {{}, &kept.back().pod()}});
    }
  }
  return try_methods(fronts);
}

}  // namespace host
