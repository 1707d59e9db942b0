// Cells: nearest polygon per cell, and the sums of delta form factors.
#include "hemicube_raster.hpp"
#include "urad/ratio.hpp"

namespace urad::raster {

namespace {

/// Codes closer than this, 2^-24 of the distance, are one plane: the polygon drawn first keeps the
/// cell, but for dark sides, which give way to the lit side of the same sheet.
constexpr uint32_t kTie = 4;

/// 1/w over a face is affine: normal . (s, t, 1) / offset. Here times R 2^56, less the exponent of
/// the offset.
struct Depth {
  int64_t per_column, per_row, corner;  // at column c and row r: corner + c per_column + r per_row
  int exponent;
};

/// Width: |normal . (s, t, 1)| R <= sqrt 3 2^30 128 and the mantissa <= 2^25, so every value on the
/// face is below 2^63.
Depth depth_of(const View& view, int face, int resolution) noexcept {
  const urad_point n = to_face(face, view.normal_q30);
  const Scaled offset = scaled(magnitude(view.offset_q30));
  const int64_t inverse =
      int64_t(inverse_uq62(offset.mantissa) >> 6) * (view.offset_q30 < 0 ? -1 : 1);
  const int64_t corner = wide_mul(n.z, resolution) - (int64_t{n.x} + n.y) * (resolution - 1);
  return {int64_t{n.x} * 2 * inverse, int64_t{n.y} * 2 * inverse, corner * inverse,
          offset.exponent};
}

/// Six bits of exponent, 26 of mantissa: monotone in 1/w, the same relative precision at every
/// distance; never 0.
uint32_t code(int64_t value, int exponent) noexcept {
  if (value <= 0) return 1;
  const int n = top_bit(uint64_t(value)), e = n - exponent - 8;
  if (e < 0) return 1;
  const uint64_t below_top = n > 26 ? uint64_t(value) >> (n - 26) : uint64_t(value) << (26 - n);
  return uint32_t(e > 63 ? 63 : e) << 26 | (uint32_t(below_top) & 0x3FFFFFFu);
}

}  // namespace

uint32_t paint(const HemicubeSource& source, const View& view, const Band& band,
               const Band& touched) noexcept {
  const int resolution = source.table.resolution, half = resolution >> 1,
            words = (resolution + 31) >> 5;
  const bool buffered = source.rows != 0;
  const Depth depth = buffered ? depth_of(view, band.face, resolution) : Depth{0, 0, 0, 0};
  uint32_t* sums = buffered ? source.coverage_uq32 : source.visible_uq32;
  uint32_t sum = 0, cells = 0;
  const int share = source.flags & hemicube_four_eyes ? 2 : 0;  // of four eyes each gives a quarter
  for (int row = touched.first; row < touched.end; ++row) {
    uint32_t* mask = source.mask + (row - band.first) * words;
    const uint32_t* delta = delta_row(source.table, band.face, row);
    const int64_t at_row = depth.corner + row * depth.per_row;
    const int place = (row - band.first) * resolution;
    for (int k = 0; k < words; ++k) {
      const uint32_t bits = mask[k];
      if (bits == 0) continue;
      mask[k] = 0;
      const int first = top_bit(bits & (0u - bits)), last = top_bit(bits);
      for (int bit = first; bit <= last; ++bit) {
        if (!(bits >> bit & 1u)) continue;
        const int column = 32 * k + bit;
        ++cells;
        sum = add_saturating(sum, delta[half_column(half, column)] >> share);
        if (!buffered) continue;
        const uint32_t here = code(at_row + column * depth.per_column, depth.exponent);
        uint32_t& nearest = source.depth[place + column];
        uint16_t& item = source.item[place + column];
        const bool level =
            nearest != 0 && (here > nearest ? here - nearest : nearest - here) <= kTie;
        if (level ? item != kNoItem : here < nearest) continue;
        nearest = here;
        item = view.item;
      }
    }
  }
  if (sums && view.patch != kNoItem) sums[view.patch] = add_saturating(sums[view.patch], sum);
  return cells;
}

void harvest(const HemicubeSource& source, const Band& band, const Band& touched) noexcept {
  const int resolution = source.table.resolution, half = resolution >> 1;
  const int share = source.flags & hemicube_four_eyes ? 2 : 0;
  uint32_t* depth = source.depth + (touched.first - band.first) * resolution;
  uint16_t* item = source.item + (touched.first - band.first) * resolution;
  for (int row = touched.first; row < touched.end; ++row) {
    const uint32_t* delta = delta_row(source.table, band.face, row);
    for (int column = 0; column < resolution; ++column, ++depth, ++item) {
      if (*depth == 0) continue;
      *depth = 0;
      if (*item == kNoItem) continue;
      uint32_t& sum = source.visible_uq32[*item];
      sum = add_saturating(sum, delta[half_column(half, column)] >> share);
      *item = kNoItem;
    }
  }
}

}  // namespace urad::raster
