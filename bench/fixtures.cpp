#include "fixtures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "form_factor/lambert.hpp"
#include "form_factor/reference.hpp"
#include "geometry/validate.hpp"
#include "network/general_pairs.hpp"
#include "network/random.hpp"
#include "scene/builtin.hpp"
#include "weights/cornell.h"
#include "weights/cube7.h"
#include "weights/general.h"
#include "weights/legacy_linear15.h"
#include "weights/legacy_linear30.h"
#include "weights/legacy_linear5.h"
#include "weights/legacy_linear50.h"
#include "weights/legacy_log15.h"
#include "weights/legacy_log30.h"
#include "weights/legacy_log5.h"

namespace fixtures {

namespace {

using host::Polygon;
using host::Random;
using host::Vec3;

constexpr std::uint64_t kSeed = 1996;
constexpr std::size_t kPerDecade = 1000, kRoomPairs = 5000;
constexpr std::array kDecades = {1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1.0};

PairSet cube_pairs() {
  PairSet set;
  const host::Scene& scene = set.scenes.emplace_back(host::load_scene("cube7"));
  const host::FixedScene& fixed = set.fixed.emplace_back(scene);
  for (std::uint16_t i = 0; i < fixed.pod().patch_count; ++i) {
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

void add(PairSet* set, const Polygon& p, const Polygon& q, double exact) {
  const Polygon& kept_p = set->polygons.emplace_back(p);
  const Polygon& kept_q = set->polygons.emplace_back(q);
  const host::FixedScene& fixed =
      set->fixed.emplace_back(host::FixedScene::of_polygons({p, q}, {}));
  set->pairs.push_back({&kept_p, &kept_q, &fixed, 0, 1, exact});
}

Vec3 direction(Random& random) {
  return glm::normalize(Vec3(random.normal(), random.normal(), random.normal()));
}

/// Four corners by a random walk from `x` about a random plane; none when it leaves the unit cube,
/// crosses itself or is a sliver.
std::optional<Polygon> random_quad(Random& random, Vec3 x) {
  const Vec3 normal = direction(random), u = glm::normalize(glm::cross(normal, direction(random)));
  const Vec3 v = glm::cross(normal, u);
  const double step = random.log_uniform(0.05, 1);
  Polygon quad;
  for (int k = 0; k < 4; ++k) {
    if (glm::any(glm::lessThan(x, Vec3(0))) || glm::any(glm::greaterThan(x, Vec3(1)))) return {};
    quad.outer.push_back(x);
    x += step * (random.uniform(-1, 1) * u + random.uniform(-1, 1) * v);
  }
  if (host::validate(quad) != host::PolygonStatus::ok || host::moments(quad).area < 1e-4) return {};
  return quad;
}

/// 1 in front of the plane, -1 behind it, 0 across or on it.
int side(const Polygon& quad, const Polygon& plane) {
  constexpr double kMargin = 1e-3;
  const host::Moments moments = host::moments(plane);
  int sum = 0;
  for (const Vec3& x : quad.outer) {
    const double distance = glm::dot(moments.normal, x - moments.centroid);
    sum += distance > kMargin ? 1 : distance < -kMargin ? -1 : 0;
  }
  return sum / 4;
}

/// The lit sides face each other. The second one starts nearer or farther: else large factors would
/// hardly come up.
std::optional<std::pair<Polygon, Polygon>> random_quads(Random& random) {
  const Vec3 start(random.uniform(), random.uniform(), random.uniform());
  std::optional<Polygon> p = random_quad(random, start);
  if (!p) return {};
  std::optional<Polygon> q =
      random_quad(random, start + random.log_uniform(0.02, 1) * direction(random));
  if (!q) return {};
  const int p_side = side(*p, *q), q_side = side(*q, *p);
  if (p_side == 0 || q_side == 0) return {};
  if (p_side < 0) std::reverse(q->outer.begin(), q->outer.end());
  if (q_side < 0) std::reverse(p->outer.begin(), p->outer.end());
  return std::pair{*p, *q};
}

PairSet free_pairs() {
  PairSet set;
  Random random(kSeed);
  std::array<std::size_t, kDecades.size() + 1> count{};
  const auto in_decade = [&](double f) {
    const auto decade =
        std::size_t(std::upper_bound(kDecades.begin(), kDecades.end(), f) - kDecades.begin());
    return decade == 0 || decade == kDecades.size() ? nullptr : &count[decade];
  };
  const auto wanted = [&](double f) { return in_decade(f) && *in_decade(f) < kPerDecade; };
  while (set.pairs.size() < kPerDecade * (kDecades.size() - 1)) {
    const auto quads = random_quads(random);
    if (!quads) continue;
    const double about = host::lambert_estimate(quads->first, quads->second, 1).f;
    if (!wanted(about / 2) && !wanted(about) && !wanted(about * 2))
      continue;  // saves the reference
    const double exact = host::reference_form_factor(quads->first, quads->second);
    if (!wanted(exact)) continue;
    ++*in_decade(exact);
    add(&set, quads->first, quads->second, exact);
  }
  return set;
}

PairSet room_pairs() {
  PairSet set;
  const std::uint64_t seed = host::general_seed(kSeed, host::PairUse::test);
  for (std::uint64_t k = 0; set.pairs.size() < kRoomPairs; ++k) {
    const host::PolygonPair pair = host::general_pair(host::PairFamily::room, seed, k);
    const double exact = host::reference_form_factor(pair.p, pair.q);
    if (exact > 0) add(&set, pair.p, pair.q, exact);
  }
  return set;
}

const urad_legacy_net* shipped_legacy(const std::string& name) {
  static const std::map<std::string, const urad_legacy_net*> nets = {
      {"linear50", &urad_legacy_linear50}, {"linear30", &urad_legacy_linear30},
      {"linear15", &urad_legacy_linear15}, {"linear5", &urad_legacy_linear5},
      {"log30", &urad_legacy_log30},       {"log15", &urad_legacy_log15},
      {"log5", &urad_legacy_log5}};
  const auto found = nets.find(name);
  return found == nets.end() ? nullptr : found->second;
}

const urad_net* shipped(const std::string& name) {
  static const std::map<std::string, const urad_net*> nets = {
      {"general", &urad_general}, {"cube7", &urad_cube7}, {"cornell", &urad_cornell}};
  const auto found = nets.find(name);
  return found == nets.end() ? nullptr : found->second;
}

}  // namespace

const host::NetChoice& nets() {
  static const host::NetChoice choice{shipped, nullptr, shipped_legacy};
  return choice;
}

const PairSet& pair_set(const std::string& name) {
  static std::map<std::string, PairSet> sets;
  const auto found = sets.find(name);
  if (found != sets.end()) return found->second;
  PairSet& set = sets[name] = name == "cube"   ? cube_pairs()
                              : name == "free" ? free_pairs()
                                               : room_pairs();
  Random(kSeed).shuffle(set.pairs);
  return set;
}

host::SceneSolver& solver(const std::string& scene) {
  static std::map<std::string, host::Scene> scenes;
  static std::map<std::string, host::SceneSolver> solvers;
  const auto found = solvers.find(scene);
  if (found != solvers.end()) return found->second;
  scenes.emplace(scene, host::load_scene(scene));
  return solvers
      .emplace(std::piecewise_construct, std::forward_as_tuple(scene),
               std::forward_as_tuple(scenes.at(scene), 0, true))
      .first->second;
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
  const auto quantile = [&](double share) {
    return relative[std::size_t(share * double(relative.size() - 1) + 0.5)];
  };
  return {quantile(0.5), quantile(0.95), quantile(0.99), std::sqrt(squares / double(pairs.size())),
          most};
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
