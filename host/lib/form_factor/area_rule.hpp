// Gauss-Legendre points on intervals and on polygons.
#pragma once
#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace host {

inline constexpr int kMaxGaussPoints = 32;

struct GaussPoint {
  double x;       // -1..1
  double weight;  // sums to 2
};

/// The n-point rule on [-1, 1], n in 1..kMaxGaussPoints; exact for polynomials of degree 2n - 1.
std::span<const GaussPoint> gauss_rule(int n);

struct AreaPoint {
  Vec3 x;
  double area;
};

/// Points and areas of a polygon: n x n on a convex quadrilateral (bilinear map), n x n on each
/// triangle of any other (square map that collapses one side). The areas sum to the polygon's.
/// Throws Error for n outside 1..32.
std::vector<AreaPoint> area_points(const Polygon& polygon, int n);

/// The same for the part with normal . (x - point) >= 0. The polygon is cut up first, then clipped.
std::vector<AreaPoint> area_points(const Polygon& polygon, int n, const Vec3& point,
                                   const Vec3& normal);

}  // namespace host
