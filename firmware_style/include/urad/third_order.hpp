// third_order.hpp -- T3, the term of third order of the moment kernel: of patches that have no
// centre of symmetry.
//
//   Of a patch, u = x - c, with w from c to the other's centroid and m the other's normal:
//   T3 = E[P(u)] / R^3      P = 4 a (8 a^2 - 3 |u|^2) - 2 b/(m.w) (6 a^2 - |u|^2)
//                           a = u.w,  b = u.m
// E is the mean over the patch. P is a cubic form, so its corners say it, and nothing is stored:
//   triangle                        E = sum P(u_k) / 30, since the u_k add up to 0
//   triangle c, c + u, c + v        E = (P(u) + P(v) + P(u+v)/2) / 15   [Simpson's rule along u v]
// and a polygon is a fan of such triangles, weighted by their signed areas.
#pragma once
#include "urad/pair.hpp"

namespace urad {

inline constexpr int32_t kThirdLimit_q22 = int32_t{2} << 22;  ///< of either half of P, either patch

struct ThirdOrder {
  int32_t t3_q22;   ///< |T3| <= 8
  uint16_t cubics;  ///< P was computed at so many points
};

/// T3 of two patches that were not cut; grids and parallelograms have none, and cost nothing.
/// `kernel` is that of the two, in this order. (i, j) and (j, i) give the same bits.
///   Formats  u in 12 bits and sign of the patch's own extent; at u + v, |u|^2 and a^2 below 2^27.6,
///            8 a^2 - 3 |u|^2 below 2^30, 16 bits of it times a below 2^30; areas below 2^26, sums
///            of areas times P below 2^61; both halves of P end at 2
///   Error    1e-3 of (extent / R)^3 / |m.w|, measured 4.3e-4 (tests/third_order_fixed_test.cpp)
///   Cost     12 products of 16 bits for every P; of fans 2 more an edge, and 2 wide ones
ThirdOrder third_order(const urad_scene& scene, const Patch& i, const Patch& j,
                       const PairKernel& kernel) noexcept;

}  // namespace urad
