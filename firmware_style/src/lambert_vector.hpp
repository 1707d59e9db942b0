// lambert_vector.hpp -- cross products whose 62 bits are brought to 30 without losing their length.
#pragma once
#include "urad/log2.hpp"
#include "urad/vec.hpp"

namespace urad {

/// direction 2^exponent; the greatest component of `direction` has its top bit at 29 unless all are
/// 0.
struct LongVector {
  urad_point direction;
  int exponent;
};

/// a x b, |components| <= 2^30.
inline LongVector cross(const urad_point& a, const urad_point& b) noexcept {
  const int64_t c[3] = {wide_mul(a.y, b.z) - wide_mul(a.z, b.y),
                        wide_mul(a.z, b.x) - wide_mul(a.x, b.z),
                        wide_mul(a.x, b.y) - wide_mul(a.y, b.x)};
  const uint64_t extent = magnitude(c[0]) | magnitude(c[1]) | magnitude(c[2]);
  if (extent == 0) return {{0, 0, 0}, 0};
  const int down = top_bit(extent) - 29;
  const auto fit = [=](int64_t x) {
    return int32_t(down > 0 ? round_shift(x, down) : x * (int64_t{1} << -down));
  };
  return {{fit(c[0]), fit(c[1]), fit(c[2])}, down};
}

/// |v|^2, v below 2^31.
inline uint64_t square(const urad_point& v) noexcept { return uint64_t(dot(v, v)); }

/// log2 |v|^2 in Q7.24; that of a null vector counts as 0.
inline int32_t log2_square_q24(const LongVector& v) noexcept {
  return log2_q24(square(v.direction)) + v.exponent * (1 << 25);
}

}  // namespace urad
