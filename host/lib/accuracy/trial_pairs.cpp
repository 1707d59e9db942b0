#include "accuracy/trial_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "accuracy/pair_families.hpp"
#include "base/parallel.hpp"
#include "form_factor/reference.hpp"
#include "geometry/validate.hpp"
#include "network/random_direction.hpp"

namespace host {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kTries = 60;
constexpr double kLeastAspect = 1.0 / 20, kMostAspect = 20;

/// Free place and attitude, p and q in either order: no coordinate is 0 by chance of the recipe.
PolygonPair placed(PolygonPair pair, Random& random) {
  const glm::dmat3 turn = random_rotation(random);
  const Vec3 shift(random.uniform(), random.uniform(), random.uniform());
  for (Polygon* polygon : {&pair.p, &pair.q})
    for (Vec3& x : polygon->outer) x = turn * x + shift;
  if (random.below(2)) std::swap(pair.p, pair.q);
  return pair;
}

PolygonPair quads(Random& random, bool concave) {
  for (;;) {
    PolygonPair pair = random_facing_quads(random);
    if ((is_concave(pair.p) || is_concave(pair.q)) == concave) return pair;
  }
}

double aspect(Random& random) { return random.log_uniform(kLeastAspect, kMostAspect); }
double angle(Random& random) { return random.uniform(1, 179); }

/// Two walls that meet, or nearly meet, in the y axis: from `along` on, `gap` away from it.
PolygonPair walls(double degrees, double w, double h, double along, double length, double gap) {
  const double t = degrees * kPi / 180;
  const Vec3 out(std::cos(t), 0, std::sin(t)), y(0, 1, 0);
  const Vec3 from = gap * out + along * y;
  return {rectangle(w, 1),
          {{from, from + length * y, from + length * y + h * out, from + h * out}, {}}};
}

PolygonPair shared_edge(Random& random) {
  return placed(walls(angle(random), aspect(random), aspect(random), 0, 1, 0), random);
}

PolygonPair part_of_edge(Random& random) {
  const double length = random.log_uniform(0.2, 5);
  const double along = random.uniform(-0.98 * length, 0.98);
  return placed(walls(angle(random), random.log_uniform(0.1, 10), random.log_uniform(0.1, 10),
                      along, length, 0),
                random);
}

PolygonPair shared_vertex(Random& random) {
  const double length = random.log_uniform(0.2, 5);
  return placed(walls(angle(random), random.log_uniform(0.1, 10), random.log_uniform(0.1, 10),
                      random.below(2) ? 1 : -length, length, 0),
                random);
}

PolygonPair nearly_touching(Random& random) {
  const double length = random.log_uniform(0.5, 2);
  return placed(walls(angle(random), random.log_uniform(0.2, 5), random.log_uniform(0.2, 5),
                      random.uniform(-length, 1), length, random.log_uniform(1e-4, 0.3)),
                random);
}

/// A plane of one cuts the other.
PolygonPair partly_behind(Random& random) {
  const auto cuts = [](const Polygon& plane, const Polygon& polygon) {
    const Moments m = moments(plane);
    double low = 0, high = 0;
    for (const Vec3& x : polygon.outer) {
      const double height = glm::dot(m.normal, x - m.centroid);
      low = std::min(low, height), high = std::max(high, height);
    }
    return low < -0.01 * high && high > -0.01 * low;
  };
  for (;;) {
    PolygonPair pair{random_quad(random), random_quad(random)};
    if (cuts(pair.p, pair.q) || cuts(pair.q, pair.p)) return pair;
  }
}

/// A thin strip before a freely turned rectangle.
PolygonPair slivers(Random& random) {
  const double thin = random.log_uniform(1e-3, 0.03);
  PolygonPair pair{rectangle(1, thin), rectangle(random.log_uniform(0.1, 1), 1)};
  const glm::dmat3 turn = random_rotation(random);
  const Vec3 shift(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1.5));
  for (Vec3& x : pair.q.outer) x = turn * x + shift;
  return placed(pair, random);
}

/// Areas 10 to 1e6 times as large as each other.
PolygonPair size_ratios(Random& random) {
  const double small = std::sqrt(random.log_uniform(1e-6, 0.1));
  PolygonPair pair{rectangle(small, small * random.log_uniform(0.3, 3)),
                   rectangle(1, 1, 0, -0.5, -0.5)};
  const glm::dmat3 turn = random_rotation(random);
  const Vec3 shift = random_direction(random) * random.log_uniform(0.1, 3);
  for (Vec3& x : pair.q.outer) x = turn * x + shift;
  return placed(pair, random);
}

/// As buildings have them: many sides and shifts in small ratios, so that much cancels by symmetry.
PolygonPair aligned_rectangles(Random& random) {
  const auto one_of = [&](const auto& values) {
    return values[random.below(int(std::size(values)))];
  };
  constexpr double kSides[] = {1, 1, 1, 2, 0.5, 3, 0.1};
  constexpr double kDegrees[] = {90, 90, 90, 45, 135, 60, 120};
  const auto side = [&] { return random.below(3) ? one_of(kSides) : random.log_uniform(0.05, 10); };
  const double w = side(), h = side(), u = side(), v = side();
  const double gap = random.log_uniform(1e-3, 5);
  if (random.below(2)) {  // a wall over a floor, moved apart in one or both directions
    const double length = random.below(2) ? 1 : v;
    const double beside[] = {0, (1 - length) / 2, (1 - length) / 2, 1};
    PolygonPair pair = walls(one_of(kDegrees), w, u, one_of(beside), length, gap);
    if (random.below(2))
      for (Vec3& x : pair.p.outer) x.x += gap;
    return placed(pair, random);
  }
  const double x[] = {0, (w - u) / 2, (w - u) / 2, w}, y[] = {0, (h - v) / 2, (h - v) / 2, h};
  return placed({rectangle(w, h), flipped(rectangle(u, v, gap, one_of(x), one_of(y)))}, random);
}

Polygon regular(int corners, Random& random) {
  Polygon polygon;
  const double stretch = random.log_uniform(0.4, 2.5), turn = random.uniform(0, 2 * kPi);
  for (int k = 0; k < corners; ++k) {
    const double t = turn + 2 * kPi * (k + random.uniform(-0.2, 0.2)) / corners;
    polygon.outer.push_back({stretch * std::cos(t), std::sin(t), 0});
  }
  return polygon;
}

PolygonPair few_corners(Random& random) {
  PolygonPair pair{regular(3, random), regular(random.below(2) ? 3 : 5, random)};
  const glm::dmat3 turn = random_rotation(random);
  const Vec3 shift = random_direction(random) * random.log_uniform(0.5, 10);
  const double size = random.log_uniform(0.3, 1);
  for (Vec3& x : pair.q.outer) x = turn * (size * x) + shift;
  return placed(pair, random);
}

PolygonPair close_plates(Random& random) {
  const double gap = random.log_uniform(0.02, 0.5);
  return placed({rectangle(random.log_uniform(0.3, 3), random.log_uniform(0.3, 3)),
                 flipped(rectangle(random.log_uniform(0.3, 3), random.log_uniform(0.3, 3), gap,
                                   random.uniform(-1, 1), random.uniform(-1, 1)))},
                random);
}

}  // namespace

int trial_decade(double f) {
  return std::clamp(int(std::floor(std::log10(f))) + kTrialDecades, 0, kTrialDecades - 1);
}

std::vector<TrialFamily> trial_families() {
  return {
      {"random quads, convex", [](Random& r) { return quads(r, false); }},
      {"random quads, concave", [](Random& r) { return quads(r, true); }},
      {"two walls of a room",
       [](Random& r) {
         return general_pair(PairFamily::room, std::uint64_t(r.uniform() * 0x1p53), 0);
       }},
      {"shared edge", shared_edge},
      {"part of an edge shared", part_of_edge},
      {"shared vertex", shared_vertex},
      {"nearly touching", nearly_touching},
      {"partly behind", partly_behind},
      {"slivers", slivers},
      {"size ratios to 1e6", size_ratios},
      {"aligned rectangles", aligned_rectangles},
      {"triangles and pentagons", few_corners, true},
      {"close plates", close_plates, true},
      {"turned rectangles",
       [](Random& r) {
         return general_pair(PairFamily::rotated, std::uint64_t(r.uniform() * 0x1p53), 0);
       },
       true},
  };
}

PairSet trial_pairs(const TrialFamily& family, TrialUse use, std::uint64_t seed, std::size_t count,
                    int threads) {
  PairSet set{family.name, std::vector<PolygonPair>(count), std::vector<double>(count)};
  std::uint64_t salt = 0;
  for (const char c : family.name) salt = salt * 31 + std::uint64_t(c);
  parallel_for(count, threads, [&](std::size_t k) {
    Random random(2 * seed + std::uint64_t(use) + (salt << 16), k);
    const int wanted = int(k % kTrialDecades);  // small factors are rare: look for them
    for (int tries = 0; set.exact[k] == 0 || tries < kTries; ++tries) {
      const PolygonPair pair = family.draw(random);
      const double exact = reference_form_factor(pair.p, pair.q);
      if (exact < kLeastTrialFactor) continue;
      set.pairs[k] = pair;
      set.exact[k] = exact;
      if (trial_decade(exact) == wanted) return;
    }
  });
  return set;
}

}  // namespace host
