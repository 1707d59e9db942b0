#include "urad/log2.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

TEST_CASE(
    "log2_q24 keeps its bound over a dense sweep, never falls, and is exact at powers of two") {
  double worst = 0;
  std::uint32_t at = 0;
  std::int32_t last = -1;
  for (std::uint64_t x = 1; x < (std::uint64_t{1} << 32);
       x += x < 1'000'000 ? 1 : x / 200'003 + 1) {
    const std::int32_t y = urad::log2_q24(std::uint32_t(x));
    const double error = std::fabs(y / 0x1p24 - std::log2(double(x)));
    if (error > worst) worst = error, at = std::uint32_t(x);
    CHECK_MESSAGE(y >= last, x);
    last = y;
  }
  INFO("worst input: ", at);
  CHECK(worst <= 2.9e-6);   // the bound in log2.hpp
  CHECK(worst <= 2.30e-6);  // measured
  for (int n = 0; n < 32; ++n) CHECK(urad::log2_q24(std::uint32_t{1} << n) == n << 24);
  CHECK(urad::log2_q24(std::uint32_t{0}) == 0);
}

TEST_CASE("log2_q24 of 64 bits agrees with that of 32 and keeps the bound") {
  for (std::uint32_t x : {1u, 2u, 3u, 1000u, 0xFFFFFFFFu})
    CHECK(urad::log2_q24(std::uint64_t{x}) == urad::log2_q24(x));
  double worst = 0;
  for (std::uint64_t x = 1; x < (std::uint64_t{1} << 63); x += x / 50'021 + 1) {
    worst = std::max(worst, std::fabs(urad::log2_q24(x) / 0x1p24 - std::log2(double(x))));
  }
  CHECK(worst <= 2.9e-6);
  CHECK(urad::log2_q24(~std::uint64_t{0}) <= 64 << 24);
}

TEST_CASE("exp2_uq keeps its bound on every fraction, never falls, and is exact at whole numbers") {
  double worst = 0;
  std::uint32_t last = 0;
  bool falls = false;
  for (std::int32_t x = 0; x < 1 << 24; ++x) {
    const std::uint32_t y = urad::exp2_uq(x, 30);
    falls = falls || y < last;
    last = y;
    worst = std::max(worst, std::fabs(y / (0x1p30 * std::exp2(x / 0x1p24)) - 1));
  }
  CHECK_FALSE(falls);
  CHECK(worst <= 9.8e-7);   // the bound in log2.hpp
  CHECK(worst <= 6.95e-7);  // measured
  for (int n = -30; n <= 31; ++n)
    CHECK(urad::exp2_uq(n * (1 << 24), 0) == (n < -1 ? 0u : n < 0 ? 1u : std::uint32_t{1} << n));
}

TEST_CASE("exp2_uq saturates above, vanishes below, and is total") {
  CHECK(urad::exp2_uq(INT32_MAX, 64) == 0xFFFFFFFFu);
  CHECK(urad::exp2_uq(INT32_MIN, -64) == 0);
  CHECK(urad::exp2_uq(32 << 24, 0) == 0xFFFFFFFFu);
  CHECK(urad::exp2_uq(0, 32) == 0xFFFFFFFFu);
  CHECK(urad::exp2_uq(-(1 << 24), 32) == 0x80000000u);
  for (int bits = -64; bits <= 64; ++bits) {
    for (std::int64_t x = INT32_MIN; x <= INT32_MAX; x += 1 << 20) {
      const double exact = std::exp2(double(x) / 0x1p24 + bits);
      const double y = urad::exp2_uq(std::int32_t(x), bits);
      CHECK(std::fabs(y - std::fmin(exact, 4294967295.0)) <= 0.5 + 1e-6 * exact);
    }
  }
}

TEST_CASE("rsqrt_uq keeps its bound over 62 bits") {
  double worst = 0;
  for (std::uint64_t x = 1; x < (std::uint64_t{1} << 62); x += x / 5'021 + 1) {
    const int bits = 31 + int(std::log2(double(x)) / 2);
    worst = std::max(
        worst, std::fabs(urad::rsqrt_uq(x, bits) * std::sqrt(double(x)) / std::exp2(bits) - 1));
  }
  CHECK(worst <= 2.4e-6);
}

TEST_CASE("rounding is symmetric in sign") {
  for (int n = 1; n < 31; ++n) {
    for (std::int64_t x :
         {1, 2, 3, 5, 1000, 12345, (1 << n) - 1, 1 << (n - 1), (1 << (n - 1)) + 1}) {
      CHECK(urad::round_shift(std::int32_t(-x), n) == -urad::round_shift(std::int32_t(x), n));
      CHECK(urad::round_shift(-x, n) == -urad::round_shift(x, n));
      CHECK(urad::round_shift(x, n) == std::llround(std::ldexp(double(x), -n)));
    }
  }
  CHECK(urad::magnitude(INT32_MIN) == 0x80000000u);
  CHECK(urad::magnitude(INT64_MIN) == std::uint64_t{1} << 63);
}
