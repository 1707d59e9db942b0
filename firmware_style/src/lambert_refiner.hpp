// lambert_refiner.hpp -- the exact sum over cells of the carrier that are halved one after the
// other, the most doubtful first.
#pragma once
#include "lambert_carrier.hpp"
#include "lambert_cell.hpp"
#include "lambert_near.hpp"
#include "urad/lambert.hpp"

namespace urad {

class Refiner {
 public:
  Refiner(const Pieces& pieces, const Outline& receiver, const urad_point& normal_q30) noexcept
      : pieces_(pieces), receiver_(receiver), normal_q30_(normal_q30) {}

  /// Every piece as one cell.
  void add_pieces(int points) noexcept {
    pieces_.for_each([&](int number, const Piece& piece) {
      area_ += mean_span(piece);
      DoubtfulCell cell{0, 0, 0, 0, 0, 0, 0, 0, 0, uint8_t(number), false, false, false};
      measure(piece, points, &cell);
      keep(cell);
    });
    older_ = newer_ = value_;
    next_mark_ = 2 * leaves_;
  }

  /// Halves the most doubtful cell. False when there is none, or enough have been measured.
  bool halve_worst() noexcept {
    if (cells_ >= kMostRefinedCells || count_ == 0) return false;
    const DoubtfulCell parent = take_worst();
    pieces_.for_each([&](int number, const Piece& piece) {
      if (number == parent.piece) halve(piece, parent);
    });
    if (leaves_ >= next_mark_) {
      older_ = newer_;
      newer_ = value_;
      next_mark_ *= 2;
    }
    return true;
  }

  int64_t value() const noexcept { return value_; }
  int64_t area() const noexcept { return area_; }
  int point_sums() const noexcept { return point_sums_; }
  /// log2 (Q7.8) of what dark cells may hold, by the sum: a corner of each between points and edge.
  int16_t dark_q8() const noexcept {
    return share_q8(uint64_t(dark_) << (kNearDoubt - kDarkShare), log2_q24(magnitude(value_)));
  }
  /// log2 (Q7.8) of what the sum knows of itself, by the sum.
  void fill_traits(int16_t* log2_trait_q8) const noexcept {
    const int32_t log2_value_q24 = log2_q24(magnitude(value_));
    const auto by_value = [=](uint64_t x) { return share_q8(x, log2_value_q24); };
    int64_t worst = 0;
    for (int k = 0; k < count_; ++k)
      if (pending_[k].doubt > worst) worst = pending_[k].doubt;
    log2_trait_q8[sum_slope] = by_value(magnitude(slope_));
    log2_trait_q8[sum_worst] = by_value(magnitude(worst));
    log2_trait_q8[sum_moved] = by_value(magnitude(value_ - older_));
    log2_trait_q8[sum_bend] = by_value(magnitude(bend_));
    log2_trait_q8[sum_doubt] = by_value(magnitude(doubt_));
    log2_trait_q8[sum_change] = by_value(magnitude(change_));
    log2_trait_q8[sum_changes] = by_value(changes_);
    log2_trait_q8[sum_near] = by_value(near_);
    log2_trait_q8[sum_cells] = int16_t(round_shift(log2_q24(uint32_t(leaves_)), 16));
  }

 private:
  static constexpr int kPending =
      24;  // cells that may still be halved; the least doubtful drop out

  static int16_t share_q8(uint64_t x, int32_t log2_whole_q24) noexcept {
    const int32_t q8 = round_shift(log2_q24(x | 1) - log2_whole_q24, 16);
    return int16_t(q8 > kTraitLimit_q8    ? kTraitLimit_q8
                   : q8 < -kTraitLimit_q8 ? -kTraitLimit_q8
                                          : q8);
  }

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
      measure(piece, kRefinedPoints, &half[k]);
    }
    const int64_t change = parent.value - half[0].value - half[1].value;
    const int64_t doubt = int64_t(magnitude(change)) >> kParentDoubt;
    for (DoubtfulCell& cell : half) {
      cell.change = shift_down(change, 1);
      if (cell.doubt < doubt) cell.doubt = doubt;
      keep(cell);
    }
  }

  /// times: 1, or -1 for a cell that is no more.
  void count_in(const DoubtfulCell& cell, int times) noexcept {
    value_ += times * cell.value;
    doubt_ += times * cell.doubt;
    slope_ += times * cell.slope;
    bend_ += times * cell.bend;
    change_ += times * cell.change;
    changes_ += uint64_t(times * int64_t(magnitude(cell.change)));
    if (cell.dark) dark_ += times * cell.doubt;
    if (cell.near) near_ += uint64_t(times * int64_t(magnitude(cell.value)));
    leaves_ += times;
  }

  void keep(const DoubtfulCell& cell) noexcept {
    count_in(cell, 1);
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
    count_in(cell, -1);
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
  void measure(const Piece& piece, int points, DoubtfulCell* cell) noexcept {
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
        if (factor_uq30 > brightest_uq30_) brightest_uq30_ = factor_uq30;
      }
    }
    const int level = cell->level_u + cell->level_v;
    const uint64_t bend_u = along_u_variation.bend(magnitude(sum));
    const uint64_t bend_v = along_v_variation.bend(magnitude(sum));
    const uint64_t bend = bend_u + bend_v;
    cell->value = level ? round_shift(sum, level) : sum;
    cell->along_u = bend_u >= bend_v;
    cell->slope = int64_t((along_u_variation.slope() + along_v_variation.slope()) >> level);
    cell->bend = int64_t(bend >> level);
    uint64_t doubt = orders_later(bend, magnitude(sum));
    if (points == kRefinedPoints) {
      cell->near = is_near(piece, cell);
      cell->dark = false;
      if (cell->near) {
        // Points that all lie beside a near edge do not tell what the cell holds.
        const uint64_t open = magnitude(round_shift(whole * int64_t{brightest_uq30_}, 8));
        cell->dark = uint64_t(most) < open >> kDark;
        if (cell->dark) most = int64_t(open);
        doubt = larger(doubt, uint64_t(most) >> kNearDoubt);
      }
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
  int64_t value_ = 0, doubt_ = 0, slope_ = 0, bend_ = 0, change_ = 0, area_ = 0, dark_ = 0;
  int64_t older_ = 0, newer_ = 0;  ///< the sum at earlier powers of two of cells
  uint64_t changes_ = 0, near_ = 0;
  uint32_t brightest_uq30_ = 0;  ///< greatest factor at any point
  int cells_ = 0, leaves_ = 0, next_mark_ = 0, count_ = 0, point_sums_ = 0;
  DoubtfulCell pending_[kPending];
};

/// The sum of a pair under way: whole pieces first, then as many halvings as are asked for.
class LambertRun {
 public:
  LambertRun(const urad_scene& scene, const LambertPair& pair, int points) noexcept
      : pair_(pair),
        from_(pair.from(scene)),
        to_(pair.to(scene)),
        pieces_(from_, pair.carrier->shape->normal_q30),
        refiner_(pieces_, to_, pair.carrier->shape->normal_q30) {
    refiner_.add_pieces(points);
  }
  LambertRun(const LambertRun&) = delete;
  LambertRun& operator=(const LambertRun&) = delete;

  bool halve_worst() noexcept { return refiner_.halve_worst(); }

  LambertSum sum() const noexcept {
    LambertSum sum;
    sum.log2_exchange_q24 =
        pair_.log2_exchange_q24(refiner_.value(), refiner_.area(), pieces_.exponent());
    sum.point_sums = uint16_t(refiner_.point_sums());
    sum.log2_dark_q8 = refiner_.dark_q8();
    refiner_.fill_traits(sum.log2_trait_q8);
    return sum;
  }

 private:
  const LambertPair& pair_;
  const Outline from_, to_;
  const Pieces pieces_;
  Refiner refiner_;
};

}  // namespace urad
