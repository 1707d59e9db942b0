// angle.hpp -- square roots and angles to 28 good bits: what the exact sum needs of libm.
#pragma once
#include "urad/log2.hpp"
#include "urad/ratio.hpp"

namespace urad {

namespace table {

inline constexpr double kPi = 3.14159265358979323846;

/// arctan x for 0 <= x <= 1 by Euler's series; its terms shrink at least by 1/2 each.
constexpr double arctan(double x) {
  const double z = x * x / (1 + x * x);
  double sum = 0, term = x / (1 + x * x);
  for (int n = 1; n < 80; ++n) sum += term, term *= z * (2.0 * n) / (2.0 * n + 1);
  return sum;
}

/// arctan t and its derivative 1 / (1 + t^2) at t = k/64, both UQ2.30.
struct ArctanKnots {
  uint32_t value_uq30[65], slope_uq30[65];
};
constexpr ArctanKnots make_arctan() {
  ArctanKnots t{};
  for (int k = 0; k <= 64; ++k) {
    const double x = k / 64.0;
    t.value_uq30[k] = uint32_t(arctan(x) * 1073741824.0 + 0.5);
    t.slope_uq30[k] = uint32_t(1073741824.0 / (1 + x * x) + 0.5);
  }
  return t;
}
inline constexpr ArctanKnots kArctan = make_arctan();  // 520 bytes of ROM

}  // namespace table

inline constexpr int32_t kPi_q29 = int32_t(table::kPi * 536870912.0 + 0.5);

/// 1 / sqrt(x) for x >= 1: mantissa_uq30 / 2^30 / sqrt(2^(2 half)), 1 < mantissa <= 2.
///   start    tables of log2 and 2^x                       relative 2.4e-6
///   Newton   y <- y (3 - x y^2) / 2 leaves 3/2 e^2        0.9e-11; roundings below 3 x 2^-31
///   measured over a dense sweep: tests/lambert_fixed_test.cpp                relative <= 2.0e-9
struct InverseRoot {
  uint32_t mantissa_uq30;
  int half;
};
template <bool wide = kWideRegisters>
constexpr InverseRoot inverse_root(uint64_t x) noexcept {
  const int even = (top_bit(x) | 1) + 1;  // x = v 2^even, v in [1/4, 1)
  const uint32_t v_uq32 = wide         ? uint32_t((x << (64 - even)) >> 32)
                          : even >= 32 ? uint32_t(x >> (even - 32))
                                       : uint32_t(x << (32 - even));
  const auto product = [](uint32_t a, uint32_t b, int shift) {
    return uint32_t(wide_umul(a, b) >> shift);
  };
  const uint32_t start_q24 = (16u << 24) - (uint32_t(log2_q24(v_uq32)) >> 1);  // 0 .. 1
  const uint32_t y_uq30 = table::exp2_mantissa_uq30(start_q24 & 0xFFFFFFu) << (start_q24 >> 24);
  const uint32_t square_uq30 = product(product(v_uq32, y_uq30, 32), y_uq30, 30);  // v y^2, about 1
  return {product(y_uq30, 3221225472u - square_uq30, 31), even >> 1};
}

/// The angle of the vector (x, y), y >= 0, in Q3.29: 0 .. pi; 0 for (0, 0).
///   quotient of the smaller by the larger         2e-9
///   Taylor's series to the third power about the nearest of 65 knots: the next term is below
///   0.2 (1/128)^4                                 0.8e-9
///   rounding of knots and products                1.5e-9
///   measured over the whole domain: tests/lambert_fixed_test.cpp             absolute <= 5.0e-9
struct Tangent {
  int32_t t_q30;       ///< of the smaller of |x| and |y| by the larger, 0 .. 1
  bool steep, obtuse;  ///< y is the larger; x is negative
};
constexpr Tangent tangent(int64_t x, int64_t y) noexcept {
  const uint64_t along = magnitude(x), across = magnitude(y);
  const bool steep = across > along;
  const uint64_t large = steep ? across : along, small = steep ? along : across;
  if (large == 0) return {0, false, false};
  const int64_t quotient_q30 = to_q(scaled(small) / scaled(large), 30);
  return {quotient_q30 > (1 << 30) ? 1 << 30 : int32_t(quotient_q30), steep, x < 0};
}
constexpr int32_t angle_q29(const Tangent& tangent) noexcept {
  const int32_t t_q30 = tangent.t_q30;
  const int k = (t_q30 + (1 << 23)) >> 24;
  const auto mul_q30 = [](int32_t a, int32_t b) {
    return int32_t(round_shift(wide_mul(a, b), 30));
  };
  const int32_t d_q30 = t_q30 - k * (1 << 24), slope_q30 = int32_t(table::kArctan.slope_uq30[k]);
  // arctan(t + d) = arctan t + s d - t (s d)^2 + (1 - 4/3 s) s^2 d^3,  s = 1 / (1 + t^2)
  const int32_t first_q30 = mul_q30(slope_q30, d_q30);
  const int32_t square_q30 = mul_q30(first_q30, first_q30);
  const int32_t bend_q30 =
      mul_q30((int32_t{1} << 30) - slope_q30 - mul_q30(slope_q30, 357913941), d_q30);
  const int32_t rest_q30 = mul_q30(square_q30, bend_q30 - k * (1 << 24));
  const int32_t arc_q29 =
      round_shift(int32_t(table::kArctan.value_uq30[k]) + first_q30 + rest_q30, 1);
  const int32_t acute_q29 = tangent.steep ? (kPi_q29 >> 1) - arc_q29 : arc_q29;
  return tangent.obtuse ? kPi_q29 - acute_q29 : acute_q29;
}
constexpr int32_t angle_q29(int64_t x, int64_t y) noexcept { return angle_q29(tangent(x, y)); }

}  // namespace urad
