#include "solve/embree_visibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/error.hpp"

namespace host {
namespace {

// Fractional parts of k / phi^m, phi^5 = phi + 1: the four-dimensional golden ratio. Any number of
// points is even.
constexpr std::array<double, 4> kStep = {0.85667488385450287, 0.73389185662659953,
                                         0.62870672081145148, 0.53859725722361184};

// A number in [0, 1) from a pair and a dimension (splitmix64's finaliser).
double shift(std::uint64_t i, std::uint64_t j, std::uint64_t dimension) {
  std::uint64_t z = (i << 34) ^ (j << 4) ^ dimension;
  z += 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

double fraction_part(double x) { return x - std::floor(x); }

struct Sides {
  bool front = false, back = false;
  void add(const Polygon& polygon, const Moments& plane) {
    for (const Vec3& x : polygon.outer) {
      const double height = glm::dot(plane.normal, x - plane.centroid);
      front = front || height > 0;
      back = back || height < 0;
    }
  }
};

}  // namespace

EmbreeVisibility::EmbreeVisibility(const Scene& scene, int rays)
    : scene_(scene), rays_(rays), blockers_(scene.blockers) {
  if (rays < 1) throw Error("visibility needs at least one ray per pair");
  if (scene.blockers.empty()) return;
  for (const ScenePatch& patch : scene.patches) samplers_.emplace_back(patch.polygon);
  for (const Blocker& blocker : scene.blockers) planes_.push_back(moments(blocker.polygon));
}

// Not when both patches lie on one side of it, nor when it lies beside their common box.
bool EmbreeVisibility::can_block(const Blocker& blocker, const Moments& plane, std::size_t i,
                                 std::size_t j) const {
  const ScenePatch &p = scene_.patches[i], &q = scene_.patches[j];
  if (blocker.surface >= 0 && (blocker.surface == p.surface || blocker.surface == q.surface))
    return false;
  Sides sides;
  sides.add(p.polygon, plane);
  sides.add(q.polygon, plane);
  if (!sides.front || !sides.back) return false;
  Vec3 low = p.polygon.outer[0], high = low, blocker_low = blocker.polygon.outer[0],
       blocker_high = blocker_low;
  for (const Polygon* polygon : {&p.polygon, &q.polygon})
    for (const Vec3& x : polygon->outer) low = glm::min(low, x), high = glm::max(high, x);
  for (const Vec3& x : blocker.polygon.outer)
    blocker_low = glm::min(blocker_low, x), blocker_high = glm::max(blocker_high, x);
  return glm::all(glm::lessThanEqual(low, blocker_high)) &&
         glm::all(glm::lessThanEqual(blocker_low, high));
}

double EmbreeVisibility::fraction(std::size_t i, std::size_t j) const {
  if (i > j) std::swap(i, j);
  bool any = false;
  for (std::size_t k = 0; k < scene_.blockers.size() && !any; ++k)
    any = can_block(scene_.blockers[k], planes_[k], i, j);
  if (!any) return 1;

  const ScenePatch &p = scene_.patches[i], &q = scene_.patches[j];
  std::array<double, 4> offset{};
  for (std::size_t d = 0; d < 4; ++d) offset[d] = shift(i, j, d);
  double seen = 0, all = 0;
  for (int k = 0; k < rays_; ++k) {
    std::array<double, 4> u{};
    for (std::size_t d = 0; d < 4; ++d) u[d] = fraction_part(offset[d] + (k + 1) * kStep[d]);
    const Vec3 x = samplers_[i](u[0], u[1]), y = samplers_[j](u[2], u[3]);
    const Vec3 r = y - x;
    const double cos_x = glm::dot(p.moments.normal, r), cos_y = -glm::dot(q.moments.normal, r);
    if (cos_x <= 0 || cos_y <= 0) continue;
    const double r2 = glm::dot(r, r);
    const double kernel = cos_x * cos_y / (r2 * r2);
    all += kernel;
    if (!blockers_.blocked(x, y, p.surface, q.surface)) seen += kernel;
  }
  return all > 0 ? seen / all : 1;
}

}  // namespace host
