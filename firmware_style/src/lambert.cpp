#include "urad/lambert.hpp"

#include "lambert_carrier.hpp"
#include "lambert_near.hpp"

namespace urad {

namespace {

constexpr int kDeepest = 6;   // halvings of a side of a piece
constexpr int kHalvings = 8;  // of both together
constexpr int kMostCells = 2 * kHalvings + 2;

/// Sides whose squares differ by less than this factor 2 are both halved.
constexpr int32_t kSquare_q24 = 1 << 24;

class Sum {
 public:
  Sum(const Outline& receiver, const urad_point& normal_q30, int points) noexcept
      : receiver_(receiver), normal_q30_(normal_q30), points_(points) {}

  /// All cells of a piece, by a short stack.
  void add(const Piece& piece) noexcept {
    Cell stack[kMostCells];
    stack[0] = {0, 0, 0, 0};
    for (int count = 1; count > 0;) {
      const Cell cell = stack[--count];
      bool halve_u, halve_v;
      halves(piece, cell, &halve_u, &halve_v);
      if (!halve_u && !halve_v) {
        add_points(piece, cell);
        continue;
      }
      for (int part = 0; part < (halve_u ? 2 : 1) * (halve_v ? 2 : 1); ++part) {
        const int in_u = halve_u ? part & 1 : 0, in_v = halve_u ? part >> 1 : part;
        stack[count++] = {uint8_t(halve_u ? 2 * cell.place_u + in_u : cell.place_u),
                          uint8_t(halve_v ? 2 * cell.place_v + in_v : cell.place_v),
                          uint8_t(cell.level_u + halve_u), uint8_t(cell.level_v + halve_v)};
      }
    }
  }

  /// sum of area times factor, 2^-22 of a span; sum of area.
  int64_t exchange() const noexcept { return exchange_; }
  int64_t area() const noexcept { return area_; }
  /// Points so far.
  uint32_t count() const noexcept { return count_; }

 private:
  void add_points(const Piece& piece, const Cell& cell) noexcept {
    for (int a = 0; a < points_; ++a) {
      const GaussPoint u = gauss_point(points_, a);
      for (int b = 0; b < points_; ++b) {
        const GaussPoint v = gauss_point(points_, b);
        const int32_t u_q30 = cell.u_q30(u.at_q30), v_q30 = cell.v_q30(v.at_q30);
        const int64_t weight =
            round_shift(span_at(piece, u_q30, v_q30) * int64_t(u.weight_uq15 * v.weight_uq15),
                        30 + cell.level_u + cell.level_v);
        const urad_point x = point_of(piece, u_q30, v_q30);
        exchange_ += round_shift(weight * lambert_sum_uq30(x, normal_q30_, receiver_), 8);
        area_ += weight;
        ++count_;
      }
    }
  }

  /// Which sides of a cell to halve.
  void halves(const Piece& piece, const Cell& cell, bool* halve_u, bool* halve_v) const noexcept {
    constexpr int32_t one = 1 << 30, half = 1 << 29;
    const urad_point corner[4] = {point_of(piece, cell.u_q30(0), cell.v_q30(0)),
                                  point_of(piece, cell.u_q30(one), cell.v_q30(0)),
                                  point_of(piece, cell.u_q30(one), cell.v_q30(one)),
                                  point_of(piece, cell.u_q30(0), cell.v_q30(one))};
    const int32_t size_u_q24 = longer(corner[1] - corner[0], corner[2] - corner[3]);
    const int32_t size_v_q24 = longer(corner[3] - corner[0], corner[2] - corner[1]);
    const bool longer_u = size_u_q24 >= size_v_q24;
    const bool more = cell.level_u + cell.level_v < kHalvings;
    *halve_u =
        (longer_u || size_v_q24 - size_u_q24 < kSquare_q24) && more && cell.level_u < kDeepest;
    *halve_v =
        (!longer_u || size_u_q24 - size_v_q24 < kSquare_q24) && more && cell.level_v < kDeepest;
    if (!*halve_u && !*halve_v) return;
    const urad_point middle = point_of(piece, cell.u_q30(half), cell.v_q30(half));
    if (!near_edge(receiver_, normal_q30_, middle, longer_u ? size_u_q24 : size_v_q24))
      *halve_u = *halve_v = false;
  }

  static int32_t longer(const urad_point& a, const urad_point& b) noexcept {
    const uint64_t a2 = square(a), b2 = square(b);
    return log2_q24(a2 > b2 ? a2 : b2);
  }

  const Outline& receiver_;
  urad_point normal_q30_;
  int points_;
  int64_t exchange_ = 0, area_ = 0;
  uint32_t count_ = 0;
};

}  // namespace

int32_t lambert_exchange_log2_q24(const urad_scene& scene, const Patch& i, const Patch& j,
                                  int points, uint32_t* sums) noexcept {
  LambertPair pair;
  if (!lambert_pair(scene, i, j, &pair)) return kNoExchange;
  const urad_point& n = pair.carrier->shape->normal_q30;
  const Outline from = pair.from(scene), to = pair.to(scene);
  const Pieces pieces(from, n);
  Sum sum(to, n, points);
  pieces.for_each([&](int, const Piece& piece) { sum.add(piece); });
  if (sums) *sums += sum.count();
  return pair.log2_exchange_q24(sum.exchange(), sum.area(), pieces.exponent());
}

}  // namespace urad
