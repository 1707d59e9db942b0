#include "pose/pose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace host {

// Of the distance allowed: a match this close is taken without looking for a closer one.
constexpr double kGoodEnough = 0x1p-10;

/// An outline from a chosen first corner, in a chosen direction.
struct PoseClasses::View {
  const PoseOutline& outline;
  std::size_t first = 0;
  bool mirrored = false;

  std::size_t size() const { return outline.corner.size(); }
  const Vec3& corner(std::size_t k) const {
    const std::size_t n = size();
    return outline.corner[mirrored ? (first + n - k) % n : (first + k) % n];
  }
};

PoseOutline pose_outline(Loop corners) {
  PoseOutline outline;
  outline.corner = std::move(corners);
  const std::size_t n = outline.corner.size();
  for (const Vec3& x : outline.corner) outline.centre += x / double(n);
  Vec3 twice_area(0);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 a = outline.corner[k] - outline.centre,
               b = outline.corner[(k + 1) % n] - outline.centre;
    twice_area += glm::cross(a, b);
    outline.perimeter += glm::length(b - a);
    outline.radius = std::max(outline.radius, glm::length(a));
  }
  const double length = glm::length(twice_area);
  outline.area = 0.5 * length;
  if (length > 0) outline.normal = twice_area / length;
  return outline;
}

namespace {

bool in_front(const PoseOutline& plane, const PoseOutline& patch) {
  return std::all_of(patch.corner.begin(), patch.corner.end(),
                     [&](const Vec3& x) { return glm::dot(plane.normal, x - plane.centre) >= 0; });
}

}  // namespace

double pose_difference(const PoseOutline& p, const PoseOutline& q, double distance) {
  const double least = std::min(p.area, q.area);
  if (!in_front(p, q) || !in_front(q, p)) return 2 * distance * (p.perimeter + q.perimeter) / least;
  const double apart = glm::length(q.centre - p.centre) - p.radius - q.radius - 2 * distance;
  const auto irradiance = [&](double area) {
    return apart > 0 ? std::min(1.0, area / (std::numbers::pi * apart * apart)) : 1.0;
  };
  return distance * (p.perimeter * irradiance(q.area) + q.perimeter * irradiance(p.area)) / least;
}

double pose_tolerance(const PoseOutline& p, const PoseOutline& q) {
  return 0x1p-13 * std::min(p.area, q.area) / (p.perimeter + q.perimeter);
}

PoseClasses::Pose PoseClasses::pose_of(const View& p, const View& q) {
  const Vec3 z = p.outline.normal, origin = p.outline.centre;
  Vec3 x = p.corner(1) - p.corner(0);
  x = glm::normalize(x - glm::dot(x, z) * z);
  const Vec3 y = glm::cross(z, x) * (p.mirrored ? -1.0 : 1.0);
  const auto seen = [&](const View& view) {
    Loop loop;
    for (std::size_t k = 0; k < view.size(); ++k) {
      const Vec3 d = view.corner(k) - origin;
      loop.push_back({glm::dot(x, d), glm::dot(y, d), glm::dot(z, d)});
    }
    return loop;
  };
  Pose pose;
  pose.p = seen(p);
  pose.q = seen(q);
  const Vec3 r = q.outline.centre - p.outline.centre;
  pose.height_p = glm::dot(z, r);
  pose.height_q = -glm::dot(q.outline.normal, r);
  return pose;
}

namespace {

/// Largest distance between corners a[k] and b[k + shift], or none beyond the limit.
std::optional<double> apart(const Loop& a, const Loop& b, std::size_t shift, double limit) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double d = glm::length(a[k] - b[(k + shift) % b.size()]);
    if (!(d <= limit)) return std::nullopt;
    most = std::max(most, d);
  }
  return most;
}

}  // namespace

/// The least distance at which p, q is the known pose, p in the place of the known first patch.
std::optional<double> PoseClasses::distance(const Pose& known, const PoseOutline& p,
                                            const PoseOutline& q, double limit) const {
  if (known.p.size() != p.corner.size() || known.q.size() != q.corner.size()) return std::nullopt;
  const Vec3 r = q.centre - p.centre;
  if (std::abs(glm::dot(p.normal, r) - known.height_p) > 2 * limit) return std::nullopt;
  std::optional<double> least;
  for (const bool mirrored : {false, true}) {
    for (std::size_t first = 0; first < p.corner.size(); ++first) {
      const Pose pose = pose_of({p, first, mirrored}, {q, 0, mirrored});
      const auto at_p = apart(known.p, pose.p, 0, limit);
      if (!at_p) continue;
      for (std::size_t shift = 0; shift < pose.q.size(); ++shift) {
        const auto at_q = apart(known.q, pose.q, shift, limit);
        if (at_q && (!least || std::max(*at_p, *at_q) < *least)) least = std::max(*at_p, *at_q);
      }
      if (least && *least <= limit * kGoodEnough) return least;
    }
  }
  return least;
}

PoseClasses::Found PoseClasses::find(const PoseOutline& p, const PoseOutline& q) {
  const double limit = pose_tolerance(p, q), centres = glm::length(q.centre - p.centre);
  Found found{count_, false, 0};
  std::optional<double> least;
  const auto end = by_distance_.upper_bound(centres + 2 * limit);
  for (auto at = by_distance_.lower_bound(centres - 2 * limit); at != end; ++at) {
    if (least && *least <= limit * kGoodEnough) break;
    for (const bool swapped : {false, true}) {
      const auto d =
          swapped ? distance(at->second, q, p, limit) : distance(at->second, p, q, limit);
      if (!d || (least && *d >= *least)) continue;
      least = d;
      found = {at->second.index, swapped, *d};
    }
  }
  if (!least) {
    Pose pose = pose_of({p, 0, false}, {q, 0, false});
    pose.index = count_++;
    by_distance_.emplace(centres, std::move(pose));
  }
  return found;
}

}  // namespace host
