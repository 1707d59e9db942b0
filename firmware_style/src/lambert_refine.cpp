#include "lambert_carrier.hpp"
#include "lambert_near.hpp"
#include "urad/lambert.hpp"

namespace urad {

namespace {

constexpr int kDeepest = 14;  // halvings of a side of a piece
constexpr int kPending = 24;  // cells that may still be halved; the least doubtful drop out
constexpr int kRefinedPoints = 3;
constexpr int kNearDoubt = 5;    // a cell near an edge is in doubt by 2^-5 of its greatest factor
constexpr int kParentDoubt = 2;  // each half by 2^-2 of what halving changed

/// A cell, its sum, and how far that may be off; both 2^-22 of a span.
struct DoubtfulCell {
  int64_t value, doubt;
  uint16_t place_u, place_v;
  uint8_t level_u, level_v, piece;
  bool along_u;  // the side to halve
};

uint64_t larger(uint64_t a, uint64_t b) noexcept { return a > b ? a : b; }

/// bend (bend / size)^3: what is left of a bend that falls by the same factor from order to order.
uint64_t orders_later(uint64_t bend, uint64_t size) noexcept {
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

class Refiner {
 public:
  Refiner(const Pieces& pieces, const Outline& receiver, const urad_point& normal_q30) noexcept
      : pieces_(pieces), receiver_(receiver), normal_q30_(normal_q30) {}

  /// Every piece as one cell.
  void add_pieces(int points, bool to_refine) noexcept {
    pieces_.for_each([&](int number, const Piece& piece) {
      area_ += mean_span(piece);
      DoubtfulCell cell{0, 0, 0, 0, 0, 0, uint8_t(number), false};
      measure(piece, points, to_refine, &cell);
      keep(cell);
    });
  }

  /// Halves the most doubtful cell again and again.
  void refine(int32_t log2_doubt_q24) noexcept {
    while (cells_ < kMostRefinedCells && count_ > 0 && doubt_q24() > log2_doubt_q24) {
      const DoubtfulCell parent = take_worst();
      value_ -= parent.value;
      doubt_ -= parent.doubt;
      pieces_.for_each([&](int number, const Piece& piece) {
        if (number == parent.piece) halve(piece, parent);
      });
    }
  }

  int64_t value() const noexcept { return value_; }
  int64_t area() const noexcept { return area_; }
  int point_sums() const noexcept { return point_sums_; }
  /// log2 of doubt / value; the most there is where the value has no sign yet.
  int32_t doubt_q24() const noexcept {
    if (doubt_ == 0) return kNoDoubt_q24;
    if (value_ <= 0) return INT32_MAX;
    return log2_q24(uint64_t(doubt_)) - log2_q24(uint64_t(value_));
  }

 private:
  static int64_t mean_span(const Piece& piece) noexcept {
    return round_shift(piece.span[0] + piece.span[1] + piece.span[2] + piece.span[3], 2);
  }

  void halve(const Piece& piece, const DoubtfulCell& parent) noexcept {
    DoubtfulCell half[2] = {parent, parent};
    for (int k = 0; k < 2; ++k) {
      if (parent.along_u) {
        half[k].place_u = uint16_t(2 * parent.place_u + k);
        ++half[k].level_u;
      } else {
        half[k].place_v = uint16_t(2 * parent.place_v + k);
        ++half[k].level_v;
      }
      measure(piece, kRefinedPoints, true, &half[k]);
    }
    const int64_t change =
        int64_t(magnitude(parent.value - half[0].value - half[1].value)) >> kParentDoubt;
    for (DoubtfulCell& cell : half) {
      if (cell.doubt < change) cell.doubt = change;
      keep(cell);
    }
  }

  void keep(const DoubtfulCell& cell) noexcept {
    value_ += cell.value;
    doubt_ += cell.doubt;
    if (cell.doubt == 0 || (cell.along_u ? cell.level_u : cell.level_v) >= kDeepest) return;
    if (count_ < kPending) {
      pending_[count_++] = cell;
      return;
    }
    int least = 0;
    for (int k = 1; k < count_; ++k)
      if (pending_[k].doubt < pending_[least].doubt) least = k;
    if (pending_[least].doubt < cell.doubt) pending_[least] = cell;
  }

  DoubtfulCell take_worst() noexcept {
    int worst = 0;
    for (int k = 1; k < count_; ++k)
      if (pending_[k].doubt > pending_[worst].doubt) worst = k;
    const DoubtfulCell cell = pending_[worst];
    pending_[worst] = pending_[--count_];
    return cell;
  }

  static urad_point place(const Piece& piece, const DoubtfulCell& cell, int32_t u_q30,
                          int32_t v_q30) noexcept {
    return point_of(piece, u_in_piece(cell, u_q30), v_in_piece(cell, v_q30));
  }
  static int32_t u_in_piece(const DoubtfulCell& cell, int32_t u_q30) noexcept {
    return cell.place_u * (int32_t{1} << (30 - cell.level_u)) + shift_down(u_q30, cell.level_u);
  }
  static int32_t v_in_piece(const DoubtfulCell& cell, int32_t v_q30) noexcept {
    return cell.place_v * (int32_t{1} << (30 - cell.level_v)) + shift_down(v_q30, cell.level_v);
  }

  /// Sum and doubt of a cell. Widths: area times factor below 2^53, times weights of 15 bits after
  /// a shift by as much.
  void measure(const Piece& piece, int points, bool to_refine, DoubtfulCell* cell) noexcept {
    ++cells_;
    point_sums_ += points * points;
    int64_t sum = 0, most = 0;
    const int64_t whole = mean_span(piece);
    Variation along_u_variation, along_v_variation;
    for (int a = 0; a < points; ++a) {
      const GaussPoint u = gauss_point(points, a);
      const int32_t u_q30 = u_in_piece(*cell, u.at_q30);
      for (int b = 0; b < points; ++b) {
        const GaussPoint v = gauss_point(points, b);
        const int32_t v_q30 = v_in_piece(*cell, v.at_q30);
        const urad_point x = point_of(piece, u_q30, v_q30);
        const uint32_t factor_uq30 = lambert_sum_uq30(x, normal_q30_, receiver_);
        const int64_t f = round_shift(span_at(piece, u_q30, v_q30) * int64_t{factor_uq30}, 8);
        sum += round_shift(round_shift(f, 15) * v.weight_uq15, 15) * u.weight_uq15;
        // Of the factor alone: that a triangle narrows to its corner is no bend.
        const int64_t even = round_shift(whole * int64_t{factor_uq30}, 23);
        along_u_variation.add(points, a, even * v.weight_uq15);
        along_v_variation.add(points, b, even * u.weight_uq15);
        if (int64_t(magnitude(f)) > most) most = int64_t(magnitude(f));
      }
    }
    const int level = cell->level_u + cell->level_v;
    const uint64_t bend_u = along_u_variation.bend(magnitude(sum));
    const uint64_t bend_v = along_v_variation.bend(magnitude(sum));
    const uint64_t bend = bend_u + bend_v;
    cell->value = level ? round_shift(sum, level) : sum;
    cell->along_u = bend_u >= bend_v;
    uint64_t doubt = bend;
    if (points == kRefinedPoints) {
      doubt = orders_later(bend, magnitude(sum));
      if (to_refine && is_near(piece, cell)) doubt = larger(doubt, uint64_t(most) >> kNearDoubt);
    }
    cell->doubt = int64_t(doubt >> level);
  }

  /// Whether an edge of the receiver is near by the size of the cell; a long cell is then halved
  /// across.
  bool is_near(const Piece& piece, DoubtfulCell* cell) const noexcept {
    constexpr int32_t one = 1 << 30, half = 1 << 29;
    const urad_point corner[4] = {place(piece, *cell, 0, 0), place(piece, *cell, one, 0),
                                  place(piece, *cell, one, one), place(piece, *cell, 0, one)};
    const uint64_t u2 = larger(square(corner[1] - corner[0]), square(corner[2] - corner[3]));
    const uint64_t v2 = larger(square(corner[3] - corner[0]), square(corner[2] - corner[1]));
    if (!near_edge(receiver_, normal_q30_, place(piece, *cell, half, half),
                   log2_q24(larger(u2, v2))))
      return false;
    if (u2 > 4 * v2) cell->along_u = true;
    if (v2 > 4 * u2) cell->along_u = false;
    return true;
  }

  const Pieces& pieces_;
  const Outline& receiver_;
  urad_point normal_q30_;
  int64_t value_ = 0, doubt_ = 0, area_ = 0;
  int cells_ = 0, count_ = 0, point_sums_ = 0;
  DoubtfulCell pending_[kPending];
};

template <class Work>
LambertSum summed(const urad_scene& scene, const Patch& i, const Patch& j, Work work) noexcept {
  LambertPair pair;
  if (!lambert_pair(scene, i, j, &pair)) return {kNoExchange, 0, 0};
  const urad_point& n = pair.carrier->shape->normal_q30;
  const Outline from = pair.from(scene), to = pair.to(scene);
  const Pieces pieces(from, n);
  Refiner refiner(pieces, to, n);
  work(refiner);
  const int32_t log2_g_q24 =
      pair.log2_exchange_q24(refiner.value(), refiner.area(), pieces.exponent());
  return {log2_g_q24, refiner.doubt_q24(), uint16_t(refiner.point_sums())};
}

}  // namespace

LambertSum lambert_whole(const urad_scene& scene, const Patch& i, const Patch& j,
                         int points) noexcept {
  return summed(scene, i, j, [=](Refiner& refiner) { refiner.add_pieces(points, false); });
}

LambertSum lambert_refined(const urad_scene& scene, const Patch& i, const Patch& j,
                           int32_t log2_doubt_q24) noexcept {
  return summed(scene, i, j, [=](Refiner& refiner) {
    refiner.add_pieces(kRefinedPoints, true);
    refiner.refine(log2_doubt_q24);
  });
}

}  // namespace urad
