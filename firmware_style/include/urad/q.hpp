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

// Cores with Thumb-1 alone (Cortex-M0, M0+, M23) have no product of 32 by 32 bits in 64 and eight
// registers; what calls itself URAD_APART is a function there, as part of a loop it runs out of them.
#if defined(__ARM_ARCH_ISA_THUMB) && __ARM_ARCH_ISA_THUMB == 1
inline constexpr bool kLongMultiply = false;
#define URAD_APART [[gnu::noinline]]
#else
inline constexpr bool kLongMultiply = true;
#define URAD_APART
#endif

// Where a register holds 64 bits, sums that could leave 32 need no care, and branches on signs cost more
// than they save: the same integers in fewer steps. What calls itself URAD_TOGETHER is part of its
// callers there.
#if UINTPTR_MAX > 0xFFFFFFFF
inline constexpr bool kWideRegisters = true;
#define URAD_TOGETHER [[gnu::always_inline]] inline
#else
inline constexpr bool kWideRegisters = false;
#define URAD_TOGETHER
#endif

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
template <bool wide = kWideRegisters>
constexpr int top_bit(uint64_t x) noexcept {
  if (wide) return 63 - __builtin_clzll(x | 1u);
  return x >> 32 ? 32 + top_bit(uint32_t(x >> 32)) : top_bit(uint32_t(x));
}

/// |x| as unsigned; no overflow at the most negative value.
constexpr uint32_t magnitude(int32_t x) noexcept { return x < 0 ? 0u - uint32_t(x) : uint32_t(x); }
constexpr uint64_t magnitude(int64_t x) noexcept { return x < 0 ? 0u - uint64_t(x) : uint64_t(x); }

/// x / 2^n to nearest. 1 <= n <= 31 and any x; for 64 bits n <= 62 and |x| below 2^63 - 2^(n-1).
///   In wide registers floor((x + h) / 2h), h = 2^(n-1), one less in the numerator below 0
template <bool wide = kWideRegisters>
constexpr int64_t round_shift(int64_t x, int n) noexcept {
  expect(n >= 1 && n <= 62 && magnitude(x) < (uint64_t{1} << 63) - (uint64_t{1} << (n - 1)));
  // Callers see to n: NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult)
  if (wide) return shift_down(x + (int64_t{1} << (n - 1)) + shift_down(x, 63), n);
  const uint64_t y = (magnitude(x) + (uint64_t{1} << (n - 1))) >> n;
  return x < 0 ? -int64_t(y) : int64_t(y);
}
template <bool wide = kWideRegisters>
constexpr int32_t round_shift(int32_t x, int n) noexcept {
  expect(n >= 1 && n <= 31);
  if (wide) return int32_t(round_shift(int64_t{x}, n));
  const uint32_t y = (magnitude(x) + (uint32_t{1} << (n - 1))) >> n;
  return x < 0 ? -int32_t(y) : int32_t(y);
}

/// x y in 64 bits from four products of 16, for cores that have no other: the compiler's own is a
/// call that multiplies 64 bits by 64. docs/DESIGN.md has what it saves.
///   a b = 2^32 ah bh + 2^16 (ah bl + al bh) + al bl; each sum below keeps within 32 bits, as
///   (2^16 - 1)^2 + 2 (2^16 - 1) < 2^32, and signed 2^15 (2^16 - 1) + 2^16 - 1 < 2^31
URAD_APART constexpr uint64_t split_umul(uint32_t a, uint32_t b) noexcept {
  const uint32_t al = uint16_t(a), ah = a >> 16, bl = uint16_t(b), bh = b >> 16;
  const uint32_t one = ah * bl + ((al * bl) >> 16), other = al * bh + uint16_t(one);
  return uint64_t{ah * bh + (one >> 16) + (other >> 16)} << 32 | a * b;
}
URAD_APART constexpr int64_t split_mul(int32_t a, int32_t b) noexcept {
  const int32_t al = uint16_t(a), ah = shift_down(a, 16), bl = uint16_t(b), bh = shift_down(b, 16);
  const uint32_t low = uint32_t(al) * uint32_t(bl);
  const int32_t one = ah * bl + int32_t(low >> 16), other = al * bh + uint16_t(one);
  const int32_t high = ah * bh + shift_down(one, 16) + shift_down(other, 16);
  return int64_t(uint64_t{uint32_t(high)} << 32 | uint32_t(a) * uint32_t(b));
}

/// x y, exact.
constexpr uint64_t wide_umul(uint32_t x, uint32_t y) noexcept {
  return kLongMultiply ? uint64_t{x} * y : split_umul(x, y);
}
constexpr int64_t wide_mul(int32_t x, int32_t y) noexcept {
  return kLongMultiply ? int64_t{x} * y : split_mul(x, y);
}

/// sum + x_0 y_0 + x_1 y_1 + ..., n terms that fit in 32 bits. On a Cortex-M0 seven instructions a
/// term; nine and more inline. Unrolled before it is seen that eight products go at a time, none do.
template <class Factor>
URAD_APART constexpr int32_t add_products(int32_t sum, const Factor* x, const int16_t* y,
                                          int n) noexcept {
#pragma GCC unroll 1
  for (int k = 0; k < n; ++k) sum += x[k] * y[k];
  return sum;
}

/// x y / 2^n to nearest for 1 <= n <= 16, |y| < 2^(32-n) and results below 2^31: two 32-bit
/// products, where 64 bits would call a helper on small chips.
template <bool wide = kWideRegisters>
constexpr int32_t mul_round(int32_t x, int32_t y, int n) noexcept {
  const uint32_t a = magnitude(x), b = magnitude(y), low = (uint32_t{1} << n) - 1;
  expect(n >= 1 && n <= 16 && b >> (32 - n) == 0 && (uint64_t{a} * b) >> n <= 0x7FFFFFFFu);
  if (wide) return int32_t(round_shift(int64_t{x} * y, n));
  const uint32_t product = (a >> n) * b + (((a & low) * b + (uint32_t{1} << (n - 1))) >> n);
  return (x < 0) != (y < 0) ? -int32_t(product) : int32_t(product);
}

/// The same for 17 <= n <= 47 and 0 <= y <= 2^16.
template <bool wide = kWideRegisters>
constexpr int32_t mul_shift(int32_t x, uint32_t y, int n) noexcept {
  const uint32_t a = magnitude(x);
  expect(n >= 17 && n <= 47 && y <= 65536u);
  if (wide) return int32_t(round_shift(int64_t{x} * int64_t{y}, n));
  const uint32_t high = (a >> 16) * y + (((a & 0xFFFFu) * y) >> 16);  // x y / 2^16, at most 2^31
  const uint32_t product = (high + (uint32_t{1} << (n - 17))) >> (n - 16);
  return x < 0 ? -int32_t(product) : int32_t(product);
}

}  // namespace urad
