// lambert_cell.hpp -- cells of a carrier, and what the points of one say about its sum.
#pragma once
#include "urad/q.hpp"
#include "urad/ratio.hpp"

namespace urad {

inline constexpr int kDeepest = 14;  // halvings of a side of a piece
inline constexpr int kRefinedPoints = 3;
inline constexpr int kNearDoubt = 5;    // a cell near an edge: 2^-5 of its greatest factor
inline constexpr int kDark = 4;         // a dark cell: less than 2^-4 of the greatest of all,
inline constexpr int kDarkShare = 2;    // of which it may hold 2^-2: points leave 0.21 at two edges
inline constexpr int kParentDoubt = 2;  // each half: 2^-2 of what halving changed

/// A cell, its sum, and what is known of how far that may be off; all 2^-22 of a span.
struct DoubtfulCell {
  int64_t value;
  int64_t doubt;   ///< by which cells are chosen
  int64_t slope;   ///< first differences along both sides
  int64_t bend;    ///< second differences along both sides
  int64_t change;  ///< half of what the halving that made it changed, with its sign
  uint16_t place_u, place_v;
  uint8_t level_u, level_v, piece;
  bool along_u;  ///< the side to halve
  bool near;     ///< an edge or vertex of the other is
  bool dark;     ///< and yet all points see little of it
};

inline uint64_t larger(uint64_t a, uint64_t b) noexcept { return a > b ? a : b; }

/// bend (bend / size)^3: what is left of a bend that falls by the same factor from order to order.
inline uint64_t orders_later(uint64_t bend, uint64_t size) noexcept {
  if (bend >= size) return bend;
  const uint64_t ratio_uq16 = uint64_t(ratio_q(int64_t(bend), int64_t(size), 16));
  uint64_t left = bend;
  for (int order = 0; order < 3; ++order) left = (left >> 16) * ratio_uq16;
  return left;
}

/// Differences of the factor along one side of a cell.
class Variation {
 public:
  /// The weighted sum at point k.
  void add(int points, int k, int64_t value) noexcept {
    if (points == 1) return;
    if (k == 0) slope_ -= value;
    if (k == points - 1) slope_ += value;
    if (points == 3) second_ += k == 1 ? -2 * value : value;
  }
  uint64_t slope() const noexcept { return magnitude(slope_); }
  /// The second difference, or what the first one makes likely: the second may pass through 0.
  uint64_t bend(uint64_t size) const noexcept {
    const uint64_t slope = magnitude(slope_);
    const uint64_t ratio_uq16 =
        slope < size ? uint64_t(ratio_q(int64_t(slope), int64_t(size), 16)) : 65536;
    return larger(magnitude(second_), (slope >> 18) * ratio_uq16);
  }

 private:
  int64_t slope_ = 0, second_ = 0;
};

}  // namespace urad
