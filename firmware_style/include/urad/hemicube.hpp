// hemicube.hpp -- form factors from the centre of a patch to all patches at once, by item buffer.
//
// A half cube stands on the centre of the shooter [Cohen & Greenberg 1985]: a top face of R x R
// cells and four sides of R x R/2. Every cell is worth its delta form factor [Martin 1996, Eq. 2.7
// and the corrected 2.8]; a receiver gets the sum of the cells in which it is the nearest polygon.
// Any polygon may be drawn: concave, crossing the horizon, behind the eye in part. The half cube is
// turned about the normal by an angle that differs from patch to patch, which halves its aliasing.
#pragma once
#include <stddef.h>

#include "urad/patch.hpp"
#include "urad/source.h"

namespace urad {

inline constexpr uint16_t kHemicubeMinResolution = 16;
inline constexpr uint16_t kHemicubeMaxResolution = 128;

/// "Nothing" in an item buffer: no polygon, one that belongs to no surface, or the dark side of a
/// patch.
inline constexpr uint16_t kNoItem = 0xFFFF;

/// Delta form factors of one quadrant of the top and one half of a side, UQ0.32, each R/2 x R/2,
/// made by hemicube_table.hpp. top[y * R/2 + x]: x, y steps from the centre. side[z * R/2 + y]: z
/// rows above the horizon, y steps from the middle. All five faces together sum to exactly 2^32.
struct HemicubeTable {
  uint16_t resolution;  ///< R, even, 16 .. 128
  const uint32_t* top;
  const uint32_t* side;
};

enum HemicubeFlags : uint8_t {
  hemicube_turned = 1,    ///< turn about the normal by the angle of the patch
  hemicube_coverage = 2,  ///< also keep what each patch would cover if nothing else stood there
  hemicube_all_rows = 4,  ///< for tests: sum faces and rows that nothing touched, too
  hemicube_four_eyes = 8  ///< the mean of four half cubes, on the middles of the patch's quarters
};

/// Right-handed unit vectors, Q2.30: two in the plane of the patch, then its normal.
struct HemicubeFrame {
  urad_point axis[3];
};

/// The frame of patch number `patch` with this normal: turned by (bit-reversed (patch mod 32) +
/// 1/2) / 32 of a quarter, or by a hair, 2^-10, which keeps cells from looking exactly along the
/// edges of an upright room.
HemicubeFrame hemicube_frame(const urad_point& normal_q30, uint16_t patch, bool turned) noexcept;

/// A source (source.h) that renders once per new shooter and then serves runs from the row it
/// holds.
struct HemicubeSource {
  const urad_scene* scene;
  HemicubeTable table;
  uint16_t rows;            ///< band height; 0: convex scene, no item buffer
  uint8_t flags;            ///< HemicubeFlags
  int32_t shooter;          ///< whose row is held; -1: nobody's
  uint32_t* visible_uq32;   ///< [patch_count] sum of the cells each patch is seen in
  uint32_t* coverage_uq32;  ///< [patch_count] sum of the cells it covers, seen or not; null without
                            ///< hemicube_coverage
  uint32_t* depth;          ///< [rows * R] greater is nearer, 0 empty
  uint16_t* item;           ///< [rows * R] patch or kNoItem
  uint32_t* mask;           ///< [mask rows * words] cells inside the polygon being drawn
  urad_point* corner;       ///< vertices of the polygon being drawn, seen from the eye
  uint16_t corners;         ///< room in `corner`
  urad_counters* counters;
  bool used = false;  ///< cells stand in depth and item
};

/// Bytes that hemicube_init() needs. rows: band height of the item buffer, a whole face is
/// `resolution`; 0 for a convex scene, which needs none. vertices: the greatest vertex count of the
/// scene's polygons, 4 if all are grids.
constexpr size_t hemicube_bytes(uint16_t resolution, uint16_t rows, uint16_t patches, bool coverage,
                                uint16_t vertices = URAD_POLYGON_MAX_VERTICES) noexcept {
  const size_t words = (size_t{resolution} + 31) >> 5, mask_rows = rows ? rows : resolution;
  const size_t items = (size_t{2} * rows * resolution + 3) & ~size_t{3};
  return size_t{4} * patches * (coverage ? 2 : 1) + size_t{4} * rows * resolution + items +
         4 * mask_rows * words + sizeof(urad_point) * vertices;
}

/// Lays the source out in `memory` (4-byte aligned, the caller's, kept while the source is used).
/// `scene` has passed scene_check(). With rows = 0 the scene must be convex. The same bits for
/// every rows > 0.
///
/// bad_argument: null pointer, resolution odd or out of range, rows > resolution, rows = 0 on a
/// scene not convex. out_of_memory: `bytes` below hemicube_bytes() of this scene, or misaligned.
/// On failure *source and memory are untouched.
Status hemicube_init(HemicubeSource* source, const urad_scene* scene, const HemicubeTable& table,
                     uint16_t rows, uint8_t flags, void* memory, size_t bytes,
                     urad_counters* counters) noexcept;

/// Fills visible_uq32 (and coverage_uq32) with the row of `shooter` unless it is already there. In
/// a closed scene a row sums to exactly 2^32: cells that fall into a seam between rounded vertices
/// go to the greatest receiver, as long as they are less than 2^-8 of the whole. bad_argument: null
/// pointer or no such patch.
Status hemicube_render(HemicubeSource* source, uint16_t shooter) noexcept;

/// urad_fill for a HemicubeSource: bad_argument on a bad index, else ok.
urad_status hemicube_fill(void* hemicube_source, uint16_t shooter, uint16_t surface, uint16_t first,
                          uint16_t count, uint32_t* f_uq32) noexcept;

/// Draws rows first_row .. first_row + rows - 1 of one face (0 top, 1 .. 4 the sides) as seen from
/// `shooter` into source->item, for tests and pictures; needs rows > 0. On a side, row R/2 is the
/// first above the horizon; rows are numbered as in the top face and those below R/2 stay empty.
/// The row of factors held by the source is lost.
///
/// Cell (column c, row r) looks along s a + t b + w, s = (2c+1-R)/R, t = (2r+1-R)/R. With x, y, z =
/// frame.axis[0 .. 2], (a, b, w) of the faces is
///   0: (x, y, z)   1: (y, z, x)   2: (-y, z, -x)   3: (-x, z, y)   4: (x, z, -y)
Status hemicube_items(HemicubeSource* source, uint16_t shooter, int face,
                      uint16_t first_row) noexcept;

}  // namespace urad
