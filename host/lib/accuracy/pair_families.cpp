#include "accuracy/pair_families.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/planar.hpp"
#include "geometry/validate.hpp"
#include "network/random_direction.hpp"

namespace host {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLeastArea = 1e-4, kLeastEdge = 0.01, kMargin = 1e-3;

template <class Map>
PolygonPair mapped(PolygonPair pair, const Map& map) {
  for (Vec3& x : pair.p.outer) x = map(x);
  for (Vec3& x : pair.q.outer) x = map(x);
  return pair;
}

PolygonPair rotated(const PolygonPair& pair, Random& random) {
  const glm::dmat3 turn = random_rotation(random);
  const Vec3 shift = random_point(random);
  return mapped(pair, [&](const Vec3& x) { return turn * x + shift; });
}

/// 1 in front of the plane, -1 behind it, both by the margin; else 0.
int side_of(const Polygon& polygon, const Moments& plane) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& x : polygon.outer) {
    const double height = glm::dot(plane.normal, x - plane.centroid);
    low = std::min(low, height), high = std::max(high, height);
  }
  return low >= kMargin ? 1 : high <= -kMargin ? -1 : 0;
}

PolygonPair free_hinge(Random& random, double degrees) {
  const double w = random.uniform(0.1, 2), h = random.uniform(0.1, 2);
  return hinge(degrees, w, h, random.uniform(0.1, 2));
}

double any_angle(Random& random) { return random.uniform(6, 174); }

// Parallel squares, the second turned in its plane and tilted out of it by small angles.
PolygonPair disturbed_squares(Random& random, double turn, double tilt) {
  const double gap = random.uniform(0.1, 2);
  PolygonPair pair{rectangle(1, 1), flipped(rectangle(1, 1))};
  for (Vec3& x : pair.q.outer) {
    const double u = std::cos(turn) * x.x - std::sin(turn) * x.y;
    const double v = std::sin(turn) * x.x + std::cos(turn) * x.y;
    x = {u, std::cos(tilt) * v, gap + std::sin(tilt) * v};
  }
  return pair;
}

PolygonPair shared_vertex(Random& random) {
  PolygonPair pair = free_hinge(random, any_angle(random));
  for (Vec3& x : pair.q.outer) x.y = -x.y;
  pair.q = flipped(pair.q);
  return rotated(pair, random);
}

PolygonPair repeated_vertex(Random& random) {
  PolygonPair pair = random_facing_quads(random);
  pair.p.outer.insert(pair.p.outer.begin() + 1, pair.p.outer[1]);
  return pair;
}

}  // namespace

Polygon rectangle(double w, double h, double z, double x, double y) {
  return {{{x, y, z}, {x + w, y, z}, {x + w, y + h, z}, {x, y + h, z}}, {}};
}

Polygon flipped(const Polygon& polygon) {
  return {Loop(polygon.outer.rbegin(), polygon.outer.rend()), {}};
}

Polygon regular_polygon(int corners, double radius, double z) {
  Polygon polygon;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * kPi * k / corners;
    polygon.outer.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  }
  return polygon;
}

PolygonPair hinge(double degrees, double w, double h, double l) {
  const double angle = degrees * kPi / 180;
  const Vec3 up(h * std::cos(angle), 0, h * std::sin(angle)), along(0, l, 0);
  return {rectangle(w, l), {{Vec3(0), along, along + up, up}, {}}};
}

Polygon random_quad(Random& random) {
  for (;;) {
    const glm::dmat3 axes = random_rotation(random);
    Vec3 x = random_point(random);
    Polygon quad;
    bool inside = true;
    for (int k = 0; k < 4 && inside; ++k) {
      quad.outer.push_back(x);
      const double angle = random.uniform(0, 2 * kPi), length = random.uniform(kLeastEdge, 1);
      inside =
          glm::all(glm::greaterThanEqual(x, Vec3(0))) && glm::all(glm::lessThanEqual(x, Vec3(1)));
      x += length * (std::cos(angle) * axes[0] + std::sin(angle) * axes[1]);
    }
    if (inside && validate(quad) == PolygonStatus::ok && moments(quad).area >= kLeastArea)
      return quad;
  }
}

bool is_concave(const Polygon& quad) {
  const Loop2 flat = Projection(moments(quad).normal)(quad.outer);
  const std::size_t n = flat.size();
  for (std::size_t k = 0; k < n; ++k)
    if (orientation(flat[k], flat[(k + 1) % n], flat[(k + 2) % n]) < 0) return true;
  return false;
}

PolygonPair random_facing_quads(Random& random) {
  for (;;) {
    PolygonPair pair{random_quad(random), random_quad(random)};
    const int q_side = side_of(pair.q, moments(pair.p)), p_side = side_of(pair.p, moments(pair.q));
    if (p_side == 0 || q_side == 0) continue;
    // Both sides of a random quad are equally likely: turning it over draws no other pairs, only
    // faster.
    if (q_side < 0) pair.p = flipped(pair.p);
    if (p_side < 0) pair.q = flipped(pair.q);
    return pair;
  }
}

std::vector<DegenerateFamily> degenerate_families() {
  constexpr double kDegree = 180 / kPi;
  return {
      {"shared edge, any angle, rotated",
       [](Random& r) { return rotated(free_hinge(r, any_angle(r)), r); }},
      {"shared edge, axis-aligned", [](Random& r) { return free_hinge(r, 90); }},
      {"shared edge, nearly closed",
       [](Random& r) { return rotated(free_hinge(r, kDegree * r.log_uniform(1e-6, 0.1)), r); }},
      {"shared edge, nearly coplanar",
       [](Random& r) {
         return rotated(free_hinge(r, 180 - kDegree * r.log_uniform(1e-6, 0.1)), r);
       }},
      {"shared vertex, rotated", shared_vertex},
      {"parallel squares, turned by 1e-16 to 1e-4",
       [](Random& r) { return disturbed_squares(r, r.log_uniform(1e-16, 1e-4), 0); }},
      {"parallel squares, tilted by 1e-16 to 1e-4",
       [](Random& r) { return disturbed_squares(r, 0, r.log_uniform(1e-16, 1e-4)); }},
      {"parallel squares, both by 1e-9 to 1e-3",
       [](Random& r) {
         const double turn = r.log_uniform(1e-9, 1e-3);
         return disturbed_squares(r, turn, r.log_uniform(1e-9, 1e-3));
       }},
      {"repeated vertex", repeated_vertex},
  };
}

PolygonPair scaled(const PolygonPair& pair, double factor) {
  return mapped(pair, [&](const Vec3& x) { return x * factor; });
}

}  // namespace host
