// Points, directions and attitudes without a preferred one. Numbers are drawn in statements of
// their own: in which order arguments are looked at is the compiler's choice.
#pragma once
#include <cmath>
#include <numbers>

#include "geometry/polygon.hpp"
#include "network/random.hpp"

namespace host {

/// Uniform in the unit cube; z is drawn first.
inline Vec3 random_point(Random& random) {
  const double z = random.uniform(), y = random.uniform();
  return {random.uniform(), y, z};
}

/// Uniform on the unit sphere [Archimedes].
inline Vec3 random_direction(Random& random) {
  const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// A right-handed frame of unit vectors.
inline glm::dmat3 random_rotation(Random& random) {
  const Vec3 x = random_direction(random);
  const Vec3 y = glm::normalize(glm::cross(x, random_direction(random)));
  return {x, y, glm::cross(x, y)};
}

}  // namespace host
