#include "urad/pair.hpp"

#include "urad/vec.hpp"

namespace urad {

namespace {

struct Vec15 {
  int32_t x, y, z;
};

constexpr int32_t dot_q30(const Vec15& a, const Vec15& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

constexpr int16_t narrow_q15(int32_t x) noexcept {
  return int16_t(x > 32767 ? 32767 : x < -32767 ? -32767 : x);
}

constexpr Vec15 unit_q15(const urad_point& n_q30) noexcept {
  return {round_shift(n_q30.x, 15), round_shift(n_q30.y, 15), round_shift(n_q30.z, 15)};
}

/// x^2 / 2^32, low by less than 2 units: 2^-27 of the greatest component's square.
constexpr uint32_t square_high(int32_t x) noexcept {
  const uint32_t a = magnitude(x) >> 16, b = magnitude(x) & 0xFFFFu;
  return a * a + ((a * b) >> 15);
}

/// M v / tr M. |M v| <= |v| <= 1, and so is every partial sum times sqrt 2.
URAD_TOGETHER Vec15 spread_times(const urad_shape& shape, const Vec15& v) noexcept {
  const int16_t* m = shape.spread_q15;
  return {round_shift(m[0] * v.x + m[3] * v.y + m[4] * v.z, 15),
          round_shift(m[3] * v.x + m[1] * v.y + m[5] * v.z, 15),
          round_shift(m[4] * v.x + m[5] * v.y + m[2] * v.z, 15)};
}

/// x_uq22 (8 at most) times y_q15.
constexpr int32_t scaled_q22(uint32_t x_uq22, int32_t y_q15) noexcept {
  return mul_round(int32_t(x_uq22), y_q15, 15);
}

constexpr uint32_t limited(uint32_t x_uq22) noexcept {
  return x_uq22 < kSizeLimit_uq22 ? x_uq22 : kSizeLimit_uq22;
}

/// facing: the sign of m.w; log2_cosine_other: log2 |m.w|.
URAD_TOGETHER void look(const urad_shape& shape, int32_t log2_distance2_q24, const Vec15& w,
                        const Vec15& m, int facing, int32_t log2_cosine_q24,
                        int32_t log2_cosine_other_q24, PairSide* side) noexcept {
  const int32_t log2_size_q24 = shape.log2_spread_q24 - log2_distance2_q24;
  const Vec15 mw = spread_times(shape, w);
  const int32_t c_q15 = round_shift(dot_q30(mw, m), 15);
  side->shape = &shape;
  side->log2_cosine_q24 = log2_cosine_q24;
  side->log2_cosine_other_q24 = log2_cosine_other_q24;
  side->log2_slope_q24 = log2_size_q24 - log2_cosine_other_q24;
  side->size_uq22 = limited(exp2_uq(log2_size_q24, 22));
  side->along_q22 = scaled_q22(side->size_uq22, round_shift(dot_q30(mw, w), 15));
  side->across_q22 = scaled_q22(limited(exp2_uq(side->log2_slope_q24, 22)), facing * c_q15);
}

/// t / (1 + t).
int16_t slant_q15(const PairSide& side, const Vec15& m) noexcept {
  const int32_t mm_q15 = round_shift(dot_q30(spread_times(*side.shape, m), m), 15);
  const uint32_t steep_uq22 =
      limited(exp2_uq(side.log2_slope_q24 - side.log2_cosine_other_q24, 22));
  const uint32_t t_uq22 = uint32_t(scaled_q22(steep_uq22, mm_q15 > 0 ? mm_q15 : 0));
  return narrow_q15(32768 - int32_t(exp2_uq(-log2_1p_q24(t_uq22, 22), 15)));
}

/// An order of the two that depends on their invariants alone; equal in all means interchangeable.
bool comes_first(const PairSide& x, int16_t slant_x, const PairSide& y, int16_t slant_y) noexcept {
  const urad_shape &a = *x.shape, &b = *y.shape;
  if (a.log2_area_q24 != b.log2_area_q24) return a.log2_area_q24 > b.log2_area_q24;
  if (x.log2_cosine_q24 != y.log2_cosine_q24) return x.log2_cosine_q24 > y.log2_cosine_q24;
  if (x.size_uq22 != y.size_uq22) return x.size_uq22 > y.size_uq22;
  if (x.along_q22 != y.along_q22) return x.along_q22 > y.along_q22;
  if (x.across_q22 != y.across_q22) return x.across_q22 > y.across_q22;
  if (slant_x != slant_y) return slant_x > slant_y;
  return a.fill_uq15 >= b.fill_uq15;
}

/// T / sqrt(1 + (T/1.5)^2) in units of log2, T = T2 or T2 + T3. Long patches close above each other
/// have |T2| up to 224; beyond 63, where the square in UQ20 would wrap, it is within 0.03 % of its end.
int32_t bend_q24(int32_t any_t_q22) noexcept {
  const int32_t t_q22 = any_t_q22 > kTermLimit_q22    ? kTermLimit_q22
                        : any_t_q22 < -kTermLimit_q22 ? -kTermLimit_q22
                                                      : any_t_q22;
  const int64_t t_q14 = round_shift(t_q22, 8);
  const uint32_t square_uq20 = uint32_t(uint64_t(t_q14 * t_q14) >> 8);
  const uint32_t x_uq20 =
      (square_uq20 >> 16) * 29127u + (((square_uq20 & 0xFFFFu) * 29127u) >> 16);  // times 4/9
  const uint32_t factor_uq15 = exp2_uq(kLog2Log2E_q24 - shift_down(log2_1p_q24(x_uq20, 20), 1), 15);
  return mul_round(t_q22, int32_t(factor_uq15), 13);
}

void put(const PairSide& side, int16_t slant, uint32_t shrink_uq16, int16_t* input_q15) noexcept {
  const auto shrunk = [=](int32_t x_q22) { return narrow_q15(mul_shift(x_q22, shrink_uq16, 23)); };
  input_q15[0] = shrunk(int32_t(side.size_uq22));
  input_q15[1] = shrunk(side.along_q22);
  input_q15[2] = shrunk(side.across_q22);
  input_q15[3] = slant;
  input_q15[4] = narrow_q15(side.shape->fill_uq15);
}

int32_t t2_q22(const PairSide& side) noexcept {
  return 12 * side.along_q22 - 2 * int32_t(side.size_uq22) - 4 * side.across_q22;
}

}  // namespace

bool pair_kernel(const urad_shape& i, const urad_point& centroid_i, const urad_shape& j,
                 const urad_point& centroid_j, PairKernel* kernel) noexcept {
  // r with a local exponent: its greatest component in [2^30, 2^31).
  urad_point r = centroid_j - centroid_i;
  const int up = 30 - top_bit(magnitude(r.x) | magnitude(r.y) | magnitude(r.z));
  r = {r.x * (int32_t{1} << up), r.y * (int32_t{1} << up), r.z * (int32_t{1} << up)};
  const int64_t p = sparse_dot(i.normal_q30, r), q = -sparse_dot(j.normal_q30, r);
  if (p <= 0 || q <= 0) return false;

  const uint32_t r2 =
      square_high(r.x) + square_high(r.y) + square_high(r.z);  // R^2 / 2^32, 2^28 .. 3 2^30
  const int32_t log2_r2_q24 = log2_q24(r2) + (32 << 24);
  const int32_t log2_r_q24 = shift_down(log2_r2_q24, 1);
  const int32_t log2_distance2_q24 = log2_r2_q24 - (up << 25);
  const int32_t log2_p_q24 = log2_q24(uint64_t(p)) - (30 << 24) - log2_r_q24;
  const int32_t log2_q_q24 = log2_q24(uint64_t(q)) - (30 << 24) - log2_r_q24;

  // w = r / R: 16 bits of r times 17 of 1/R, the product below 2^30 because |w| <= 1.
  const int32_t inverse_uq15 = int32_t(exp2_uq((16 << 24) - log2_r_q24, 30));
  const auto direction = [=](int32_t x) {
    return round_shift(round_shift(x, 16) * inverse_uq15, 15);
  };
  const Vec15 w{direction(r.x), direction(r.y), direction(r.z)};
  PairSide* const side = kernel->side;
  look(i, log2_distance2_q24, w, unit_q15(j.normal_q30), -1, log2_p_q24, log2_q_q24, &side[0]);
  look(j, log2_distance2_q24, w, unit_q15(i.normal_q30), 1, log2_q_q24, log2_p_q24, &side[1]);

  kernel->rho_uq22 = side[0].size_uq22 + side[1].size_uq22;
  kernel->rho_uq16 = kernel->rho_uq22 >> 6;
  // Far pairs that graze each other reach 2^-180: all below 2^-64 is no light.
  const int64_t log2_kernel_q24 = int64_t{i.log2_area_q24} + j.log2_area_q24 - log2_distance2_q24 +
                                  (log2_p_q24 + log2_q_q24) - kLog2Pi_q24;
  constexpr int32_t least_q24 = -64 * (1 << 24), most_q24 = 63 << 24;
  kernel->log2_kernel_q24 = log2_kernel_q24 < least_q24  ? least_q24
                            : log2_kernel_q24 > most_q24 ? most_q24
                                                         : int32_t(log2_kernel_q24);
  kernel->log2_bend_q24 = bend_q24(t2_q22(side[0]) + t2_q22(side[1]));
  return true;
}

int32_t log2_bend_q24(const PairKernel& kernel, int32_t t3_q22) noexcept {
  return bend_q24(t2_q22(kernel.side[0]) + t2_q22(kernel.side[1]) + t3_q22);
}

int32_t log2_extent_q24(const PairKernel& kernel) noexcept {
  return bend_q24(t2_q22(kernel.side[0]));
}

void pair_inputs(const PairKernel& kernel, Pair* pair) noexcept {
  const PairSide *first = &kernel.side[0], *second = &kernel.side[1];
  const Vec15 n_0 = unit_q15(first->shape->normal_q30), n_1 = unit_q15(second->shape->normal_q30);
  int16_t slant_first = slant_q15(*first, n_1), slant_second = slant_q15(*second, n_0);
  if (!comes_first(*first, slant_first, *second, slant_second)) {
    first = &kernel.side[1];
    second = &kernel.side[0];
    const int16_t swap = slant_first;
    slant_first = slant_second;
    slant_second = swap;
  }
  const uint32_t shrink_uq16 = exp2_uq(-log2_1p_q24(kernel.rho_uq22, 22), 16);
  const uint32_t gate_uq16 = 65536u - shrink_uq16;  // rho / (1 + rho) < 1: its square fits
  pair->log2_kernel_q24 = kernel.log2_kernel_q24;
  pair->log2_bend_q24 = kernel.log2_bend_q24;
  pair->rho_uq16 = kernel.rho_uq16;
  pair->gate_uq16 = uint16_t((gate_uq16 * gate_uq16) >> 16);
  pair->input_q15[0] = narrow_q15(int32_t(exp2_uq(first->log2_cosine_q24, 15)));
  pair->input_q15[1] = narrow_q15(int32_t(exp2_uq(second->log2_cosine_q24, 15)));
  pair->input_q15[2] = narrow_q15(round_shift(dot_q30(n_0, n_1), 15));
  put(*first, slant_first, shrink_uq16, pair->input_q15 + 3);
  put(*second, slant_second, shrink_uq16, pair->input_q15 + 8);
  pair->input_q15[13] = narrow_q15(round_shift(kernel.log2_bend_q24, 11));
}

bool pair_invariants(const urad_shape& i, const urad_point& centroid_i, const urad_shape& j,
                     const urad_point& centroid_j, Pair* pair) noexcept {
  PairKernel kernel;
  if (!pair_kernel(i, centroid_i, j, centroid_j, &kernel)) return false;
  pair_inputs(kernel, pair);
  return true;
}

}  // namespace urad
