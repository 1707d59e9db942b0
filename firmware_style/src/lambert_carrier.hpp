// lambert_carrier.hpp -- which of two patches carries the points, the frame of the pair, and the
// pieces that the carrier is cut into.
#pragma once
#include "lambert_piece.hpp"
#include "lambert_point.hpp"
#include "lambert_vector.hpp"
#include "urad/clip.hpp"
#include "urad/form_factor.hpp"

namespace urad {

/// Signed area that a and b span about the normal: value 2^exponent, |value| < 2^31.
struct Span {
  int64_t value;
  int exponent;
};
inline Span span_of(const urad_point& a, const urad_point& b,
                    const urad_point& normal_q30) noexcept {
  const LongVector c = cross(a, b);
  return {round_shift(dot(normal_q30, c.direction), 30), c.exponent};
}

/// exponent: of the largest span; that of a span of 0 may be anything.
inline int64_t brought_to(const Span& span, int exponent) noexcept {
  const int down = exponent - span.exponent;
  if (span.value == 0 || down > 32) return 0;
  return down == 0 ? span.value : round_shift(span.value, down);
}

/// The mean of the vertices: a convex combination, so it stays where the cut left them.
inline urad_point middle_of(const Outline& outline) noexcept {
  int64_t sum[3] = {0, 0, 0};
  outline.for_each_vertex(
      [&](const urad_point& v) { sum[0] += v.x, sum[1] += v.y, sum[2] += v.z; });
  const auto mean = [&](int64_t x) {
    return int32_t(round_shift(ratio_q(x, outline.count(), 1), 1));
  };
  return {mean(sum[0]), mean(sum[1]), mean(sum[2])};
}

/// True when the outline is a convex quadrilateral, which is then one piece.
inline bool whole_piece(const Outline& outline, const urad_point& normal_q30,
                        Piece* piece) noexcept {
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

/// The pieces of a carrier: a whole convex quadrilateral, or a fan of triangles about the mean of
/// its vertices.
class Pieces {
 public:
  Pieces(const Outline& carrier, const urad_point& normal_q30) noexcept
      : carrier_(carrier), normal_q30_(normal_q30) {
    whole_ = whole_piece(carrier, normal_q30, &quad_);
    if (whole_) return;
    middle_ = middle_of(carrier);
    quad_.exponent = -64;
    carrier.for_each_edge([&](const urad_point& a, const urad_point& b) {
      const Span span = span_of(a - middle_, b - middle_, normal_q30_);
      if (span.value != 0 && span.exponent > quad_.exponent) quad_.exponent = span.exponent;
    });
  }

  /// Of the spans of all pieces.
  int exponent() const noexcept { return quad_.exponent; }

  /// visit(number, piece) for every piece that has an area.
  template <class Visit>
  void for_each(Visit visit) const noexcept {
    if (whole_) return visit(0, quad_);
    int number = 0;
    carrier_.for_each_edge([&](const urad_point& a, const urad_point& b) {
      const int64_t value = brought_to(span_of(a - middle_, b - middle_, normal_q30_), exponent());
      if (value != 0) visit(number, triangle(a, b, value));
      ++number;
    });
  }

 private:
  Piece triangle(const urad_point& a, const urad_point& b, int64_t span) const noexcept {
    return {{middle_, a, b, middle_}, {0, span, span, 0}, exponent()};
  }

  const Outline& carrier_;
  urad_point normal_q30_, middle_{0, 0, 0};
  Piece quad_;
  bool whole_;
};

/// Height of a's centroid above b's plane, times 2^30.
inline int64_t height(const Patch& a, const Patch& b) noexcept {
  return dot(b.shape->normal_q30, a.centroid - b.centroid);
}

inline bool carries(const Patch& i, const Patch& j) noexcept {
  const urad_shape &a = *i.shape, &b = *j.shape;
  if (a.log2_spread_q24 != b.log2_spread_q24) return a.log2_spread_q24 < b.log2_spread_q24;
  if (a.log2_area_q24 != b.log2_area_q24) return a.log2_area_q24 < b.log2_area_q24;
  const int64_t up_i = height(i, j), up_j = height(j, i);
  if (up_i != up_j) return up_i < up_j;
  return i.index < j.index;
}

/// Two patches made ready for the sum.
struct LambertPair {
  const Patch *carrier, *receiver;
  Frame frame;
  Plane carrier_plane, receiver_plane;
  bool cut_carrier, cut_receiver;

  Outline from(const urad_scene& scene) const noexcept {
    return {scene, *carrier, frame, cut_carrier ? &receiver_plane : nullptr};
  }
  Outline to(const urad_scene& scene) const noexcept {
    return {scene, *receiver, frame, cut_receiver ? &carrier_plane : nullptr};
  }

  /// log2 G of sum = integral of area times factor (2^-22 of a span) and the area under it.
  int32_t log2_exchange_q24(int64_t sum, int64_t area, int exponent) const noexcept {
    if (sum <= 0 || area <= 0) return kNoExchange;
    const int32_t log2_sum_q24 = log2_q24(uint64_t(sum)) - (22 << 24);
    // The exporter knows the area of a whole patch better than its rounded vertices do.
    int32_t log2_g_q24 =
        cut_carrier ? log2_sum_q24 + (exponent - 2 * frame.up) * (1 << 24)
                    : log2_sum_q24 - log2_q24(uint64_t(area)) + carrier->shape->log2_area_q24;
    const int32_t a_q24 = carrier->shape->log2_area_q24, b_q24 = receiver->shape->log2_area_q24;
    if (log2_g_q24 > a_q24) log2_g_q24 = a_q24;
    if (log2_g_q24 > b_q24) log2_g_q24 = b_q24;
    return log2_g_q24;
  }
};

/// False when one of the two lies wholly behind the other.
inline bool lambert_pair(const urad_scene& scene, const Patch& i, const Patch& j,
                         LambertPair* pair) noexcept {
  const bool first = carries(i, j);
  const Patch &carrier = first ? i : j, &receiver = first ? j : i;
  const urad_point &n = carrier.shape->normal_q30, &m = receiver.shape->normal_q30;
  const Side carrier_side = side_of_plane(scene, carrier, receiver.centroid, m);
  const Side receiver_side = side_of_plane(scene, receiver, carrier.centroid, n);
  if (carrier_side == Side::behind || receiver_side == Side::behind) return false;
  const int shift_carrier = frame_shift(scene, carrier, carrier.centroid);
  const int shift_receiver = frame_shift(scene, receiver, carrier.centroid);
  pair->carrier = &carrier;
  pair->receiver = &receiver;
  pair->frame = {carrier.centroid, shift_carrier < shift_receiver ? shift_carrier : shift_receiver};
  pair->carrier_plane = {n, {0, 0, 0}};
  pair->receiver_plane = {m, pair->frame.place(receiver.centroid)};
  pair->cut_carrier = carrier_side == Side::both;
  pair->cut_receiver = receiver_side == Side::both;
  return true;
}

}  // namespace urad
