#include "geometry/triangulate.hpp"

#include <numeric>

#include "geometry/bridge.hpp"
#include "geometry/planar.hpp"

namespace host {
namespace {

/// The corners that are still to be cut, as indices of the loop's vertices.
class EarClipper {
 public:
  EarClipper(const Loop2& loop, double tolerance)
      : loop_(loop), tolerance_(tolerance), left_(loop.size()) {
    std::iota(left_.begin(), left_.end(), std::size_t{0});
  }

  std::vector<std::array<std::size_t, 3>> run() {
    std::vector<std::array<std::size_t, 3>> triangles;
    while (left_.size() >= 3) {
      const std::size_t ear = best_ear();
      const std::array<std::size_t, 3> t = {left_[before(ear)], left_[ear], left_[after(ear)]};
      if (orientation(loop_[t[0]], loop_[t[1]], loop_[t[2]]) > 0) triangles.push_back(t);
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
  }

 private:
  std::size_t before(std::size_t k) const { return (k + left_.size() - 1) % left_.size(); }
  std::size_t after(std::size_t k) const { return (k + 1) % left_.size(); }
  const Vec2& at(std::size_t k) const { return loop_[left_[k]]; }

  /// A flat corner costs nothing and goes first; then the ear whose triangle is widest for its
  /// longest side, which keeps slivers away. Without any ear (rounding, crossed loops) the first
  /// corner goes.
  std::size_t best_ear() const {
    std::size_t best = 0;
    double best_shape = -1;
    for (std::size_t k = 0; k < left_.size(); ++k) {
      const Vec2& a = at(before(k));
      const Vec2& b = at(k);
      const Vec2& c = at(after(k));
      if (side(a, b, c, tolerance_) == 0) return k;
      const double doubled = orientation(a, b, c);
      const double longest =
          std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
      if (doubled <= 0 || doubled / longest <= best_shape || !is_ear(k)) continue;
      best = k;
      best_shape = doubled / longest;
    }
    return best;
  }

  bool is_ear(std::size_t k) const {
    const Vec2& a = at(before(k));
    const Vec2& b = at(k);
    const Vec2& c = at(after(k));
    for (std::size_t j = 0; j < left_.size(); ++j) {
      const Vec2& x = at(j);
      // Bridges double vertices: a copy of a corner is no obstacle, but an edge across the cut is.
      if (cross_properly(a, c, x, at(after(j)), tolerance_)) return false;
      if (x == a || x == b || x == c) continue;
      if (side(a, b, x, tolerance_) >= 0 && side(b, c, x, tolerance_) >= 0 &&
          side(c, a, x, tolerance_) >= 0)
        return false;
    }
    return true;
  }

  const Loop2& loop_;
  double tolerance_;
  std::vector<std::size_t> left_;
};

}  // namespace

std::vector<Triangle> triangulate(const Polygon& polygon) {
  const Moments m = moments(polygon);
  if (m.area <= 0) return {};
  const Loop loop = bridge_holes(polygon);
  const Loop2 flat = Projection(m.normal)(loop);
  std::vector<Triangle> triangles;
  for (const auto& [i, j, k] : EarClipper(flat, coordinate_rounding(polygon)).run())
    triangles.push_back({loop[i], loop[j], loop[k]});
  return triangles;
}

bool is_convex_quad(const Polygon& polygon) {
  if (polygon.outer.size() != 4 || !polygon.holes.empty()) return false;
  const Vec3 normal = moments(polygon).normal;
  const Loop& v = polygon.outer;
  for (std::size_t k = 0; k < 4; ++k)
    if (!(glm::dot(normal, glm::cross(v[(k + 1) % 4] - v[k], v[(k + 2) % 4] - v[(k + 1) % 4])) > 0))
      return false;
  return true;
}

}  // namespace host
