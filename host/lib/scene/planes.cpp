#include "scene/planes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace host {
namespace {

constexpr double kSamePlane = 1e-6;  // of the size of the polygon

// Finds planes again: one number per plane, hashed so that different planes rarely share it.
class Planes {
 public:
  explicit Planes(double scene_size) : scene_size_(scene_size) {}

  // Index of the plane of `polygon` among those seen with this material; a new one if there is
  // none.
  std::size_t find(const Polygon& polygon, int material) {
    const Moments m = moments(polygon);
    const double key =
        glm::dot(m.normal, Vec3(0.618, 1.414, 3.142) + 2.236 / scene_size_ * m.centroid);
    constexpr double kWindow = 1e-4;
    for (auto it = by_key_.lower_bound(key - kWindow);
         it != by_key_.end() && it->first <= key + kWindow; ++it) {
      const Plane& plane = it->second;
      if (plane.material == material && glm::dot(plane.normal, m.normal) > 0 &&
          holds(plane, polygon))
        return plane.index;
    }
    by_key_.emplace(key, Plane{m.centroid, m.normal, material, count_});
    return count_++;
  }

 private:
  struct Plane {
    Vec3 point, normal;
    int material;
    std::size_t index;
  };
  static bool holds(const Plane& plane, const Polygon& polygon) {
    const double tolerance = kSamePlane * size_of(polygon.outer);
    return std::all_of(polygon.outer.begin(), polygon.outer.end(), [&](const Vec3& x) {
      return std::abs(glm::dot(plane.normal, x - plane.point)) <= tolerance;
    });
  }
  double scene_size_;
  std::size_t count_ = 0;
  std::multimap<double, Plane> by_key_;
};

}  // namespace

std::vector<FaceGroup> group_faces(const std::vector<Face>& faces,
                                   const std::vector<Piece>& pieces) {
  Vec3 low = faces.front().polygon.outer.front(), high = low;
  for (const Face& face : faces)
    for (const Vec3& x : face.polygon.outer) low = glm::min(low, x), high = glm::max(high, x);
  Planes planes(glm::length(high - low));
  std::vector<FaceGroup> groups;
  std::map<std::size_t, std::size_t> group_of_plane;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const bool alone = pieces[k].grid && pieces[k].grid->count_u * pieces[k].grid->count_v > 1;
    if (!alone) {
      // Relative to a corner of the box: the key must not depend on where the scene stands.
      Polygon moved = faces[k].polygon;
      for (Vec3& x : moved.outer) x -= low;
      for (Loop& hole : moved.holes)
        for (Vec3& x : hole) x -= low;
      const auto [at, fresh] =
          group_of_plane.emplace(planes.find(moved, faces[k].material), groups.size());
      if (!fresh) {
        groups[at->second].faces.push_back(k);
        continue;
      }
    }
    groups.push_back({faces[k].material, {k}});
  }
  return groups;
}

}  // namespace host
