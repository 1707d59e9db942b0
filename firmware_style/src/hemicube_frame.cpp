// The half cube's own axes: two in the plane of the patch, turned by an angle of the patch, and the
// normal.
#include "urad/hemicube.hpp"
#include "urad/log2.hpp"
#include "urad/vec.hpp"

namespace urad {

namespace {

struct Turn {
  int32_t cos_q30, sin_q30;
};
struct Turns {
  Turn turn[32];
};

/// e^(i x) for 0 <= x <= pi/2 by Taylor, compile time only.
constexpr Turns make_turns() {
  Turns turns{};
  for (int k = 0; k < 32; ++k) {
    const double x = (k + 0.5) / 64 * 3.14159265358979323846;
    double cosine = 0, sine = 0, term = 1;
    for (int n = 0; n < 24; n += 2) {
      cosine += term;
      term *= x / (n + 1);
      sine += term;
      term *= -x / (n + 2);
    }
    turns.turn[k] = {int32_t(cosine * 1073741824.0 + 0.5), int32_t(sine * 1073741824.0 + 0.5)};
  }
  return turns;
}

constexpr Turns kTurns = make_turns();  // 256 bytes of ROM

/// Turned by 2^-10 even when not turned: in an upright room whole rows of cells would look exactly
/// along its edges, where the rounding of two walls decides between twice and not at all.
constexpr Turn kHair = {(int32_t{1} << 30) - (1 << 9), 1 << 20};

constexpr int32_t mul_q30(int32_t a, int32_t b) noexcept {
  return int32_t(round_shift(wide_mul(a, b), 30));
}

/// The low five bits in reverse: neighbours in a grid get angles far apart.
constexpr int reversed5(uint16_t k) noexcept {
  return (k & 1) << 4 | (k & 2) << 2 | (k & 4) | (k & 8) >> 2 | (k & 16) >> 4;
}

/// 1 / sqrt(x), both Q2.30, 2/3 <= x <= 1: the table's 18 bits, doubled by one Newton step.
constexpr int32_t rsqrt_q30(int32_t x_q30) noexcept {
  const int32_t y = int32_t(rsqrt_uq(uint64_t(x_q30), 45));
  return int32_t(
      round_shift(int64_t{y} * ((int64_t{3} << 30) - mul_q30(x_q30, mul_q30(y, y))), 31));
}

/// Unit vector across n: the coordinate axis that is most across it, times n. 1 - n_k^2 >= 2/3 for
/// the least |n_k|.
urad_point across(const urad_point& n) noexcept {
  const uint32_t x = magnitude(n.x), y = magnitude(n.y), z = magnitude(n.z);
  const bool least_x = x <= y && x <= z, least_y = !least_x && y <= z;
  const int32_t least = least_x ? n.x : least_y ? n.y : n.z;
  const int32_t grow = rsqrt_q30((int32_t{1} << 30) - mul_q30(least, least));
  if (least_x) return {0, mul_q30(-n.z, grow), mul_q30(n.y, grow)};
  if (least_y) return {mul_q30(n.z, grow), 0, mul_q30(-n.x, grow)};
  return {mul_q30(-n.y, grow), mul_q30(n.x, grow), 0};
}

urad_point cross(const urad_point& a, const urad_point& b) noexcept {
  const auto minor = [](int32_t p, int32_t q, int32_t r, int32_t s) {
    return int32_t(round_shift(wide_mul(p, q) - wide_mul(r, s), 30));
  };
  return {minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
}

}  // namespace

HemicubeFrame hemicube_frame(const urad_point& normal_q30, uint16_t patch, bool turned) noexcept {
  const urad_point u = across(normal_q30), v = cross(normal_q30, u);
  const Turn turn = turned ? kTurns.turn[reversed5(patch)] : kHair;
  const auto mix = [](int32_t a, int32_t p, int32_t b, int32_t q) {
    return int32_t(round_shift(wide_mul(a, p) + wide_mul(b, q), 30));
  };
  const int32_t c = turn.cos_q30, s = turn.sin_q30;
  return {{{mix(u.x, c, v.x, s), mix(u.y, c, v.y, s), mix(u.z, c, v.z, s)},
           {mix(v.x, c, u.x, -s), mix(v.y, c, u.y, -s), mix(v.z, c, u.z, -s)},
           normal_q30}};
}

}  // namespace urad
