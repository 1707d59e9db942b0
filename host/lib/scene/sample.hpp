// Evenly spread points: low-discrepancy numbers and points on polygons.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/triangulate.hpp"

namespace host {

/// Van der Corput's sequence in a prime base, 0 < value < 1 for k > 0 [Halton 1960].
inline double radical_inverse(std::uint32_t k, std::uint32_t base) {
  double value = 0;
  double digit = 1;
  for (; k > 0; k /= base) {
    digit /= base;
    value += digit * (k % base);
  }
  return value;
}

/// Maps the unit square to a polygon, areas in proportion. Any planar polygon of positive area.
class PolygonSampler {
 public:
  explicit PolygonSampler(const Polygon& polygon);
  /// 0 <= s, t < 1.
  Vec3 operator()(double s, double t) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<double> share_;  // running sum of areas, ends at 1
};

}  // namespace host
