#include "fixtures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "accuracy/pair_sets.hpp"
#include "form_factor/reference.hpp"
#include "network/random.hpp"
#include "scene/builtin.hpp"
#include "weights/cube7.h"
#include "weights/general.h"

namespace fixtures {

namespace {

constexpr std::uint64_t kSeed = 1996;
constexpr std::size_t kPerDecade = 1000, kRoomPairs = 5000;

PairSet cube_pairs() {
  PairSet set;
  const host::Scene& scene = set.scenes.emplace_back(host::load_scene("cube7"));
  const host::FixedScene& fixed = set.fixed.emplace_back(scene);
  for (std::uint16_t i = 0; i < scene.patches.size(); ++i) {
    for (std::uint16_t j = 0; j < i; ++j) {
      const host::ScenePatch &a = scene.patches[i], &b = scene.patches[j];
      if (a.surface == b.surface) continue;
      const double exchange = host::reference_exchange(a.polygon, b.polygon);
      set.pairs.push_back({&a.polygon, &b.polygon, &fixed, i, j, exchange / a.moments.area});
      set.pairs.push_back({&b.polygon, &a.polygon, &fixed, j, i, exchange / b.moments.area});
    }
  }
  return set;
}

void add(PairSet* set, const host::Polygon& p, const host::Polygon& q, double exact) {
  const host::Polygon& kept_p = set->polygons.emplace_back(p);
  const host::Polygon& kept_q = set->polygons.emplace_back(q);
  const host::FixedScene& fixed = set->fixed.emplace_back(host::FixedScene::of_polygons({p, q}, {}));
  set->pairs.push_back({&kept_p, &kept_q, &fixed, 0, 1, exact});
}

PairSet quads(const std::vector<host::PairSet>& drawn) {
  PairSet set;
  for (const host::PairSet& part : drawn) {
    for (std::size_t k = 0; k < part.pairs.size(); ++k) add(&set, part.pairs[k].p, part.pairs[k].q, part.exact[k]);
  }
  return set;
}

PairSet make(const std::string& name) {
  if (name == "cube") return cube_pairs();
  const std::uint64_t seed = host::general_seed(kSeed, host::PairUse::test);
  return quads(name == "free" ? host::free_quads_by_decade(seed, kPerDecade, 0)
                              : std::vector{host::room_pairs(seed, kRoomPairs, 0)});
}

const urad_net* shipped(const std::string& name) {
  return name == "general" ? &urad_general : name == "cube7" ? &urad_cube7 : nullptr;
}

}  // namespace

const host::NetChoice& nets() {
  static const host::NetChoice choice{shipped, nullptr};
  return choice;
}

const PairSet& pair_set(const std::string& name) {
  static std::map<std::string, PairSet> sets;
  const auto found = sets.find(name);
  if (found != sets.end()) return found->second;
  PairSet& set = sets[name] = make(name);
  host::Random(kSeed).shuffle(set.pairs);
  return set;
}

host::SceneSolver& solver(const std::string& scene) {
  static std::map<std::string, host::Scene> scenes;
  static std::map<std::string, host::SceneSolver> solvers;
  const auto found = solvers.find(scene);
  if (found != solvers.end()) return found->second;
  scenes.emplace(scene, host::load_scene(scene));
  return solvers.emplace(std::piecewise_construct, std::forward_as_tuple(scene),
                         std::forward_as_tuple(scenes.at(scene), 0, true)).first->second;
}

Errors errors(const std::vector<Pair>& pairs, const std::vector<double>& factors) {
  std::vector<double> relative;
  double squares = 0, most = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double error = std::fabs(factors[k] - pairs[k].exact);
    relative.push_back(error / pairs[k].exact);
    squares += error * error;
    most = std::max(most, error);
  }
  std::sort(relative.begin(), relative.end());
  const auto quantile = [&](double share) { return relative[std::size_t(share * double(relative.size() - 1) + 0.5)]; };
  return {quantile(0.5), quantile(0.95), quantile(0.99), std::sqrt(squares / double(pairs.size())), most};
}

void show(benchmark::State& state, const Errors& errors) {
  state.counters["rel_median"] = errors.median;
  state.counters["rel_p95"] = errors.p95;
  state.counters["rel_p99"] = errors.p99;
  state.counters["rms"] = errors.rms;
  state.counters["max"] = errors.max;
}

const std::optional<host::InstructionCounts>& instructions() {
  static const auto counts = [] {
    const char* named = std::getenv("URAD_ICOUNT");
    const std::string path = named ? named : URAD_SOURCE_DIR "/build/icount.json";
    std::optional<host::InstructionCounts> read;
    if (named || std::filesystem::exists(path)) read.emplace(path);
    return read;
  }();
  return counts;
}

void show_instructions(benchmark::State& state, const char* counter, std::optional<double> count) {
  if (count) state.counters[counter] = *count;
}

}  // namespace fixtures
