// Scan conversion without clipping and without dividing by a depth that may be zero or negative.
//
// On a face with axes (s, t, w) the ray through column s of row T meets the line of an edge a-b
// where E . (s, T, 1) = 0, E = a x b [Olano & Greer 1997]. The edge crosses the plane of row T
// between a and b when h = v.t - T v.w differs in sign at its ends; the point of crossing is b h(a)
// - a h(b), so its depth w has the sign of E.s h(a). Crossings in front of the eye toggle the cells
// to their right. Crossings behind it lie beyond one end of the row: which end, the polygon's plane
// says. Both decisions depend on shared vertices and on E(b, a) = -E(a, b) alone: neighbours leave
// no gap.
#include "hemicube_raster.hpp"
#include "urad/ratio.hpp"
#include "urad/vec.hpp"

namespace urad::raster {

namespace {

/// The rows on which a vertex is above, h > 0: those before `row` or, when it is behind the eye,
/// from it on.
struct Threshold {
  int row;
  bool from_row_on;
};

/// row = number of rows whose T = (2k+1-R)/R is below v.t / v.w.
Threshold threshold(const urad_point& v, int resolution) noexcept {
  if (v.z == 0) return {v.y > 0 ? resolution : 0, false};
  const bool behind_eye = v.z < 0;
  if (magnitude(v.y) >= magnitude(v.z))
    return {(v.y < 0) == behind_eye ? resolution : 0, behind_eye};
  const int64_t height_q30 = ratio_q(behind_eye ? -int64_t{v.y} : v.y, int64_t(magnitude(v.z)), 30);
  const int64_t twice_row_q30 =
      wide_mul(int32_t(height_q30), resolution) + (int64_t{resolution - 1} << 30);
  return {int(shift_down(twice_row_q30 + 0x7FFFFFFF, 31)), behind_eye};
}

/// Columns left of the line of an edge, by row: u(k) = middle + (k - R/2) step, cells, 24 fraction
/// bits.
struct Line {
  int64_t middle_q24, step_q24;
};

/// E with its greatest component below 2^31; s keeps its sign even when it vanishes by rounding.
struct Normal {
  int64_t s, t, w;
};

Normal edge_normal(const urad_point& a, const urad_point& b) noexcept {
  const auto minor = [](int32_t p, int32_t q, int32_t r, int32_t s) {
    return wide_mul(p, q) - wide_mul(r, s);
  };
  const Normal e{minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
  const int excess = top_bit(magnitude(e.s) | magnitude(e.t) | magnitude(e.w)) - 30;
  if (excess <= 0) return e;
  const int64_t s = round_shift(e.s, excess);
  return {s != 0    ? s
          : e.s > 0 ? 1
          : e.s < 0 ? -1
                    : 0,
          round_shift(e.t, excess), round_shift(e.w, excess)};
}

/// s = -(E.t T + E.w) / E.s as a column, u = (s R + R - 1) / 2. e.s != 0. |numerators| < 2^39.
Line line_of(const Normal& e, int resolution) noexcept {
  const auto by_minus_s = [&](int64_t x, int fraction_bits) {
    return ratio_q(e.s < 0 ? x : -x, int64_t(magnitude(e.s)), fraction_bits);
  };
  const int64_t step_q24 = by_minus_s(e.t, 24);
  const int64_t middle_q24 = by_minus_s(e.t + e.w * resolution, 23);
  return {middle_q24 + (int64_t{resolution - 1} << 23), step_q24};
}

int column_of(int64_t u_q24, int resolution) noexcept {
  if (u_q24 <= 0) return 0;
  const int64_t column = shift_down(u_q24 + 0xFFFFFF, 24);
  return column < resolution ? int(column) : resolution;
}

void toggle(uint32_t* mask, int words, int column) noexcept {
  for (int k = 0; k < words; ++k, column -= 32) {
    if (column < 32) mask[k] ^= column <= 0 ? 0xFFFFFFFFu : 0xFFFFFFFFu << column;
  }
}

/// One polygon on one band.
struct Scan {
  const Band& band;
  int resolution, words;
  uint32_t* mask;
  int far_column;  // where crossings behind the eye go: 0 or R
  int first_row;   // of the band and above the horizon
  Band touched;

  void rows(int first, int end, bool in_front, const Line& line) noexcept {
    first = first < first_row ? first_row : first;
    end = end > band.end ? band.end : end;
    if (first >= end) return;
    touched.first = first < touched.first ? first : touched.first;
    touched.end = end > touched.end ? end : touched.end;
    int64_t u_q24 = line.middle_q24 + line.step_q24 * (first - (resolution >> 1));
    for (int row = first; row < end; ++row, u_q24 += line.step_q24) {
      const int column = in_front ? column_of(u_q24, resolution) : far_column;
      toggle(mask + (row - band.first) * words, words, column);
    }
  }

  void edge(const urad_point& a, const Threshold& ta, const urad_point& b,
            const Threshold& tb) noexcept {
    const int low = ta.row < tb.row ? ta.row : tb.row, high = ta.row < tb.row ? tb.row : ta.row;
    const bool same_kind = ta.from_row_on == tb.from_row_on;
    if (same_kind && (low == high || high <= first_row || low >= band.end)) return;
    const Normal e = edge_normal(a, b);
    const Line line = e.s != 0 ? line_of(e, resolution) : Line{0, 0};
    const auto in_front = [&](bool a_above) { return a_above ? e.s > 0 : e.s < 0; };
    if (same_kind) return rows(low, high, in_front((ta.row > tb.row) != ta.from_row_on), line);
    // Below both thresholds one end is above, beyond both the other.
    rows(0, low, in_front(!ta.from_row_on), line);
    rows(high, resolution, in_front(ta.from_row_on), line);
  }
};

}  // namespace

urad_point to_face(int face, const urad_point& x) noexcept {
  if (face == 0) return x;
  if (face == 1) return {x.y, x.z, x.x};
  if (face == 2) return {-x.y, x.z, -x.x};
  if (face == 3) return {-x.x, x.z, x.y};
  return {x.x, x.z, -x.y};
}

unsigned outside(int face, const urad_point& v) noexcept {
  unsigned bits = 0;
  if (v.x > v.z) bits |= right;
  if (-v.x > v.z) bits |= left;
  if (v.y > v.z) bits |= above;
  if (face == 0 ? -v.y > v.z : v.y <= 0) bits |= below;
  if (v.z <= 0) bits |= behind;
  return bits;
}

Band scan(const View& view, const Band& band, int resolution, int words, uint32_t* mask) noexcept {
  // Along a row the polygon's plane comes to depth 0 at s w = offset / normal.s.
  const int32_t across = to_face(band.face, view.normal_q30).x;
  const bool leftward = (across < 0) != (view.offset_q30 < 0);
  const int horizon = band.face == 0 ? 0 : resolution >> 1;
  Scan pass{band,
            resolution,
            words,
            mask,
            across != 0 && leftward ? 0 : resolution,
            band.first > horizon ? band.first : horizon,
            {band.face, band.end, band.first}};
  urad_point a = to_face(band.face, view.corner[view.corners - 1]);
  Threshold ta = threshold(a, resolution);
  for (uint16_t k = 0; k < view.corners; ++k) {
    const urad_point b = to_face(band.face, view.corner[k]);
    const Threshold tb = threshold(b, resolution);
    pass.edge(a, ta, b, tb);
    a = b;
    ta = tb;
  }
  return pass.touched;
}

}  // namespace urad::raster
