// lambert_piece.hpp -- Gauss points on a bilinear piece of a patch, and on the cells it is halved
// into.
#pragma once
#include "urad/vec.hpp"

namespace urad {

/// Gauss-Legendre points on 0 .. 1, the lower half of them; the rest are their mirror images. 22
/// bits, so that halving a cell leaves no rounding.
constexpr int32_t node(double x) { return int32_t(x * 4194304.0 + 0.5) * 256; }
inline constexpr int32_t kNode_q30[4][2] = {{node(0.5), 0},
                                            {node(0.21132486540518712), 0},
                                            {node(0.1127016653792583), node(0.5)},
                                            {node(0.06943184420297371), node(0.33000947820757187)}};
inline constexpr uint32_t kWeight_uq15[4][2] = {
    {32768, 0}, {16384, 0}, {9102, 14564}, {5699, 10685}};

/// Place and weight of point k of n.
struct GaussPoint {
  int32_t at_q30;
  uint32_t weight_uq15;
};
inline GaussPoint gauss_point(int n, int k) noexcept {
  const bool upper = 2 * k >= n;
  const int at = upper ? n - 1 - k : k;
  const int32_t low_q30 = kNode_q30[n - 1][at];
  return {upper ? (1 << 30) - low_q30 : low_q30, kWeight_uq15[n - 1][at]};
}

/// A bilinear patch of the plane: corners in order, and the area of the parallelogram that the
/// sides span at each corner. A triangle has its first corner twice (0 and 3).
struct Piece {
  urad_point corner[4];
  int64_t span[4];  // times 2^-exponent
  int exponent;
};

struct Weights {
  int32_t q30[4];
};
inline Weights bilinear(int32_t u_q30, int32_t v_q30) noexcept {
  constexpr int32_t one = 1 << 30;
  const auto times = [](int32_t a, int32_t b) { return int32_t(round_shift(wide_mul(a, b), 30)); };
  return {{times(one - u_q30, one - v_q30), times(u_q30, one - v_q30), times(u_q30, v_q30),
           times(one - u_q30, v_q30)}};
}

inline urad_point point_of(const Piece& piece, int32_t u_q30, int32_t v_q30) noexcept {
  const Weights w = bilinear(u_q30, v_q30);
  int64_t sum[3] = {0, 0, 0};
  for (int k = 0; k < 4; ++k) {
    sum[0] += wide_mul(w.q30[k], piece.corner[k].x);
    sum[1] += wide_mul(w.q30[k], piece.corner[k].y);
    sum[2] += wide_mul(w.q30[k], piece.corner[k].z);
  }
  return {int32_t(round_shift(sum[0], 30)), int32_t(round_shift(sum[1], 30)),
          int32_t(round_shift(sum[2], 30))};
}

inline int64_t span_at(const Piece& piece, int32_t u_q30, int32_t v_q30) noexcept {
  const Weights w = bilinear(u_q30, v_q30);
  int64_t sum = 0;
  for (int k = 0; k < 4; ++k) sum += round_shift(w.q30[k] * piece.span[k], 2);
  return round_shift(sum, 28);
}

/// A part of a piece: u from place_u / 2^level_u on, 1 / 2^level_u wide.
struct Cell {
  uint8_t place_u, place_v, level_u, level_v;

  int32_t u_q30(int32_t in_q30) const noexcept {
    return place_u * (int32_t{1} << (30 - level_u)) + shift_down(in_q30, level_u);
  }
  int32_t v_q30(int32_t in_q30) const noexcept {
    return place_v * (int32_t{1} << (30 - level_v)) + shift_down(in_q30, level_v);
  }
};

}  // namespace urad
