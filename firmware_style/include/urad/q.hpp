// q.hpp -- fixed-point arithmetic: rounding, wide products, log2, exp2, reciprocals, square roots.
//
// Formats are in the names: x_q15 is signed with 15 fraction bits, x_uq32 unsigned with 32. Every
// function is constexpr, total (no input is undefined), and uses integers only. Rounding is to
// nearest with ties away from zero, so that f(-x) = -f(x): a mirrored scene gives mirrored bits.
#pragma once
#include <stddef.h>
#include <stdint.h>

namespace urad {

/// The only right shift of negative numbers in the engine: towards minus infinity (C++20 defines
/// it; all our C++17 compilers do it).
constexpr int32_t shift_down(int32_t x, int n) noexcept { return x >> n; }
constexpr int64_t shift_down(int64_t x, int n) noexcept { return x >> n; }

/// x / 2^n to nearest, ties away from zero. 1 <= n <= 30 (62 for 64 bits), |x| <= 2^31 - 2^(n-1)
/// (2^63 - ..).
constexpr int32_t round_shift(int32_t x, int n) noexcept {
  const int32_t half = int32_t{1} << (n - 1);
  return x < 0 ? -shift_down(-x + half, n) : shift_down(x + half, n);
}
constexpr int64_t round_shift(int64_t x, int n) noexcept {
  const int64_t half = int64_t{1} << (n - 1);
  return x < 0 ? -shift_down(-x + half, n) : shift_down(x + half, n);
}

/// Position of the highest set bit, 0 .. 31 (63); 0 for x = 0.
constexpr int top_bit(uint32_t x) noexcept {
  int n = 0;
  if (x >> 16) n += 16, x >>= 16;
  if (x >> 8) n += 8, x >>= 8;
  if (x >> 4) n += 4, x >>= 4;
  if (x >> 2) n += 2, x >>= 2;
  return n + int(x >> 1);
}
constexpr int top_bit(uint64_t x) noexcept {
  return x >> 32 ? 32 + top_bit(uint32_t(x >> 32)) : top_bit(uint32_t(x));
}

/// |x| as unsigned; no overflow at the most negative value.
constexpr uint32_t magnitude(int32_t x) noexcept { return x < 0 ? 0u - uint32_t(x) : uint32_t(x); }
constexpr uint64_t magnitude(int64_t x) noexcept { return x < 0 ? 0u - uint64_t(x) : uint64_t(x); }

}  // namespace urad
