// vec.hpp -- points in scene units and unit vectors: differences, products, distances from a plane.
#pragma once
#include "urad/q.hpp"
#include "urad/scene.h"

namespace urad {

/// a - b. |coordinates| <= 2^29 each, so the result fits in 31 bits.
constexpr urad_point operator-(const urad_point& a, const urad_point& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// Sum of products, exact in 64 bits while |a| |b| < 2^63.
constexpr int64_t dot(const urad_point& a, const urad_point& b) noexcept {
  return int64_t{a.x} * b.x + int64_t{a.y} * b.y + int64_t{a.z} * b.z;
}

/// Normals of rooms that stand upright are mostly zeros: skipping those saves two of three wide
/// products.
constexpr int64_t sparse_dot(const urad_point& n, const urad_point& r) noexcept {
  int64_t sum = 0;
  if (n.x) sum += int64_t{n.x} * r.x;
  if (n.y) sum += int64_t{n.y} * r.y;
  if (n.z) sum += int64_t{n.z} * r.z;
  return sum;
}

/// Signed distance of `x` from the plane through `on` with this normal, in scene units, rounded.
constexpr int32_t plane_distance(const urad_point& normal_q30, const urad_point& on,
                                 const urad_point& x) noexcept {
  return int32_t(round_shift(sparse_dot(normal_q30, x - on), 30));
}

/// Distances up to this count as "on the plane", 2^-23 of the scene's box. A coordinate is off by
/// half a unit and the normal by 2^-31 of at most 2^30 units; the step of a grid is off by a unit,
/// which adds up along its patches.
inline constexpr int32_t kPlaneTolerance = 64;

}  // namespace urad
