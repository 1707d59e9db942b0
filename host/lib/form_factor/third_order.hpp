// The moment kernel with third moments, which patches without a centre of symmetry have.
#pragma once
#include <array>

#include "geometry/polygon.hpp"

namespace host {

/// (1/A) integral of u_a u_b u_c dA, u = x - c in two axes of the patch's plane: four numbers, all 0
/// for a parallelogram.
struct ThirdMoments {
  Vec3 axis[2]{};
  std::array<double, 4> value{};  ///< 000, 001, 011, 111
};

ThirdMoments third_moments(const Polygon& polygon, const Moments& moments);

/// T3, the term of size^3 / R^3 of the exchange over K0, beside T2 of kernel.hpp. Of one patch, with
/// w from its centroid to the other's, m the other's normal, W and M = m/(m.w) in its axes,
/// V_c = sum over a, b of t_abc W_a W_b and t_c = t_c00 + t_c11:
///   [(32 V - 12 t).W - (12 V - 2 t).M] / R^3
double third_order(const Moments& i, const ThirdMoments& third_i, const Moments& j,
                   const ThirdMoments& third_j);

}  // namespace host
