#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "form_factor/reference.hpp"
#include "legacy/experiments.hpp"
#include "method/engine_source.hpp"
#include "network/random.hpp"
#include "report/text.hpp"
#include "scene/builtin.hpp"
#include "scene/ray_scene.hpp"
#include "solve/embree_visibility.hpp"
#include "solve/exact.hpp"

namespace host {

namespace {

constexpr int kTruthRays = 16384, kMask = 64, kDepth = 3;

/// Two unit squares face to face, n x n patches each, and what stands between them.
Scene plates(const std::string& name, int n, const std::vector<Polygon>& between) {
  Scene scene;
  scene.name = name;
  scene.materials.emplace_back();
  for (int side = 0; side < 2; ++side) {
    Surface surface;
    surface.first_patch = int(scene.patches.size());
    surface.patch_count = n * n;
    for (int k = 0; k < n * n; ++k) {
      const int column = k % n, row = k / n;
      const double x = double(column) / n, y = double(row) / n, w = 1.0 / n, z = side;
      Polygon quad{{{x, y, z}, {x + w, y, z}, {x + w, y + w, z}, {x, y + w, z}}, {}};
      if (side) std::swap(quad.outer[1], quad.outer[3]);
      scene.patches.push_back({quad, moments(quad), side});
    }
    scene.surfaces.push_back(surface);
  }
  for (const Polygon& polygon : between) scene.blockers.push_back({polygon, -1});
  return scene;
}

Polygon upright(double x0, double x1, double y0, double y1, double z) {
  return {{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, {}};
}

std::vector<Polygon> slats() {
  std::vector<Polygon> all;
  all.reserve(5);
  for (int k = 0; k < 5; ++k) all.push_back(upright(0.2 * k + 0.03, 0.2 * k + 0.13, 0, 1, 0.4));
  return all;
}

/// A parallelogram piece of a patch.
struct Piece {
  Vec3 corner, u, v;
  Vec3 at(double s, double t) const { return corner + s * u + t * v; }
  double area() const { return glm::length(glm::cross(u, v)); }
};

Piece piece_of(const Polygon& quad) {
  return {quad.outer[0], quad.outer[1] - quad.outer[0], quad.outer[3] - quad.outer[0]};
}

bool is_parallelogram(const ScenePatch& patch) {
  const Loop& x = patch.polygon.outer;
  if (x.size() != 4 || !patch.polygon.holes.empty()) return false;
  return glm::length(x[0] - x[1] + x[2] - x[3]) <= 1e-9 * glm::length(x[2] - x[0]);
}

/// "If either all or none of the rays are obstructed, then either the full form factor is
/// calculated or it is zero"; else the larger piece is cut into four (section 5.1).
class AllOrNothing {
 public:
  AllOrNothing(const RayScene& rays, const ScenePatch& p, const ScenePatch& q)
      : rays_(rays), p_(p), q_(q) {}

  double fraction() {
    const Sum sum = visit(piece_of(p_.polygon), piece_of(q_.polygon), kDepth);
    return sum.whole > 0 ? sum.seen / sum.whole : 0;
  }
  std::int64_t shot() const { return shot_; }

 private:
  struct Sum {
    double seen = 0, whole = 0;
  };

  Sum visit(const Piece& p, const Piece& q, int depth) {
    constexpr double kPlace[5][2] = {{0.5, 0.5}, {0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}};
    int open = 0;
    for (const auto& place : kPlace) {
      ++shot_;
      open += !rays_.blocked(p.at(place[0], place[1]), q.at(place[0], place[1]), p_.surface,
                             q_.surface);
    }
    if (open > 0 && open < 5 && depth > 0) {
      Sum sum;
      const bool cut_p = p.area() >= q.area();
      const Piece& whole = cut_p ? p : q;
      for (int k = 0; k < 4; ++k) {
        const int column = k % 2, row = k / 2;
        const Piece part{whole.at(0.5 * column, 0.5 * row), 0.5 * whole.u, 0.5 * whole.v};
        const Sum inner = cut_p ? visit(part, q, depth - 1) : visit(p, part, depth - 1);
        sum.seen += inner.seen, sum.whole += inner.whole;
      }
      return sum;
    }
    // Pieces behind the other's plane have no part in the pair.
    const Vec3 r = q.at(0.5, 0.5) - p.at(0.5, 0.5);
    const double r2 = glm::dot(r, r);
    const double kernel = p.area() * q.area() * std::max(0.0, glm::dot(p_.moments.normal, r)) *
                          std::max(0.0, -glm::dot(q_.moments.normal, r)) / (r2 * r2);
    return {kernel * open / 5, kernel};
  }

  const RayScene& rays_;
  const ScenePatch &p_, &q_;
  std::int64_t shot_ = 0;
};

struct Pair {
  std::size_t i, j;
  double factor, visible;  ///< unoccluded F; truth
};

std::vector<Pair> pairs_of(const Scene& scene, std::size_t count,
                           const ExperimentRequest& request) {
  Random random(request.base.seed, 13);
  std::vector<Pair> pairs;
  const int n = int(scene.patches.size());
  while (pairs.size() < count) {
    const auto i = std::size_t(random.below(n)), j = std::size_t(random.below(n));
    const ScenePatch &a = scene.patches[i], &b = scene.patches[j];
    if (a.surface == b.surface || !is_parallelogram(a) || !is_parallelogram(b) || !can_face(a, b))
      continue;
    const double f = reference_form_factor(a.polygon, b.polygon);
    if (f > 0) pairs.push_back({i, j, f, 0});
  }
  const EmbreeVisibility truth(scene, kTruthRays);
  parallel_for(pairs.size(), request.base.threads,
               [&](std::size_t k) { pairs[k].visible = truth.fraction(pairs[k].i, pairs[k].j); });
  return pairs;
}

}  // namespace

ResultTable experiment_visibility(const ExperimentRequest& request) {
  ResultTable table{"experiment_visibility",
                    "Visibility: error of F against 16,384 rays a pair, and cost",
                    {"scene", "method", "rms error / rms F", "worst error / rms F",
                     "rms, half-seen pairs", "rays a pair", "us a pair"},
                    {},
                    {}};
  const auto count = std::size_t(std::max(60.0, 1500 * request.base.share));
  std::vector<Scene> scenes{
      plates("square between plates", 6, {upright(0.25, 0.75, 0.25, 0.75, 0.5)}),
      plates("slats between plates", 6, slats()), load_scene("cornell")};
  for (const Scene& scene : scenes) {
    const std::vector<Pair> pairs = pairs_of(scene, count, request);
    double level = 0;
    for (const Pair& pair : pairs) level += std::pow(pair.factor * pair.visible, 2);
    level = std::sqrt(level / double(pairs.size()));
    const auto add = [&](const std::string& method, double rays, auto&& fraction) {
      double squares = 0, half = 0, worst = 0;
      int halves = 0;
      const Stopwatch time;
      std::vector<double> seen;
      seen.reserve(pairs.size());
      for (const Pair& pair : pairs) seen.push_back(fraction(pair));
      const double us = 1e6 / double(pairs.size()) * time.seconds();
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        const double off = pairs[k].factor * (seen[k] - pairs[k].visible);
        squares += off * off;
        worst = std::max(worst, std::fabs(off));
        if (pairs[k].visible > 0.001 && pairs[k].visible < 0.999) half += off * off, ++halves;
      }
      table.rows.push_back(
          {scene.name, method, percent(std::sqrt(squares / double(pairs.size())) / level),
           percent(worst / level), percent(halves ? std::sqrt(half / halves) / level : 0),
           rays >= 0 ? fmt::format("{:.1f}", rays) : "-", fmt::format("{:.2f}", us)});
    };
    const RayScene blockers(scene.blockers);
    const auto surface = [&](std::size_t k) { return scene.patches[k].surface; };
    add("none: every pair sees", 0, [](const Pair&) { return 1.0; });
    add("one ray between the centres", 1, [&](const Pair& pair) {
      return blockers.blocked(scene.patches[pair.i].moments.centroid,
                              scene.patches[pair.j].moments.centroid, surface(pair.i),
                              surface(pair.j))
                 ? 0.0
                 : 1.0;
    });
    for (const int n : {4, 16, 64, 256}) {
      const EmbreeVisibility rays(scene, n);
      add(fmt::format("{} rays", n), n,
          [&](const Pair& pair) { return rays.fraction(pair.i, pair.j); });
    }
    std::int64_t shot = 0;
    add("all or nothing, cut to depth 3", -1, [&](const Pair& pair) {
      AllOrNothing method(blockers, scene.patches[pair.i], scene.patches[pair.j]);
      const double seen = method.fraction();
      shot += method.shot();
      return seen;
    });
    table.rows.back()[5] = fmt::format("{:.1f}", double(shot) / double(pairs.size()));
    const FixedScene fixed(scene);
    const EngineVisibility mask(fixed, kMask, 64);
    add(fmt::format("mask of hemicube:{} x factor", kMask), -1, [&](const Pair& pair) {
      return mask.fraction(std::uint16_t(pair.i), std::uint16_t(pair.j));
    });
    const NetChoice none{};
    const EngineRows rows =
        engine_rows(fixed, parse_method("hemicube:64"), none, {}, request.base.threads);
    add("hemicube:64 alone", -1,
        [&](const Pair& pair) { return rows(pair.i, pair.j) / pair.factor; });
    table.rows.back()[6] =
        fmt::format("{:.2f}", 1e6 * rows.seconds / double(rows.patches * rows.patches));
  }
  table.notes = {fmt::format(
      "{} random facing pairs a scene. Every method but the last multiplies the exact unoccluded "
      "factor by its visible fraction, so that only visibility is wrong; the last takes the "
      "hemicube's own factor. Half-seen: between 0.1 % and 99.9 % visible. Rays are spread over "
      "both "
      "patches by a lattice and weighted by the kernel. The mask's time is that of one hemicube a "
      "pair; over a whole row it is shared by all receivers. In the Cornell box the centre of a "
      "floor patch may lie under a block that its visible part faces: one ray then hides all of "
      "it. "
      "Time: of the processor.",
      count)};
  return table;
}

}  // namespace host
