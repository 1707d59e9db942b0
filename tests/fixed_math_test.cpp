// The engine's arithmetic against exact sums: 16-bit arguments all of them, pairs of arguments over
// dense grids and all corners.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "urad/angle.hpp"
#include "urad/log2.hpp"
#include "urad/ratio.hpp"
#include "urad/sigmoid.hpp"
#include "urad/vec.hpp"

namespace {

using Wide = __int128;

/// What integer code breaks on: powers of two, their neighbours, both ends, and a scatter between.
std::vector<std::int64_t> corners(int bits) {
  std::vector<std::int64_t> all{0};
  for (int n = 0; n < bits; ++n)
    for (const std::int64_t step : {-1, 0, 1})
      for (const std::int64_t sign : {-1, 1})
        all.push_back(sign * (std::int64_t((std::uint64_t{1} << n) - (n == 63)) + step * (n < 63)));
  std::uint64_t random = 19930719;
  for (int n = 0; n < 100; ++n) {
    random = random * 6364136223846793005u + 1442695040888963407u;
    all.push_back(std::int64_t(random) >> (64 - bits + n % bits));
  }
  return all;
}

std::vector<std::int32_t> corners_32() {
  std::vector<std::int32_t> all{INT32_MIN, INT32_MAX};
  for (const std::int64_t x : corners(32))
    if (x >= INT32_MIN && x <= INT32_MAX) all.push_back(std::int32_t(x));
  return all;
}

/// x / 2^n to nearest, ties away from zero.
Wide rounded(Wide x, int n) {
  const Wide y = ((x < 0 ? -x : x) + (Wide{1} << (n - 1))) >> n;
  return x < 0 ? -y : y;
}

}  // namespace

TEST_CASE("round_shift of every 16-bit number by every shift is the nearest, ties away from zero") {
  bool same = true;
  for (int n = 1; n <= 31; ++n)
    for (std::int32_t x = -32768; x <= 32767; ++x) {
      const auto exact = std::int32_t(rounded(x, n));
      same =
          same && urad::round_shift<false>(x, n) == exact && urad::round_shift<true>(x, n) == exact;
    }
  CHECK(same);
}

// Of functions that have two ways, by <false> that of registers of 32 bits, by <true> of 64.
TEST_CASE("round_shift holds at all corners of 32 and 64 bits") {
  for (const std::int32_t x : corners_32())
    for (int n = 1; n <= 31; ++n) {
      CHECK(urad::round_shift<false>(x, n) == std::int32_t(rounded(x, n)));
      CHECK(urad::round_shift<true>(x, n) == std::int32_t(rounded(x, n)));
    }
  for (const std::int64_t x : corners(63))
    for (int n = 1; n <= 62; ++n) {
      CHECK(urad::round_shift<false>(x, n) == std::int64_t(rounded(x, n)));
      CHECK(urad::round_shift<true>(x, n) == std::int64_t(rounded(x, n)));
    }
  for (int n = 1; n <= 62; ++n)
    for (const std::int64_t sign : {-1, 1}) {
      const std::int64_t most = sign * (INT64_MAX - (std::int64_t{1} << (n - 1)));
      CHECK(urad::round_shift<false>(most, n) == std::int64_t(rounded(most, n)));
      CHECK(urad::round_shift<true>(most, n) == std::int64_t(rounded(most, n)));
    }
}

TEST_CASE("magnitude, top_bit and shift_down are what they say, at both ends too") {
  for (const std::int32_t x : corners_32()) {
    CHECK(urad::magnitude(x) == std::uint32_t(std::llabs(std::int64_t{x})));
    CHECK(urad::top_bit(std::uint32_t(x)) == (x ? std::ilogb(double(std::uint32_t(x))) : 0));
    for (int n = 0; n < 32; ++n)
      CHECK(urad::shift_down(x, n) == std::int32_t(std::floor(std::ldexp(double(x), -n))));
  }
  CHECK(urad::magnitude(INT64_MIN) == std::uint64_t{1} << 63);
  for (int n = 0; n < 64; ++n) {
    for (const std::uint64_t low : {std::uint64_t{0}, std::uint64_t{1}}) {
      CHECK(urad::top_bit<false>((std::uint64_t{1} << n) | low) == n);
      CHECK(urad::top_bit<true>((std::uint64_t{1} << n) | low) == n);
    }
    CHECK(urad::top_bit<false>((~std::uint64_t{0}) >> n) == 63 - n);
    CHECK(urad::top_bit<true>((~std::uint64_t{0}) >> n) == 63 - n);
    CHECK(urad::shift_down(INT64_MIN, n) == std::int64_t(-std::ldexp(1.0, 63 - n)));
  }
  CHECK(urad::top_bit<false>(std::uint64_t{0}) == 0);
  CHECK(urad::top_bit<true>(std::uint64_t{0}) == 0);
}

TEST_CASE("mul_round and mul_shift are the rounded product wherever they promise it") {
  const std::vector<std::int32_t> numbers = corners_32();
  for (const std::int32_t x : numbers) {
    for (const std::int32_t y : numbers)
      for (int n = 1; n <= 16; ++n) {
        const Wide exact = rounded(Wide{x} * y, n);
        if (urad::magnitude(y) >> (32 - n) != 0 || exact > INT32_MAX || exact < -INT32_MAX)
          continue;
        if ((Wide{urad::magnitude(x)} * urad::magnitude(y)) >> n > INT32_MAX) continue;
        CHECK(urad::mul_round<false>(x, y, n) == std::int32_t(exact));
        CHECK(urad::mul_round<true>(x, y, n) == std::int32_t(exact));
      }
    for (const std::uint32_t y :
         {0u, 1u, 2u, 3u, 255u, 256u, 32767u, 32768u, 40000u, 65535u, 65536u})
      for (int n = 17; n <= 47; ++n) {
        // Below 2^-16 of the product bits are dropped before it is rounded.
        const Wide high = (Wide{urad::magnitude(x)} * y) >> 16;
        const Wide exact = n == 16 ? high : (high + (Wide{1} << (n - 17))) >> (n - 16);
        CHECK(urad::mul_shift<false>(x, y, n) == std::int32_t(x < 0 ? -exact : exact));
        CHECK(urad::mul_shift<true>(x, y, n) == std::int32_t(x < 0 ? -exact : exact));
      }
  }
}

TEST_CASE("what is normalised in registers of 64 bits is what it is in two of 32") {
  for (const std::int64_t corner : corners(63)) {
    const std::uint64_t x = urad::magnitude(corner);
    CHECK(urad::log2_q24<false>(x) == urad::log2_q24<true>(x));
    CHECK(urad::scaled<false>(x).mantissa == urad::scaled<true>(x).mantissa);
    CHECK(urad::scaled<false>(x).exponent == urad::scaled<true>(x).exponent);
    if (x == 0) continue;
    CHECK(urad::inverse_root<false>(x).mantissa_uq30 == urad::inverse_root<true>(x).mantissa_uq30);
    CHECK(urad::inverse_root<false>(x).half == urad::inverse_root<true>(x).half);
  }
  CHECK(urad::log2_q24(std::uint64_t{0}) == 0);
  CHECK(urad::log2_q24(std::uint32_t{0}) == 0);
}

TEST_CASE("products of all pairs of 16-bit numbers on a grid are exact") {
  bool same = true;
  for (std::int32_t x = -32768; x <= 32767; x += 31)
    for (std::int32_t y = -32768; y <= 32767; y += 17)
      same = same && urad::mul_round(x, y, 15) == std::int32_t(rounded(Wide{x} * y, 15));
  CHECK(same);
}

// On this machine wide_mul() and wide_umul() are the plain product; a Cortex-M0 takes the other two.
TEST_CASE("products of 64 bits from 16-bit halves are the plain ones, signed and unsigned") {
  const auto same = [](std::int32_t a, std::int32_t b) {
    const auto ua = std::uint32_t(a), ub = std::uint32_t(b);
    return urad::split_mul(a, b) == std::int64_t{a} * b &&
           urad::wide_mul(a, b) == std::int64_t{a} * b &&
           urad::split_umul(ua, ub) == std::uint64_t{ua} * ub &&
           urad::wide_umul(ua, ub) == std::uint64_t{ua} * ub;
  };
  static_assert(urad::split_mul(INT32_MIN, INT32_MIN) == std::int64_t{1} << 62);
  static_assert(urad::split_umul(0xFFFFFFFFu, 0xFFFFFFFFu) == 0xFFFFFFFE00000001u);
  const auto all = corners_32();
  long wrong = 0;
  for (const std::int32_t a : all)
    for (const std::int32_t b : all) wrong += !same(a, b);
  for (const std::int32_t b : all)  // every half beside every corner: carries between the products
    for (std::uint32_t half = 0; half < 65536; half += 7) {
      wrong += !same(std::int32_t(half), b);
      wrong += !same(std::int32_t(half << 16 | 0xFFFFu), b);
    }
  CHECK(wrong == 0);
  constexpr unsigned kSeed = 32;
  CAPTURE(kSeed);
  std::mt19937 random(kSeed);
  for (int n = 0; n < 4'000'000; ++n) {
    const auto a = std::int32_t(random()) >> (n % 17), b = std::int32_t(random()) >> (n / 17 % 17);
    wrong += !same(a, b);
  }
  CHECK(wrong == 0);
}

TEST_CASE("scaled keeps the leading 32 bits; quotients have 29 good ones over a dense grid") {
  CHECK(urad::scaled(0).mantissa == 0);
  CHECK(urad::scaled(0).exponent == 0);
  double worst = 0;
  for (const std::int64_t a : corners(63)) {
    const std::uint64_t x = urad::magnitude(a);
    const urad::Scaled s = urad::scaled(x);
    if (x) {
      CHECK(urad::top_bit(s.mantissa) == 31);
      const int down = std::max(s.exponent, 0), up = std::max(-s.exponent, 0);
      CHECK(std::uint64_t{s.mantissa} == (x >> down) << up);
    }
    for (const std::int64_t b : corners(63)) {
      if (b <= 0) continue;
      for (const int bits : {0, 15, 30, 62}) {
        const double exact = std::ldexp(double(a) / double(b), bits);
        const double got = double(urad::ratio_q(a, b, bits));
        if (std::fabs(exact) >= 0x1p62) {
          CHECK(std::fabs(got) >= 0x1p62 * (1 - 0x1p-29));
          CHECK((got < 0) == (a < 0));
          continue;
        }
        worst = std::max(worst, (std::fabs(got - exact) - 1) / std::max(std::fabs(exact), 1.0));
      }
    }
  }
  CHECK(worst <= 0x1p-29);
}

TEST_CASE("to_q drops what is below and saturates above, at every exponent") {
  for (int exponent = -200; exponent <= 200; ++exponent)
    for (const std::uint32_t m : {0x80000000u, 0x80000001u, 0xFFFFFFFFu}) {
      const double exact = std::floor(std::ldexp(double(m), exponent));
      const bool too_large = exponent > 30;
      CHECK(urad::to_q({m, exponent - 7}, 7) ==
            (too_large ? std::int64_t{1} << 62 : std::int64_t(exact)));
    }
  CHECK(urad::to_q({0, 100}, 100) == 0);
}

TEST_CASE("inverse_uq62 keeps its bound near 2^32, where it was stated too small") {
  double worst = 0;
  for (std::uint64_t m = std::uint64_t{1} << 31; m < std::uint64_t{1} << 32; m += 4099)
    worst =
        std::max(worst, std::fabs(urad::inverse_uq62(std::uint32_t(m)) * double(m) / 0x1p62 - 1));
  for (const std::uint32_t m : {0x80000000u, 0x80000001u, 0xFFFF374Cu, 0xFFFFFFFEu, 0xFFFFFFFFu})
    worst = std::max(worst, std::fabs(urad::inverse_uq62(m) * double(m) / 0x1p62 - 1));
  CHECK(worst <= 1.08e-9);  // the bound in ratio.hpp
  CHECK(worst >= 1.07e-9);  // and its worst mantissa is among these
}

TEST_CASE("inverse_root and angle_q29 keep their bounds over grids, corners and octants") {
  double worst_root = 0, worst_angle = 0;
  for (std::uint64_t x = 1; x < std::uint64_t{1} << 63; x += x / 4003 + 1) {
    const urad::InverseRoot r = urad::inverse_root(x);
    worst_root = std::max(
        worst_root,
        std::fabs(std::ldexp(r.mantissa_uq30 * 0x1p-30, -r.half) * std::sqrt(double(x)) - 1));
  }
  CHECK(worst_root <= 2.0e-9);  // the bound in angle.hpp
  for (const std::int64_t x : corners(61))
    for (const std::int64_t y : corners(61)) {
      if (y < 0) continue;  // at 0, 0 both say 0
      worst_angle = std::max(worst_angle, std::fabs(urad::angle_q29(x, y) * 0x1p-29 -
                                                    std::atan2(double(y), double(x))));
    }
  for (int k = 0; k <= 200000; ++k) {
    const double angle = k * 3.14159265358979323846 / 200000;
    const auto x = std::int64_t(std::llround(0x1p40 * std::cos(angle)));
    const auto y = std::int64_t(std::llround(0x1p40 * std::sin(angle)));
    worst_angle = std::max(
        worst_angle, std::fabs(urad::angle_q29(x, y) * 0x1p-29 - std::atan2(double(y), double(x))));
  }
  CHECK(worst_angle <= 5.0e-9);  // the bound in angle.hpp
}

TEST_CASE("log2_1p_q24 holds for every 16-bit argument at every fraction") {
  double worst = 0;
  for (int bits = 0; bits <= 24; ++bits)
    for (std::uint32_t x = 0; x <= 65535; ++x)
      worst = std::max(worst, std::fabs(urad::log2_1p_q24(x, bits) * 0x1p-24 -
                                        std::log2(1 + std::ldexp(double(x), -bits))));
  CHECK(worst <= 2.9e-6);
}

TEST_CASE("products of points are exact at all corners, sparse or not") {
  const std::int32_t most = 1 << 29, unit = 1 << 30;
  const std::int32_t at[] = {-most, -1, 0, 1, 12345, most}, n[] = {-unit, -3, 0, 1, unit};
  for (const std::int32_t ax : at)
    for (const std::int32_t ay : at)
      for (const std::int32_t bx : n)
        for (const std::int32_t by : n)
          for (const std::int32_t z : {-7, 0, unit}) {
            const urad_point a{ax, ay, most}, b{bx, by, z};
            const Wide exact = Wide{ax} * bx + Wide{ay} * by + Wide{most} * z;
            CHECK(urad::dot(a, b) == std::int64_t(exact));
            CHECK(urad::sparse_dot(b, a) == std::int64_t(exact));
            const urad_point origin{0, 0, 0}, from_a = urad::operator-(origin, a);
            CHECK((from_a.x == -ax && from_a.y == -ay && from_a.z == -most));
            const Wide distance = rounded(exact, 30);
            if (distance > INT32_MIN && distance < INT32_MAX)
              CHECK(urad::plane_distance(b, origin, a) == std::int32_t(distance));
          }
}

TEST_CASE("sigmoid_uq15 at corners: both ends, the middle, and one") {
  CHECK(urad::sigmoid_uq15(0) == 16384);
  CHECK(urad::sigmoid_uq15(32767) == 32768);
  CHECK(urad::sigmoid_uq15(-32768) == 0);
  CHECK(urad::sigmoid_uq15(2048) == 23955);  // sigma(1)
}
