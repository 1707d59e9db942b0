#include "urad/lambert.hpp"

#include "lambert_piece.hpp"
#include "lambert_point.hpp"
#include "lambert_vector.hpp"
#include "urad/clip.hpp"

namespace urad {

namespace {

constexpr int kDeepest = 6;   // halvings of a side of a piece
constexpr int kHalvings = 8;  // of both together
constexpr int kMostCells = 2 * kHalvings + 2;

constexpr int32_t q24(double x) { return int32_t(x * 16777216.0); }
/// A cell whose long side is 1 is halved when its middle is nearer than this to
///   an edge in the carrier's plane   0.45, which leaves a square alone that stands on that edge
///   any other edge                   0.60, which does so too if the angle between the two is above
///   45 degrees a vertex                         0.65, which leaves a square alone whose corner it
///   is
/// Logarithms of the squares.
constexpr int32_t kPlaneReach_q24 = q24(-2.304006), kEdgeReach_q24 = q24(-1.473931),
                  kVertexReach_q24 = q24(-1.242977);
/// Edges lower than 2^-12 of the cell's long side count as in its plane.
constexpr int32_t kLow_q24 = q24(-24.0);
/// Sides whose squares differ by less than this factor 2 are both halved.
constexpr int32_t kSquare_q24 = q24(1.0);

/// Signed area that a and b span about the normal: value 2^exponent, |value| < 2^31.
struct Span {
  int64_t value;
  int exponent;
};
Span span_of(const urad_point& a, const urad_point& b, const urad_point& normal_q30) noexcept {
  const LongVector c = cross(a, b);
  return {round_shift(dot(normal_q30, c.direction), 30), c.exponent};
}

int64_t brought_to(const Span& span, int exponent) noexcept {
  const int down = exponent - span.exponent;
  return down == 0 ? span.value : down > 32 ? 0 : round_shift(span.value, down);
}

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
    if (!near(middle, longer_u ? size_u_q24 : size_v_q24)) *halve_u = *halve_v = false;
  }

  static int32_t longer(const urad_point& a, const urad_point& b) noexcept {
    const uint64_t a2 = square(a), b2 = square(b);
    return log2_q24(a2 > b2 ? a2 : b2);
  }

  int64_t height2(const urad_point& v) const noexcept {
    const int64_t h = round_shift(dot(normal_q30_, v), 30);
    return h * h;
  }

  bool near(const urad_point& x, int32_t log2_size2_q24) const noexcept {
    bool found = false;
    receiver_.for_each_edge([&](const urad_point& from, const urad_point& to) {
      if (found) return;
      const urad_point a = from - x, b = to - x, edge = to - from;
      const int32_t log2_a2_q24 = log2_q24(square(a));
      found = log2_a2_q24 < log2_size2_q24 + kVertexReach_q24;
      if (dot(a, edge) >= 0 || dot(b, edge) <= 0) return;  // an end is nearest
      const int32_t log2_height2_q24 = log2_square_q24(cross(a, edge)) - log2_q24(square(edge));
      const int32_t low_q24 = log2_size2_q24 + kLow_q24;
      const bool low =
          log2_q24(uint64_t(height2(from))) < low_q24 && log2_q24(uint64_t(height2(to))) < low_q24;
      const int32_t reach_q24 = low ? kPlaneReach_q24 : kEdgeReach_q24;
      found = found || log2_height2_q24 < log2_size2_q24 + reach_q24;
    });
    return found;
  }

  const Outline& receiver_;
  urad_point normal_q30_;
  int points_;
  int64_t exchange_ = 0, area_ = 0;
};

/// The mean of the vertices: a convex combination, so it stays where the cut left them.
urad_point middle_of(const Outline& outline) noexcept {
  int64_t sum[3] = {0, 0, 0};
  outline.for_each_vertex(
      [&](const urad_point& v) { sum[0] += v.x, sum[1] += v.y, sum[2] += v.z; });
  const auto mean = [&](int64_t x) {
    return int32_t(round_shift(ratio_q(x, outline.count(), 1), 1));
  };
  return {mean(sum[0]), mean(sum[1]), mean(sum[2])};
}

/// True when the outline is a convex quadrilateral, which is then one piece.
bool whole_piece(const Outline& outline, const urad_point& normal_q30, Piece* piece) noexcept {
  if (outline.count() != 4) return false;
  int count = 0;
  outline.for_each_vertex([&](const urad_point& v) { piece->corner[count++] = v; });
  Span span[4];
  piece->exponent = -64;
  for (int k = 0; k < 4; ++k) {
    const urad_point& at = piece->corner[k];
    span[k] = span_of(piece->corner[(k + 1) & 3] - at, piece->corner[(k + 3) & 3] - at, normal_q30);
    if (span[k].value <= 0) return false;
    if (span[k].exponent > piece->exponent) piece->exponent = span[k].exponent;
  }
  for (int k = 0; k < 4; ++k) piece->span[k] = brought_to(span[k], piece->exponent);
  return true;
}

/// Adds all of the carrier. Returns the exponent of the spans.
int add_all(const Outline& carrier, const urad_point& normal_q30, Sum* sum) noexcept {
  Piece piece;
  if (whole_piece(carrier, normal_q30, &piece)) {
    sum->add(piece);
    return piece.exponent;
  }
  const urad_point middle = middle_of(carrier);
  piece.exponent = -64;
  carrier.for_each_edge([&](const urad_point& a, const urad_point& b) {
    const Span span = span_of(a - middle, b - middle, normal_q30);
    if (span.value != 0 && span.exponent > piece.exponent) piece.exponent = span.exponent;
  });
  carrier.for_each_edge([&](const urad_point& a, const urad_point& b) {
    const Span span = span_of(a - middle, b - middle, normal_q30);
    const int64_t value = brought_to(span, piece.exponent);
    if (value == 0) return;
    piece.corner[0] = piece.corner[3] = middle;
    piece.corner[1] = a, piece.corner[2] = b;
    piece.span[0] = piece.span[3] = 0;
    piece.span[1] = piece.span[2] = value;
    sum->add(piece);
  });
  return piece.exponent;
}

/// Height of a's centroid above b's plane, times 2^30.
int64_t height(const Patch& a, const Patch& b) noexcept {
  return dot(b.shape->normal_q30, a.centroid - b.centroid);
}

bool carries(const Patch& i, const Patch& j) noexcept {
  const urad_shape &a = *i.shape, &b = *j.shape;
  if (a.log2_spread_q24 != b.log2_spread_q24) return a.log2_spread_q24 < b.log2_spread_q24;
  if (a.log2_area_q24 != b.log2_area_q24) return a.log2_area_q24 < b.log2_area_q24;
  const int64_t up_i = height(i, j), up_j = height(j, i);
  if (up_i != up_j) return up_i < up_j;
  return i.index < j.index;
}

}  // namespace

int32_t lambert_exchange_log2_q24(const urad_scene& scene, const Patch& i, const Patch& j,
                                  int points) noexcept {
  const bool first = carries(i, j);
  const Patch &carrier = first ? i : j, &receiver = first ? j : i;
  const urad_point &n = carrier.shape->normal_q30, &m = receiver.shape->normal_q30;
  const Side carrier_side = side_of_plane(scene, carrier, receiver.centroid, m);
  const Side receiver_side = side_of_plane(scene, receiver, carrier.centroid, n);
  if (carrier_side == Side::behind || receiver_side == Side::behind) return kNoExchange;

  const int shift_carrier = frame_shift(scene, carrier, carrier.centroid);
  const int shift_receiver = frame_shift(scene, receiver, carrier.centroid);
  const Frame frame{carrier.centroid,
                    shift_carrier < shift_receiver ? shift_carrier : shift_receiver};
  const Plane carrier_plane{n, {0, 0, 0}}, receiver_plane{m, frame.place(receiver.centroid)};
  const bool cut = carrier_side == Side::both;
  const Outline from(scene, carrier, frame, cut ? &receiver_plane : nullptr);
  const Outline to(scene, receiver, frame, receiver_side == Side::both ? &carrier_plane : nullptr);

  Sum sum(to, n, points);
  const int exponent = add_all(from, n, &sum);
  if (sum.exchange() <= 0 || sum.area() <= 0) return kNoExchange;
  const int32_t log2_sum_q24 = log2_q24(uint64_t(sum.exchange())) - (22 << 24);
  // The exporter knows the area of a whole patch better than its rounded vertices do.
  int32_t log2_g_q24 =
      cut ? log2_sum_q24 + (exponent - 2 * frame.up) * (1 << 24)
          : log2_sum_q24 - log2_q24(uint64_t(sum.area())) + carrier.shape->log2_area_q24;
  const auto limit = [&](int32_t most_q24) {
    if (log2_g_q24 > most_q24) log2_g_q24 = most_q24;
  };
  limit(carrier.shape->log2_area_q24);
  limit(receiver.shape->log2_area_q24);
  return log2_g_q24;
}

}  // namespace urad
