#include "scene/sample.hpp"

#include <algorithm>
#include <cmath>

namespace host {

PolygonSampler::PolygonSampler(const Polygon& polygon) : triangles_(triangulate(polygon)) {
  double sum = 0;
  for (const Triangle& t : triangles_) {
    sum += glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
    share_.push_back(sum);
  }
  for (double& share : share_) share /= sum;
}

Vec3 PolygonSampler::operator()(double s, double t) const {
  if (triangles_.empty()) return Vec3(0);
  const auto at = std::upper_bound(share_.begin(), share_.end() - 1, s);
  const auto k = std::size_t(at - share_.begin());
  const double before = k > 0 ? share_[k - 1] : 0;
  const double root = std::sqrt((s - before) / (share_[k] - before));
  const Triangle& corner = triangles_[k];
  return (1 - root) * corner[0] + root * (1 - t) * corner[1] + root * t * corner[2];
}

}  // namespace host
