// hemicube_raster.hpp -- inside of the hemicube: the view of one polygon and its cells on a face.
#pragma once
#include "urad/hemicube.hpp"

namespace urad::raster {

/// The half cube of one shooter.
struct Eye {
  urad_point at;
  HemicubeFrame frame;
};

/// A polygon seen from the eye. Vertices are directions: each is scaled by a power of two of its
/// own, which depends on the vertex alone, so that polygons that share a vertex see the same
/// integers. Components up to sqrt(3) 2^30.
struct View {
  const urad_point* corner;
  uint16_t corners;
  uint16_t item;          ///< what is stored in its cells
  uint16_t patch;         ///< whose coverage it counts for; kNoItem: nobody's
  urad_point normal_q30;  ///< in the frame
  int64_t offset_q30;     ///< normal . x on its plane, scene units; the eye is at 0. Never 0.
};

/// Rows [first, end) of one face, the part of it that is being drawn.
struct Band {
  int face;
  int first, end;
};

/// Scene point seen from the eye, as described at View.
urad_point direction(const Eye& eye, const urad_point& x) noexcept;

/// Axes (s, t, w) of a face: HemicubeSource's hemicube_items() lists them.
urad_point to_face(int face, const urad_point& x) noexcept;

/// Planes of the face's pyramid that x lies outside of; a polygon all of whose vertices share a bit
/// misses the face.
enum Outside : unsigned { right = 1, left = 2, above = 4, below = 8, behind = 16, anywhere = 31 };
unsigned outside(int face, const urad_point& on_face) noexcept;

/// Toggles, in `mask` (words per row as given, row band.first first), the cells to the right of
/// each edge: what is left set is the inside by the even-odd rule. Returns the rows touched as a
/// band, empty (first >= end) when there are none.
Band scan(const View& view, const Band& band, int resolution, int words, uint32_t* mask) noexcept;

/// Draws the cells set in `mask` over rows `touched` into the buffers or, without buffers, straight
/// into the sums; clears the mask. Returns the number of cells.
uint32_t paint(const HemicubeSource& source, const View& view, const Band& band,
               const Band& touched) noexcept;

/// Adds the cells of rows `touched` of a finished band to visible_uq32 and empties them.
void harvest(const HemicubeSource& source, const Band& band, const Band& touched) noexcept;

/// a + b, saturating at 2^32 - 1.
constexpr uint32_t add_saturating(uint32_t a, uint32_t b) noexcept {
  return a > 0xFFFFFFFFu - b ? 0xFFFFFFFFu : a + b;
}

/// Delta form factors of row `row` of a face, to be read at |column - middle|: see half_column().
constexpr const uint32_t* delta_row(const HemicubeTable& table, int face, int row) noexcept {
  const int half = table.resolution >> 1, away = row < half ? half - 1 - row : row - half;
  return (face == 0 ? table.top : table.side) + away * half;
}
constexpr int half_column(int half, int column) noexcept {
  return column < half ? half - 1 - column : column - half;
}

}  // namespace urad::raster
