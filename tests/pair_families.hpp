// Random pairs of polygons, easy and hostile, and a slow second opinion on their form factors.
#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/polygon.hpp"
#include "geometry/validate.hpp"

namespace families {

using host::Loop;
using host::Polygon;
using host::Vec3;

struct Pair {
  Polygon p, q;
};

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// 0 <= x < 1, the same on every standard library.
  double uniform() { return std::ldexp(static_cast<double>(engine_() >> 11), -53); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }
  Vec3 direction() {
    const double z = uniform(-1, 1);
    const double angle = uniform(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
  glm::dmat3 rotation() {
    const Vec3 x = direction();
    const Vec3 y = glm::normalize(glm::cross(x, direction()));
    return {x, y, glm::cross(x, y)};
  }

 private:
  std::mt19937_64 engine_;
};

inline Polygon transformed(Polygon polygon, const std::function<Vec3(const Vec3&)>& map) {
  for (Vec3& x : polygon.outer) x = map(x);
  for (Loop& hole : polygon.holes)
    for (Vec3& x : hole) x = map(x);
  return polygon;
}

inline Pair transformed(const Pair& pair, const std::function<Vec3(const Vec3&)>& map) {
  return {transformed(pair.p, map), transformed(pair.q, map)};
}

inline Pair rotated(const Pair& pair, Random* random) {
  const glm::dmat3 turn = random->rotation();
  const Vec3 shift(random->uniform(), random->uniform(), random->uniform());
  return transformed(pair, [&](const Vec3& x) { return turn * x + shift; });
}

/// w x h rectangle in the plane z, lit side up.
inline Polygon rectangle(double w, double h, double z = 0, double x = 0, double y = 0) {
  return {{{x, y, z}, {x + w, y, z}, {x + w, y + h, z}, {x, y + h, z}}, {}};
}

inline Polygon flipped(Polygon polygon) {
  return {Loop(polygon.outer.rbegin(), polygon.outer.rend()), polygon.holes};
}

/// A floor and a wall of depth `h` hinged on the y axis at an inner angle.
inline Pair hinge(double angle, double w = 1, double h = 1, double l = 1) {
  const Vec3 up(h * std::cos(angle), 0, h * std::sin(angle));
  const Vec3 along(0, l, 0);
  return {rectangle(w, l), {{Vec3(0), along, along + up, up}, {}}};
}

/// The quadrilaterals of [Martin 1996, 3.2]: a random walk in a random plane of the unit cube,
/// often concave.
inline Polygon random_quad(Random* random) {
  for (;;) {
    const glm::dmat3 axes = random->rotation();
    Vec3 x(random->uniform(), random->uniform(), random->uniform());
    Polygon polygon;
    bool inside = true;
    for (int k = 0; k < 4; ++k) {
      polygon.outer.push_back(x);
      const double angle = random->uniform(0, 2 * std::numbers::pi);
      x += random->uniform(0.01, 1) * (std::cos(angle) * axes[0] + std::sin(angle) * axes[1]);
      for (int c = 0; c < 3; ++c)
        inside = inside && polygon.outer.back()[c] >= 0 && polygon.outer.back()[c] <= 1;
    }
    if (inside && host::validate(polygon) == host::PolygonStatus::ok &&
        host::moments(polygon).area > 1e-4)
      return polygon;
  }
}

/// Whether every vertex of `polygon` is at least `margin` in front of the plane.
inline bool faces(const Polygon& plane, const Polygon& polygon, double margin = 0) {
  const host::Moments m = host::moments(plane);
  for (const Vec3& x : polygon.outer)
    if (glm::dot(m.normal, x - m.centroid) < margin) return false;
  return true;
}

inline bool wholly_in_front(const Polygon& plane, const Polygon& polygon) {
  return faces(plane, polygon, 1e-3);
}

inline Pair random_pair(Random* random) {
  for (;;) {
    Pair pair{random_quad(random), random_quad(random)};
    if (wholly_in_front(pair.p, pair.q) && wholly_in_front(pair.q, pair.p)) return pair;
  }
}

/// Parallel squares, the second turned in its plane and tilted out of it by small angles.
inline Pair disturbed_squares(Random* random, double turn, double tilt) {
  const double gap = random->uniform(0.1, 2);
  return {rectangle(1, 1), transformed(flipped(rectangle(1, 1)), [&](const Vec3& x) {
            const Vec3 turned(std::cos(turn) * x.x - std::sin(turn) * x.y,
                              std::sin(turn) * x.x + std::cos(turn) * x.y, 0);
            return Vec3(turned.x, std::cos(tilt) * turned.y, gap + std::sin(tilt) * turned.y);
          })};
}

struct Family {
  std::string name;
  std::function<Pair(Random*)> draw;
};

/// The nine families on which older programs return NaN, negative or plainly wrong factors.
inline std::vector<Family> degenerate_families() {
  constexpr double kPi = std::numbers::pi;
  const auto free_hinge = [](Random* r, double angle) {
    return hinge(angle, r->uniform(0.1, 2), r->uniform(0.1, 2), r->uniform(0.1, 2));
  };
  return {
      {"shared edge, any angle, rotated",
       [=](Random* r) { return rotated(free_hinge(r, r->uniform(0.1, kPi - 0.1)), r); }},
      {"shared edge, axis-aligned", [=](Random* r) { return free_hinge(r, kPi / 2); }},
      {"shared edge, nearly closed",
       [=](Random* r) { return rotated(free_hinge(r, r->log_uniform(1e-6, 0.1)), r); }},
      {"shared edge, nearly coplanar",
       [=](Random* r) { return rotated(free_hinge(r, kPi - r->log_uniform(1e-6, 0.1)), r); }},
      {"shared vertex, rotated",
       [=](Random* r) {
         Pair pair = free_hinge(r, r->uniform(0.1, kPi - 0.1));
         pair.q = transformed(pair.q, [&](const Vec3& x) { return Vec3(x.x, -x.y, x.z); });
         pair.q = flipped(pair.q);
         return rotated(pair, r);
       }},
      {"parallel squares, turned",
       [](Random* r) { return disturbed_squares(r, r->log_uniform(1e-16, 1e-4), 0); }},
      {"parallel squares, tilted",
       [](Random* r) { return disturbed_squares(r, 0, r->log_uniform(1e-16, 1e-4)); }},
      {"parallel squares, tilted and turned",
       [](Random* r) {
         return disturbed_squares(r, r->log_uniform(1e-9, 1e-3), r->log_uniform(1e-9, 1e-3));
       }},
      {"repeated vertex",
       [](Random* r) {
         Pair pair = random_pair(r);
         pair.p.outer.insert(pair.p.outer.begin() + 1, pair.p.outer[1]);
         return pair;
       }},
  };
}

}  // namespace families
