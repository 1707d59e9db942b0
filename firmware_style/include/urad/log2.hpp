// log2.hpp -- log2 and 2^x by table: products, quotients and roots become sums and halves.
//
// Both tables are chords of 256 steps, moved by half their greatest error, computed at compile time
// without libm.
#pragma once
#include "urad/q.hpp"

namespace urad {

namespace table {

/// ln x for 1 <= x <= 2 by 2 artanh((x-1)/(x+1)); the first term left out is below 2^-60.
constexpr double ln(double x) {
  const double t = (x - 1) / (x + 1), t2 = t * t;
  double sum = 0, power = t;
  for (int n = 1; n < 40; n += 2) sum += power / n, power *= t2;
  return 2 * sum;
}

inline constexpr double kLn2 = ln(2.0);

/// e^x for 0 <= x <= 1, Taylor.
constexpr double exp(double x) {
  double sum = 1, term = 1;
  for (int n = 1; n < 24; ++n) term *= x / n, sum += term;
  return sum;
}

struct Knots {
  uint32_t value[257];
};

/// log2(1 + k/256) in UQ0.24, plus half the chord's error h^2/8 f''.
constexpr Knots make_log2() {
  Knots t{};
  for (int k = 0; k <= 256; ++k) {
    const double x = 1 + k / 256.0;
    const double lift = k % 256 ? 1 / (x * x) / (16 * 65536.0) : 0.0;
    t.value[k] = uint32_t((ln(x) + lift) / kLn2 * 16777216.0 + 0.5);
  }
  return t;
}

/// 2^(k/256) in UQ2.30, less half the chord's error.
constexpr Knots make_exp2() {
  Knots t{};
  for (int k = 0; k <= 256; ++k) {
    const double y = exp(k / 256.0 * kLn2);
    const double drop = k % 256 ? y * kLn2 * kLn2 / (16 * 65536.0) : 0.0;
    t.value[k] = uint32_t((y - drop) * 1073741824.0 + 0.5);
  }
  return t;
}

inline constexpr Knots kLog2 = make_log2();  // 1028 bytes of ROM
inline constexpr Knots kExp2 = make_exp2();  // 1028 bytes of ROM

/// log2 of 2^31 <= m < 2^32, relative to 2^31, UQ0.24.
///   chord, after the move  h^2/16 max|f''|  = (1/256)^2/16 / ln 2      1.38e-6
///   chords next to k = 0 and 256, where the knot is exact               2.75e-6
///   rounding of knots, of the 15 fraction bits and of the result        0.12e-6
///   measured over a dense sweep: tests/log2_test.cpp
/// Width: knot distance < 2^17, fraction < 2^15: one 32-bit product. 0 gives 0.
constexpr int32_t log2_mantissa_q24(uint32_t m) noexcept {
  const uint32_t k = (m >> 23) & 255u, f_q15 = (m >> 8) & 0x7FFFu;
  const uint32_t y = kLog2.value[k];
  return int32_t(y + (((kLog2.value[k + 1] - y) * f_q15 + 0x4000u) >> 15));
}

/// 2^f for 0 <= f < 1, UQ0.24, as UQ2.30; see exp2_uq().
constexpr uint32_t exp2_mantissa_uq30(uint32_t f_uq24) noexcept {
  const uint32_t k = f_uq24 >> 16, f_uq16 = f_uq24 & 0xFFFFu, y = kExp2.value[k];
  return y + ((((kExp2.value[k + 1] - y) >> 7) * f_uq16 + 0x100u) >> 9);
}

}  // namespace table

/// log2 x in Q7.24 for x >= 1; 0 gives the same as 1. Exact at powers of two, monotone. Error
/// <= 2.9e-6.
constexpr int32_t log2_q24(uint32_t x) noexcept {
  const int n = top_bit(x);
  return int32_t(uint32_t(n) << 24) + table::log2_mantissa_q24(x << (31 - n));
}

/// The same for 64 bits; all but the leading 32 are dropped (relative 2^-31).
template <bool wide = kWideRegisters>
constexpr int32_t log2_q24(uint64_t x) noexcept {
  if (wide) {
    const int n = top_bit(x);
    return int32_t(uint32_t(n) << 24) + table::log2_mantissa_q24(uint32_t((x << (63 - n)) >> 32));
  }
  const uint32_t high = uint32_t(x >> 32);
  if (high == 0) return log2_q24(uint32_t(x));
  const int n = top_bit(high);
  const uint32_t m = n == 31 ? high : (high << (31 - n)) | uint32_t(uint32_t(x) >> (n + 1));
  return int32_t(uint32_t(n + 32) << 24) + table::log2_mantissa_q24(m);
}

/// round(2^x * 2^fraction_bits) for x in Q7.24, saturating at 2^32 - 1; |fraction_bits| <= 64.
///   chord, after the move  h^2/16 (ln 2)^2    relative 4.6e-7; next to the exact knots 9.2e-7
///   rounding of the difference to 23 bits     relative 0.6e-7
///   measured: tests/log2_test.cpp
/// Exact at whole x. Width: difference < 2^16 after the shift, fraction 2^16.
constexpr uint32_t exp2_uq(int32_t x_q24, int fraction_bits) noexcept {
  expect(fraction_bits >= -64 && fraction_bits <= 64);
  const int e = int(shift_down(x_q24, 24)) + fraction_bits;
  if (e >= 32) return 0xFFFFFFFFu;
  if (e < -1) return 0;
  const uint32_t m_uq30 = table::exp2_mantissa_uq30(uint32_t(x_q24) & 0xFFFFFFu);
  if (e >= 30) return m_uq30 << (e - 30);
  return ((m_uq30 >> (29 - e)) + 1) >> 1;
}

/// 1 / sqrt(x) for x >= 1, times 2^fraction_bits, rounded: three look-ups of the tables above and
/// no iteration. Relative error <= 2.4e-6 plus the rounding of the result. 0 gives the same as 1.
constexpr uint32_t rsqrt_uq(uint64_t x, int fraction_bits) noexcept {
  return exp2_uq(-shift_down(log2_q24(x), 1), fraction_bits);
}

/// log2(1 + x) in Q7.24 for x in UQ with `fraction_bits` <= 24; x < 2^32 - 2^fraction_bits.
constexpr int32_t log2_1p_q24(uint32_t x, int fraction_bits) noexcept {
  expect(fraction_bits <= 24 && x < 0u - (uint32_t{1} << fraction_bits));
  return log2_q24(x + (uint32_t{1} << fraction_bits)) - int32_t(uint32_t(fraction_bits) << 24);
}

}  // namespace urad
