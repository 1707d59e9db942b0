// q.hpp -- fixed-point arithmetic: rounding and products that fit in 32 bits.
//
// Formats are in the names: x_q15 is signed with 15 fraction bits, x_uq32 unsigned with 32. Every
// function is constexpr and uses integers only. Rounding is to nearest with ties away from zero, so
// that f(-x) = -f(x): a mirrored scene gives mirrored bits.
#pragma once
#include <stddef.h>
#include <stdint.h>

#ifndef URAD_CHECKED
#define URAD_CHECKED 0
#endif

namespace urad {

/// What a caller has to see to: ranges that a comment promises. Builds with URAD_CHECKED=1 trap where
/// one does not hold; all others know nothing of it.
constexpr void expect(bool holds) noexcept {
  if (URAD_CHECKED && !holds) __builtin_trap();
}

/// The only right shift of negative numbers in the engine: towards minus infinity (C++20 defines
/// it; all our C++17 compilers do it).
constexpr int32_t shift_down(int32_t x, int n) noexcept { return x >> n; }
constexpr int64_t shift_down(int64_t x, int n) noexcept { return x >> n; }

/// Position of the highest set bit, 0 .. 31 (63); 0 for x = 0.
constexpr int top_bit(uint32_t x) noexcept { return 31 - __builtin_clz(x | 1u); }
constexpr int top_bit(uint64_t x) noexcept {
  return x >> 32 ? 32 + top_bit(uint32_t(x >> 32)) : top_bit(uint32_t(x));
}

/// |x| as unsigned; no overflow at the most negative value.
constexpr uint32_t magnitude(int32_t x) noexcept { return x < 0 ? 0u - uint32_t(x) : uint32_t(x); }
constexpr uint64_t magnitude(int64_t x) noexcept { return x < 0 ? 0u - uint64_t(x) : uint64_t(x); }

/// x / 2^n to nearest. 1 <= n <= 31 (63 for 64 bits), any x.
constexpr int32_t round_shift(int32_t x, int n) noexcept {
  expect(n >= 1 && n <= 31);
  const uint32_t y = (magnitude(x) + (uint32_t{1} << (n - 1))) >> n;
  return x < 0 ? -int32_t(y) : int32_t(y);
}
constexpr int64_t round_shift(int64_t x, int n) noexcept {
  expect(n >= 1 && n <= 63);
  const uint64_t y = (magnitude(x) + (uint64_t{1} << (n - 1))) >> n;
  return x < 0 ? -int64_t(y) : int64_t(y);
}

/// x y / 2^n to nearest for 1 <= n <= 16, |y| < 2^(32-n) and results below 2^31: two 32-bit
/// products, where 64 bits would call a helper on small chips.
constexpr int32_t mul_round(int32_t x, int32_t y, int n) noexcept {
  const uint32_t a = magnitude(x), b = magnitude(y), low = (uint32_t{1} << n) - 1;
  expect(n >= 1 && n <= 16 && b >> (32 - n) == 0 && (uint64_t{a} * b) >> n <= 0x7FFFFFFFu);
  const uint32_t product = (a >> n) * b + (((a & low) * b + (uint32_t{1} << (n - 1))) >> n);
  return (x < 0) != (y < 0) ? -int32_t(product) : int32_t(product);
}

/// The same for 17 <= n <= 47 and 0 <= y <= 2^16.
constexpr int32_t mul_shift(int32_t x, uint32_t y, int n) noexcept {
  const uint32_t a = magnitude(x);
  expect(n >= 17 && n <= 47 && y <= 65536u);
  const uint32_t high = (a >> 16) * y + (((a & 0xFFFFu) * y) >> 16);  // x y / 2^16, at most 2^31
  const uint32_t product = (high + (uint32_t{1} << (n - 17))) >> (n - 16);
  return x < 0 ? -int32_t(product) : int32_t(product);
}

}  // namespace urad
