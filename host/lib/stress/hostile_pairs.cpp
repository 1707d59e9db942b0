#include "stress/hostile_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "accuracy/pair_families.hpp"
#include "network/random_direction.hpp"

namespace host {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = 180 / kPi;

template <class Map>
PolygonPair mapped(PolygonPair pair, const Map& map) {
  for (Polygon* polygon : {&pair.p, &pair.q}) {
    for (Vec3& x : polygon->outer) x = map(x);
    for (Loop& hole : polygon->holes)
      for (Vec3& x : hole) x = map(x);
  }
  return pair;
}

PolygonPair placed(const PolygonPair& pair, Random& random) {
  if (random.below(4) == 0) return pair;
  const glm::dmat3 turn = random_rotation(random);
  const Vec3 shift = random_point(random);
  return mapped(pair, [&](const Vec3& v) { return turn * v + shift; });
}

double side(Random& random) { return random.log_uniform(0.1, 10); }

PolygonPair wedge(Random& random) {
  const double near = random.log_uniform(1e-6, kPi / 2);
  const double angle = random.below(2) ? near : kPi - near;
  const double w = side(random), h = side(random);
  return hinge(angle * kDegree, w, h, side(random));
}

/// A plate over another, turned in its plane and tilted out of it, at a gap.
PolygonPair plates(Random& random, double gap, double turn, double tilt, double size) {
  const double w = side(random), h = side(random);
  PolygonPair pair{rectangle(w, h), flipped(rectangle(w * size, h * size))};
  const double up = random.uniform(-0.5, 1) * h;
  const Vec3 shift(random.uniform(-0.5, 1) * w, up, gap);
  for (Vec3& x : pair.q.outer) {
    const double u = std::cos(turn) * x.x - std::sin(turn) * x.y;
    const double v = std::sin(turn) * x.x + std::cos(turn) * x.y;
    x = Vec3(u, std::cos(tilt) * v, std::sin(tilt) * v) + shift;
  }
  return pair;
}

PolygonPair near_parallel(Random& random) {
  const double turn = random.log_uniform(1e-16, 1e-4), tilt = random.log_uniform(1e-16, 1e-4);
  const bool tilted = random.below(3) != 0, turned = random.below(3) != 0;
  return plates(random, side(random), turned ? turn : 0, tilted ? tilt : 0, 1);
}

PolygonPair close_plates(Random& random) {
  const double size = random.log_uniform(0.1, 10), turn = random.uniform(0, kPi);
  return plates(random, random.log_uniform(1e-9, 1e-2), turn, 0, size);
}

PolygonPair of_sizes(Random& random) {
  const double size = random.log_uniform(1e-9, 1);
  const double tilt = random.uniform(-1, 1), turn = random.uniform(0, kPi);
  const double gap = side(random) * std::pow(size, random.uniform());
  PolygonPair pair = plates(random, gap, turn, tilt, size);
  if (random.below(2)) std::swap(pair.p, pair.q);
  return pair;
}

PolygonPair slivers(Random& random) {
  const double thin = random.log_uniform(1e-6, 0.1), length = side(random);
  const double other = random.below(2) ? thin : side(random);
  if (random.below(3) == 0) return hinge(random.uniform(1, 179), thin, other, length);
  PolygonPair pair{rectangle(thin, length), flipped(rectangle(length, other))};
  const double gap = random.log_uniform(1e-3, 10), y = random.uniform(-1, 1);
  const Vec3 shift(random.uniform(-1, 1), y, gap);
  for (Vec3& x : pair.q.outer) x += shift;
  return pair;
}

/// A star about a point: concave as a rule, and it never crosses itself.
Loop star(int corners, double spread, Random& random) {
  Loop loop;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * kPi * (k + 0.8 * random.uniform()) / corners;
    const double radius = random.log_uniform(spread, 1);
    loop.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return loop;
}

PolygonPair facing(const Loop& below, Loop above, Random& random) {
  std::reverse(above.begin(), above.end());
  const double tilt = random.uniform(-0.5, 0.5);
  const double gap = random.log_uniform(0.05, 5), y = random.uniform(-1, 1);
  const Vec3 shift(random.uniform(-1, 1), y, gap);
  for (Vec3& x : above) x = Vec3(x.x, std::cos(tilt) * x.y, std::sin(tilt) * x.y) + shift;
  return {{below, {}}, {above, {}}};
}

PolygonPair stars(Random& random) {
  const Loop below = star(3 + random.below(62), 0.2, random);
  return facing(below, star(3 + random.below(62), 0.2, random), random);
}

PolygonPair with_holes(Random& random) {
  PolygonPair pair = plates(random, side(random), 0, 0, 1);
  const Vec3 origin = pair.p.outer[0], u = pair.p.outer[1] - origin, v = pair.p.outer[3] - origin;
  const int count = 1 + random.below(4);
  for (int k = 0; k < count; ++k) {
    Loop hole;
    for (const Vec3& x : star(3 + random.below(6), 0.3, random))
      hole.push_back(origin + (k + 0.5 + 0.4 * x.x) / count * u + (0.5 + 0.4 * x.y) * v);
    if (random.below(2)) std::reverse(hole.begin(), hole.end());
    pair.p.holes.push_back(hole);
  }
  return pair;
}

PolygonPair any_plain(Random& random) {
  return random.below(2) ? wedge(random) : random_facing_quads(random);
}

PolygonPair collinear(Random& random) {
  PolygonPair pair = any_plain(random);
  for (Polygon* polygon : {&pair.p, &pair.q}) {
    const auto k = std::size_t(random.below(int(polygon->outer.size())));
    const Vec3 a = polygon->outer[k], b = polygon->outer[(k + 1) % polygon->outer.size()];
    polygon->outer.insert(polygon->outer.begin() + std::ptrdiff_t(k) + 1,
                          a + random.uniform(0.01, 0.99) * (b - a));
  }
  return pair;
}

PolygonPair repeated(Random& random) {
  PolygonPair pair = any_plain(random);
  const auto k = std::ptrdiff_t(random.below(int(pair.p.outer.size())));
  for (int copies = 1 + random.below(3); copies > 0; --copies)
    pair.p.outer.insert(pair.p.outer.begin() + k, Vec3(pair.p.outer[std::size_t(k)]));
  return pair;
}

PolygonPair of_scale(Random& random) {
  const double scale = random.log_uniform(1e-12, 1e12);
  return scaled(placed(any_plain(random), random), scale);
}

PolygonPair far_away(Random& random) {
  const Vec3 direction = random_direction(random);
  const Vec3 shift = random.log_uniform(10, 1e6) * direction;
  return mapped(placed(any_plain(random), random), [&](const Vec3& x) { return x + shift; });
}

}  // namespace

std::vector<HostileFamily> hostile_families() {
  const auto turned = [](PolygonPair (*draw)(Random&)) {
    return [draw](Random& random) { return placed(draw(random), random); };
  };
  return {
      {"shared edge, 1e-6 to pi - 1e-6", turned(wedge)},
      {"parallel, turned by 1e-16 to 1e-4", turned(near_parallel)},
      {"slivers to 1e6", turned(slivers)},
      {"gaps to 1e-9", turned(close_plates)},
      {"sizes to 1e9", turned(of_sizes)},
      {"concave quads", turned(random_facing_quads)},
      {"3 to 64 vertices", turned(stars)},
      {"holes", turned(with_holes)},
      {"collinear vertices", turned(collinear)},
      {"repeated vertices", turned(repeated)},
      {"scales 1e-12 to 1e12", of_scale},
      {"1e6 sizes from the origin", far_away},
  };
}

Polygon blocker_between(const PolygonPair& pair, int corners, double place, double size) {
  const Moments p = moments(pair.p), q = moments(pair.q);
  const Vec3 axis = q.centroid - p.centroid;
  const double length = glm::length(axis);
  const Vec3 least = std::abs(axis.x) < std::abs(axis.y) ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = glm::normalize(glm::cross(axis / length, least));
  const Vec3 v = glm::cross(axis / length, u);
  const double radius = size * std::sqrt(std::min(p.area, q.area));
  Polygon blocker;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * kPi * k / corners, r = k % 2 ? 0.5 * radius : radius;
    blocker.outer.push_back(p.centroid + place * axis + r * std::cos(angle) * u +
                            r * std::sin(angle) * v);
  }
  return blocker;
}

}  // namespace host
