// lambert_near.hpp -- whether the outline of a polygon comes so near to a cell that the factor
// bends within it.
#pragma once
#include "lambert_outline.hpp"
#include "lambert_vector.hpp"

namespace urad {

constexpr int32_t log2_square_of(double log2) { return int32_t(log2 * 16777216.0); }
/// A cell whose long side is 1 is halved when its middle is nearer than this to
///   an edge in the carrier's plane   0.45, which leaves a square alone that stands on that edge
///   any other edge                   0.60, which does so too if the angle between the two is above
///   45 degrees a vertex                         0.65, which leaves a square alone whose corner it
///   is
/// Logarithms of the squares.
inline constexpr int32_t kPlaneReach_q24 = log2_square_of(-2.304006),
                         kEdgeReach_q24 = log2_square_of(-1.473931),
                         kVertexReach_q24 = log2_square_of(-1.242977);
/// Edges lower than 2^-12 of the cell's long side count as in its plane.
inline constexpr int32_t kLow_q24 = log2_square_of(-24.0);
inline bool near_edge(const Outline& receiver, const urad_point& normal_q30, const urad_point& x,
                      int32_t log2_size2_q24) noexcept {
  const auto height2 = [&](const urad_point& v) {
    const int64_t h = round_shift(dot(normal_q30, v), 30);
    return h * h;
  };
  bool found = false;
  receiver.for_each_edge([&](const urad_point& from, const urad_point& to) {
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

}  // namespace urad
