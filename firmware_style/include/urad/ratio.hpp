// ratio.hpp -- quotients to 30 good bits without a division: normalise, Newton, multiply.
#pragma once
#include "urad/q.hpp"

namespace urad {

/// 2^62 / m for 2^31 <= m < 2^32; in [2^30, 2^31].
///   start   48/17 - 32/17 d on d = m/2^32 in [1/2, 1)     relative error <= 1/17
///   Newton  y <- y (2 - d y) squares it: 3.5e-3, 1.2e-5, 1.5e-10; roundings below 3 x 2^-32
///   measured over all 2^31 mantissas; the worst is in tests/fixed_math_test.cpp relative < 1.08e-9
/// Width: y in UQ2.30 is below 2^31, every product of 32 bits by 32 bits.
constexpr uint32_t inverse_uq62(uint32_t m) noexcept {
  expect(m >> 31);
  const auto high = [](uint32_t a, uint32_t b) { return uint32_t(wide_umul(a, b) >> 32); };
  uint32_t y_uq30 = 3031741621u - high(m, 2021161081u);  // 1/d, UQ2.30
  for (int n = 0; n < 3; ++n) {
    const uint32_t slack_uq30 = 0x80000000u - high(m, y_uq30);  // 2 - d y
    y_uq30 = uint32_t(wide_umul(y_uq30, slack_uq30) >> 30);
  }
  return y_uq30;
}

/// x moved so that its top bit is bit 31 (bits below are dropped); exponent: x ~ mantissa *
/// 2^exponent. 0 gives {0, 0}.
struct Scaled {
  uint32_t mantissa;
  int exponent;
};
template <bool wide = kWideRegisters>
constexpr Scaled scaled(uint64_t x) noexcept {
  if (x == 0) return {0, 0};
  const int n = top_bit(x);
  if (wide) return {uint32_t((x << (63 - n)) >> 32), n - 31};
  return n > 31 ? Scaled{uint32_t(x >> (n - 31)), n - 31} : Scaled{uint32_t(x << (31 - n)), n - 31};
}

/// a b, 1 / b and a / b, leading 32 bits kept. b.mantissa != 0 in a quotient.
constexpr Scaled operator*(const Scaled& a, const Scaled& b) noexcept {
  const Scaled product = scaled(wide_umul(a.mantissa, b.mantissa));
  return {product.mantissa, product.exponent + a.exponent + b.exponent};
}
constexpr Scaled inverse(const Scaled& b) noexcept {
  return {inverse_uq62(b.mantissa), -62 - b.exponent};
}
constexpr Scaled operator/(const Scaled& a, const Scaled& b) noexcept { return a * inverse(b); }

/// a 2^fraction_bits as an integer, dropped below, saturating at 2^62.
constexpr int64_t to_q(const Scaled& a, int fraction_bits) noexcept {
  const int shift = a.exponent + fraction_bits;
  if (a.mantissa == 0 || shift <= -32) return 0;
  if (shift > 30) return int64_t{1} << 62;
  return shift < 0 ? int64_t{a.mantissa} >> -shift : int64_t{a.mantissa} << shift;
}

/// num / den with `fraction_bits`, the sign of num, |result| <= 2^62. den > 0. Relative error below
/// 2^-29.
constexpr int64_t ratio_q(int64_t num, int64_t den, int fraction_bits) noexcept {
  expect(den > 0);
  const int64_t q = to_q(scaled(magnitude(num)) / scaled(magnitude(den)), fraction_bits);
  return num < 0 ? -q : q;
}

}  // namespace urad
