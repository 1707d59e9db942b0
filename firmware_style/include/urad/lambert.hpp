// lambert.hpp -- the exact sum: form factors of touching, nearly touching and clipped pairs.
//
//   F_dA,j = 1/(2 pi) sum over the edges of j of  n . unit(r_k+1 x r_k) angle(r_k, r_k+1) [Lambert
//   1760]
//
// from a surface element to a polygon cut at the element's horizon, then its mean over points of a
// patch. It is exact where a kernel diverges, so nothing has to be bisected for ever.
//
//   Width     the pair is brought to a frame whose origin is the centroid of the patch that carries
//             the points and whose greatest coordinate has 29 bits; cross products are exact in 62
//   Error     of a term: direction 2.0e-9, angle 5.0e-9 (angle.hpp), rounding 2^-30: of the factor
//             to a polygon of m vertices about m 1.5e-9, whatever F. A crossing with the horizon is
//             rounded to a unit of the frame, which at a distance of d units turns an edge by 1/d
//   Measured  tests/lambert_fixed_test.cpp: absolute 3.2e-6, relative 6.6e-4 for F >= 1e-4
//   Cost      an edge: 31 products of 32 by 32 bits, 2 normalisations, 1 log2, 1 exp2; no division
#pragma once
#include "urad/form_factor.hpp"

namespace urad {

inline constexpr int kMostLambertPoints = 4;
/// What the hand-over from a network uses.
inline constexpr int kHandOverPoints = 3;

/// Form factor (UQ2.30, 0 .. 2^30) from a surface element at x with this unit normal to `polygon`,
/// cut at the element's horizon and seen from the polygon's lit side only.
uint32_t point_factor_uq30(const urad_scene& scene, const urad_point& x,
                           const urad_point& normal_q30, const Patch& polygon) noexcept;

/// log2 G (Q7.24, square scene units), or kNoExchange: exact over one patch, by points x points
/// Gauss points over the other, 1 <= points <= 4.
///   Carrier   the patch with the smaller spread carries the points (then the smaller area, then
///             the nearer plane), so (i, j) and (j, i) give the same bits
///   Cut       the carrier is cut to the front half-space of the other, the other to the carrier's
///   Pieces    a whole convex quadrilateral is one bilinear piece; anything else is a fan of
///             triangles about the mean of its vertices. Signed areas cancel outside a concave
///             patch, so the rule is exact for low moments of any polygon
///   Sums      null, or the number of points is added to it: what the pair costs
///   Cells     a piece is halved along its longer sides, up to 6 times a side and 8 times in all,
///             where an edge or vertex of the other is near by its size: there the factor bends
int32_t lambert_exchange_log2_q24(const urad_scene& scene, const Patch& i, const Patch& j,
                                  int points, uint32_t* sums = nullptr) noexcept;

/// What a sum knows of itself: log2 of each, by the sum.
enum SumTrait {
  sum_slope,    ///< first differences along both sides of the cells
  sum_bend,     ///< second differences, or what the first make likely
  sum_doubt,    ///< what decides which cell is halved next
  sum_worst,    ///< the greatest of those
  sum_change,   ///< what the halvings that made the cells changed, their signs kept
  sum_changes,  ///< the same without signs
  sum_moved,    ///< what the sum changed by since there were half as many cells, about
  sum_near,     ///< sums of the cells that an edge or vertex of the other is near to
  sum_cells,    ///< log2 of the number of cells
  kSumTraits
};
inline constexpr int16_t kTraitLimit_q8 = 24 * 256;

struct LambertSum {
  int32_t log2_exchange_q24;  ///< log2 G, or kNoExchange
  uint16_t point_sums;        ///< how many points it took
  int16_t log2_dark_q8;       ///< log2 of what cells may hold that no point has seen, by the sum
  int16_t log2_trait_q8[kSumTraits];  ///< by SumTrait, within +-24; -24 also for log2 0
};

inline constexpr int kMostRefinedCells = 64;

/// One rule of points x points, 1 to 3, on every piece; then (3 points) the most doubtful cell is
/// halved as often as asked for, or until 64 cells have been measured [adaptive cubature: van Dooren
/// and de Ridder 1976]. Carrier, cut and pieces as above: (i, j) and (j, i) give the same bits.
///   Doubt     of a cell: its second differences b along both sides as b (b/sum)^3, but at least
///             2^-5 of its greatest factor where an edge or vertex of the other is near by the
///             cell's size, and at least 2^-2 of what the halving that made it changed
///   Dark      a cell that is near and of which all points see next to nothing is doubted by the
///             greatest factor of all cells: no point sees what lies between it and the edge
///   Memory    24 cells of 56 bytes on the stack; the least doubtful drop out, their doubt stays
LambertSum lambert_refined(const urad_scene& scene, const Patch& i, const Patch& j, int points,
                           int halvings) noexcept;

}  // namespace urad
