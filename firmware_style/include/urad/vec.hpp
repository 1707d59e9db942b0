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
  return wide_mul(a.x, b.x) + wide_mul(a.y, b.y) + wide_mul(a.z, b.z);
}

/// Normals of rooms that stand upright are mostly zeros: skipping those saves two of three wide
/// products.
constexpr int64_t sparse_dot(const urad_point& n, const urad_point& r) noexcept {
  int64_t sum = 0;
  if (n.x) sum += wide_mul(n.x, r.x);
  if (n.y) sum += wide_mul(n.y, r.y);
  if (n.z) sum += wide_mul(n.z, r.z);
  return sum;
}

/// The sign of sparse_dot(): along an axis, without a product.
constexpr int sign_of_dot(const urad_point& n, const urad_point& r) noexcept {
  const auto sign = [](int32_t a, int32_t b) {
    return a == 0 || b == 0 ? 0 : (a < 0) == (b < 0) ? 1 : -1;
  };
  if (!n.x && !n.y) return sign(n.z, r.z);
  if (!n.x && !n.z) return sign(n.y, r.y);
  if (!n.y && !n.z) return sign(n.x, r.x);
  const int64_t sum = sparse_dot(n, r);
  return sum < 0 ? -1 : sum > 0;
}

/// Along an axis, distances from a plane need no product and are exact.
constexpr bool along_an_axis(const urad_point& normal_q30) noexcept {
  constexpr uint32_t kOne_q30 = uint32_t{1} << 30;
  const urad_point& n = normal_q30;
  return (!n.x && !n.y && magnitude(n.z) == kOne_q30) ||
         (!n.x && !n.z && magnitude(n.y) == kOne_q30) ||
         (!n.y && !n.z && magnitude(n.x) == kOne_q30);
}

/// Signed distance of `x` from the plane through `on` with this normal, in scene units, rounded.
/// Along an axis a difference says it.
constexpr int32_t plane_distance(const urad_point& normal_q30, const urad_point& on,
                                 const urad_point& x) noexcept {
  constexpr int32_t kOne_q30 = int32_t{1} << 30;
  const urad_point &n = normal_q30, r = x - on;
  const auto along = [](int32_t one, int32_t d) { return one < 0 ? -d : d; };
  if (!n.x && !n.y && magnitude(n.z) == kOne_q30) return along(n.z, r.z);
  if (!n.x && !n.z && magnitude(n.y) == kOne_q30) return along(n.y, r.y);
  if (!n.y && !n.z && magnitude(n.x) == kOne_q30) return along(n.x, r.x);
  return int32_t(round_shift(sparse_dot(n, r), 30));
}

/// Distances up to this count as "on the plane", 2^-23 of the scene's box. A coordinate is off by
/// half a unit and the normal by 2^-31 of at most 2^30 units; the step of a grid is off by a unit,
/// which adds up along its patches.
inline constexpr int32_t kPlaneTolerance = 64;

}  // namespace urad
