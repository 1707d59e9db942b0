// pair.hpp -- what two patches are to each other: the invariants that kernels and networks read.
//
//   r = c_j - c_i,  R = |r|,  w = r/R,  p = n_i.w,  q = -n_j.w
//   s = tr M / R^2 of a patch,  rho = s_i + s_j
//   K0 = A_i A_j p q / (pi R^2)                            centre kernel, an exchange: G = A_i F_ij
//   T2 = sum over both of s [-2 + 12 a - 4 c/(m.w)]        a = w.Mw/trM,  c = m.Mw/trM,
//                                                          m the other's normal
//
// Everything is invariant under rigid motion and scale, and belongs to the unordered pair: the two
// patches are put into an order that depends on their invariants alone, so that (i, j) and (j, i)
// give the same bits.
#pragma once
#include "urad/log2.hpp"
#include "urad/patch.hpp"

namespace urad {

inline constexpr int kPairInputs = 14;
inline constexpr int32_t kLog2Pi_q24 =
    int32_t((1 + table::ln(3.14159265358979323846 / 2) / table::kLn2) * 16777216 + 0.5);
inline constexpr int32_t kLog2Log2E_q24 =
    int32_t(table::ln(1 / table::kLn2) / table::kLn2 * 16777216 + 0.5);
inline constexpr uint32_t kSizeLimit_uq22 = uint32_t{8} << 22;  ///< s and slopes of a pair end here
inline constexpr int32_t kTermLimit_q22 = 63 << 22;             ///< and so does |T| in a bend

/// Network inputs, all Q0.15. First = the patch that comes first in the canonical order (larger
/// area, then cosine, ...):
///   0 p   1 q   2 n_i.n_j
///   3 ..  of the first patch, 8 .. of the second, with its own M and the other's normal m:
///         s/(1+rho),  a s/(1+rho),  c s/((m.w)(1+rho)),  t/(1+t) with t = m.Mm/(R m.w)^2,
///         A/(A + 12 tr M)
///   13    log2 of the bend / 4
struct Pair {
  int32_t log2_kernel_q24;  ///< log2 K0, square scene units, Q7.24
  int32_t log2_bend_q24;  ///< T2 / sqrt(1 + (T2/1.5)^2) in units of log2, Q7.24, |bend| < 2.17: K =
                          ///< K0 2^bend
  uint32_t rho_uq16;      ///< UQ16.16, saturating at 16
  uint16_t gate_uq16;     ///< g^2 = (rho/(1+rho))^2
  int16_t input_q15[kPairInputs];
};

/// One patch seen from the other; m is the other's normal.
struct PairSide {
  const urad_shape* shape;
  int32_t log2_cosine_q24;        ///< of this patch: log2 of p or q
  int32_t log2_slope_q24;         ///< log2 of s / |m.w|
  int32_t log2_cosine_other_q24;  ///< log2 |m.w|
  uint32_t size_uq22;             ///< s, 8 at most
  int32_t along_q22;              ///< a s
  int32_t across_q22;             ///< c s / (m.w)
};

/// What the kernels need, and what the network's inputs are made from if they are wanted.
struct PairKernel {
  int32_t log2_kernel_q24, log2_bend_q24;
  uint32_t rho_uq16, rho_uq22;
  PairSide side[2];
};

/// Kernel terms of two patches of which every part lies in front of the other's plane (cut before,
/// if need be). False, with *kernel undefined, when a centroid lies on or behind the other's plane.
///   Error   log2 K0: 2.3e-6 each for p and q, 2 x 2.3e-6 for R^2; bend: 1e-5 of s (12 a, 4 c, each
///           Q15 in the bracket)
///   Cost    9 wide products (3 fewer for each normal along an axis), 52 of 32 bits, 4 log2, 6 exp2;
///           no division
bool pair_kernel(const urad_shape& i, const urad_point& centroid_i, const urad_shape& j,
                 const urad_point& centroid_j, PairKernel* kernel) noexcept;

/// The bend with a third term, of third_order.hpp: of T2 + T3, |T3| <= 8.
int32_t log2_bend_q24(const PairKernel& kernel, int32_t t3_q22) noexcept;

/// log2 of what the extent of side 0 (patch i) makes of the factor from its centroid, Q7.24,
/// below 2.17: the half of the bend that an eye at the centroid cannot see.
int32_t log2_extent_q24(const PairKernel& kernel) noexcept;

/// The network's inputs and gate of the same pair. Cost: 60 products of 32 bits, 3 log2, 7 exp2.
void pair_inputs(const PairKernel& kernel, Pair* pair) noexcept;

/// Both, for training and for tests.
bool pair_invariants(const urad_shape& i, const urad_point& centroid_i, const urad_shape& j,
                     const urad_point& centroid_j, Pair* pair) noexcept;

}  // namespace urad
