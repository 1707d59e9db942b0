#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/stopwatch.hpp"
#include "form_factor/reference.hpp"
#include "legacy/experiments.hpp"
#include "legacy/statistics.hpp"
#include "network/engine_pair.hpp"
#include "network/general_pairs.hpp"
#include "network/random.hpp"
#include "network/trainer.hpp"
#include "scene/fixed_scene.hpp"

namespace host {

namespace {

/// A rule of n x n points on a quad: places on [-1, 1] along both sides (bilinear), their weights,
/// and how much a kernel gives way when its two points are near.
struct Rule {
  std::string name;
  std::vector<double> place, weight;  ///< weights sum to 1
  double softening = 0;               ///< times sqrt(a b) / pi, added to r^2 once
};

/// Four corners and the normal: all that a rule reads.
struct Quad {
  std::array<Vec3, 4> corner;
  Vec3 normal;
  double area;
};

Quad quad_of(const Polygon& polygon) {
  const Moments m = moments(polygon);
  return {
      {polygon.outer[0], polygon.outer[1], polygon.outer[2], polygon.outer[3]}, m.normal, m.area};
}

Vec3 bilinear(const Quad& quad, double s, double t) {
  const double u = 0.5 * (1 + s), v = 0.5 * (1 + t);
  return (1 - u) * (1 - v) * quad.corner[0] + u * (1 - v) * quad.corner[1] +
         u * v * quad.corner[2] + (1 - u) * v * quad.corner[3];
}

/// First layer: points of both quads. Second: the kernel of each pair of points. Output: the sum.
double factor(const Rule& rule, const Quad& p, const Quad& q) {
  const std::size_t n = rule.place.size();
  Vec3 y[9];
  double share[9];
  for (std::size_t k = 0; k < n * n; ++k) {
    y[k] = bilinear(q, rule.place[k % n], rule.place[k / n]);
    share[k] = rule.weight[k % n] * rule.weight[k / n];
  }
  double sum = 0;
  for (std::size_t k = 0; k < n * n; ++k) {
    const Vec3 x = bilinear(p, rule.place[k % n], rule.place[k / n]);
    for (std::size_t l = 0; l < n * n; ++l) {
      const Vec3 r = y[l] - x;
      const double r2 = glm::dot(r, r), heights = glm::dot(p.normal, r) * -glm::dot(q.normal, r);
      if (heights <= 0) continue;
      const double a = p.area * share[k], b = q.area * share[l];
      const double soft = rule.softening * std::sqrt(a * b) * std::numbers::inv_pi;
      sum += share[k] * b * heights / (r2 * (r2 + soft));
    }
  }
  return sum * std::numbers::inv_pi;
}

struct Judged {
  Quad p, q;
  double exact;
  bool cube;
  Sample sample;  ///< for the correcting network; gate 0: it keeps out
};

Rule rule_of(int n, double outer, double outer_weight, double softening) {
  if (n == 1) return {"", {0}, {1}, softening};
  if (n == 2) return {"", {-outer, outer}, {0.5, 0.5}, softening};
  return {"", {-outer, 0, outer}, {outer_weight, 1 - 2 * outer_weight, outer_weight}, softening};
}

/// Mean of ln(1 + (log error / 0.02)^2): many small errors before few large ones.
double loss(const Rule& rule, const std::vector<Judged>& pairs) {
  double sum = 0;
  for (const Judged& pair : pairs) {
    const double f = factor(rule, pair.p, pair.q);
    const double e = std::log(std::max(f, 1e-12) / pair.exact) / 0.02;
    sum += std::log1p(e * e);
  }
  return sum / double(pairs.size());
}

/// Coordinate search with shrinking steps: three numbers at most are learned.
Rule learned(int n, const std::vector<Judged>& pairs, int passes) {
  std::array<double, 3> x{n == 2 ? 0.577 : 0.775, 5.0 / 18, 0.5}, step{0.05, 0.03, 0.3};
  const auto at = [&](const std::array<double, 3>& v) { return rule_of(n, v[0], v[1], v[2]); };
  double least = loss(at(x), pairs);
  for (int pass = 0; pass < passes; ++pass) {
    bool moved = false;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((k == 0 && n == 1) || (k == 1 && n != 3)) continue;
      for (const double sign : {1.0, -1.0}) {
        auto next = x;
        next[k] = std::max(0.0, next[k] + sign * step[k]);
        const double now = loss(at(next), pairs);
        if (now >= least) continue;
        least = now, x = next, moved = true;
        break;
      }
    }
    if (!moved)
      for (double& s : step) s /= 2;
  }
  Rule rule = at(x);
  rule.name = n == 1   ? fmt::format("1 point, softening {:.2f} learned", x[2])
              : n == 2 ? fmt::format("2 x 2 learned: {:.3f}, softening {:.2f}", x[0], x[2])
                       : fmt::format("3 x 3 learned: {:.3f}, weight {:.3f}, softening {:.2f}", x[0],
                                     x[1], x[2]);
  return rule;
}

/// A pair that both the reference and the engine let exchange light.
std::optional<Judged> judged(const Polygon& p, const Polygon& q, bool cube) {
  if (p.outer.size() != 4 || q.outer.size() != 4) return {};
  const FixedScene fixed = FixedScene::of_polygons({p, q}, {});
  const auto engine = engine_pair(fixed.pod(), 0, 1);
  if (!engine || engine->clipped) return {};
  Judged pair{quad_of(p), quad_of(q), reference_form_factor(p, q), cube, {}};
  if (!(pair.exact > 1e-9)) return {};
  std::copy_n(engine->invariants.input_q15, urad::kPairInputs, pair.sample.input_q15.begin());
  pair.sample.gate_uq16 = engine->invariants.gate_uq16;
  return pair;
}

/// Meshed rooms for training and test, the cube for test only.
std::vector<Judged> rooms(PairUse use, const ExperimentRequest& request, std::size_t count) {
  std::vector<Judged> pairs;
  const std::uint64_t seed = general_seed(request.base.seed, use);
  for (std::uint64_t k = 0; pairs.size() < count; ++k) {
    const PolygonPair pair = general_pair(k % 4 ? PairFamily::room : PairFamily::rotated, seed, k);
    if (auto found = judged(pair.p, pair.q, false)) pairs.push_back(*found);
  }
  return pairs;
}

FloatNet correction(const Rule& rule, std::vector<Judged> training, std::vector<Judged> validation,
                    const ExperimentRequest& request) {
  const auto set = [&](std::vector<Judged>& pairs) {
    TrainingSet result;
    for (Judged& pair : pairs) {
      const double f = factor(rule, pair.p, pair.q);
      if (!(f > 0)) continue;
      pair.sample.target = std::log2(pair.exact / f);
      result.samples.push_back(pair.sample);
    }
    return result;
  };
  TrainerSettings settings;
  settings.hidden = 8;
  settings.seed = request.base.seed;
  const int steps = std::max(2, int(std::lround(20 * request.base.share)));
  settings.stages = {{4, steps, 0}, {1, 2 * steps, 0.03}};
  settings.threads = request.base.threads;
  return *train(set(training), set(validation), settings);
}

}  // namespace

ResultTable experiment_sampling(const ExperimentRequest& request, const CubeExperiment& cube) {
  const auto share = [&](double count) {
    return std::size_t(std::max(60.0, count * request.base.share));
  };
  const auto training = rooms(PairUse::training, request, share(4000)),
             validation = rooms(PairUse::validation, request, share(1000));
  std::vector<Judged> test = rooms(PairUse::test, request, share(4000));
  Random random(request.base.seed, 12);
  for (std::size_t k = 0; k < share(6000);) {
    const int i = random.below(294), j = random.below(294);
    if (!(cube.exact(i, j) > 0)) continue;
    if (auto pair = judged(cube.scene.patches[std::size_t(i)].polygon,
                           cube.scene.patches[std::size_t(j)].polygon, true))
      test.push_back(*pair), ++k;
  }
  ResultTable table{"experiment_sampling",
                    "The network that samples both patches: points, a kernel per pair of points, a "
                    "sum; error of F and cost",
                    {"points", "rooms: median", "p95", "p99", "cube: median", "p99", "std",
                     "kernels", "ns a pair"},
                    {},
                    {}};
  const auto add = [&](const std::string& name, int n, auto&& run) {
    std::array<std::vector<double>, 2> relative;
    std::vector<double> off;
    const Stopwatch time;
    for (const Judged& pair : test) {
      const double f = run(pair);
      relative[pair.cube].push_back(std::fabs(f - pair.exact) / pair.exact);
      if (pair.cube) off.push_back(f - pair.exact);
    }
    const double ns = 1e9 / double(test.size()) * time.seconds();
    const auto quantile = [&](bool of_cube, double part) {
      auto& values = relative[of_cube];
      std::sort(values.begin(), values.end());
      return fmt::format("{:.2g} %", 100 * values[std::size_t(part * double(values.size() - 1))]);
    };
    table.rows.push_back({name, quantile(false, 0.5), quantile(false, 0.95), quantile(false, 0.99),
                          quantile(true, 0.5), quantile(true, 0.99), short_number(summary(off).std),
                          std::to_string(n * n * n * n), fmt::format("{:.0f}", ns)});
  };
  const double third = 5.0 / 18, inner = std::sqrt(1.0 / 3), far = std::sqrt(0.6);
  const std::array gauss{rule_of(1, 0, 0, 0), rule_of(2, inner, 0, 0), rule_of(3, far, third, 0)};
  const int passes = std::max(4, int(std::lround(30 * request.base.share)));
  for (int n = 1; n <= 3; ++n) {
    const Rule& plain = gauss[std::size_t(n - 1)];
    add(n == 1 ? "1 point" : fmt::format("{} x {} Gauss", n, n), n,
        [&](const Judged& pair) { return factor(plain, pair.p, pair.q); });
    const Rule rule = learned(n, training, passes);
    add(rule.name, n, [&](const Judged& pair) { return factor(rule, pair.p, pair.q); });
    if (n > 2) continue;
    for (const Rule* base : {&plain, &rule}) {
      const FloatNet net = correction(*base, training, validation, request);
      add(fmt::format("{}, corrected by 14-8-1",
                      base == &plain ? "the plain one" : "the learned one"),
          n, [&](const Judged& pair) {
            return factor(*base, pair.p, pair.q) *
                   std::exp2(pair.sample.gate() * net.run(pair.sample.input_q15.data()));
          });
    }
  }
  table.notes = {fmt::format(
      "Learned on {} pairs of meshed rooms (places, weight and softening by a robust log error; "
      "the correcting network by Levenberg and Marquardt on the engine's invariants, faded out "
      "with "
      "distance), tested on {} others and on pairs of the cube, which neither saw; no clipped "
      "pairs. Time: the sum alone with the network where there is one, invariants not counted.",
      training.size(), test.size())};
  return table;
}

}  // namespace host
