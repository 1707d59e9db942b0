#include "form_factor/monte_carlo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "form_factor/facing.hpp"
#include "geometry/planar.hpp"
#include "geometry/triangulate.hpp"

namespace host {
namespace {

constexpr int kReplicates = 16;
constexpr int kDimensions = 4;
constexpr double kSmallAngle = 1e-4;  // steradians below which spherical trigonometry loses digits

std::uint64_t splitmix64(std::uint64_t* state) {
  std::uint64_t z = *state += 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

using Point = std::array<double, kDimensions>;

/// Additive recurrence with the powers of 1/g, g^5 = g + 1 [Roberts 2018], shifted at random
/// modulo 1. In 64-bit fractions, so that no index is too large.
class Sequence {
 public:
  Sequence(std::uint64_t* seed) {
    constexpr double kGenerator = 1.16730397826141868;
    double alpha = 1;
    for (int d = 0; d < kDimensions; ++d) {
      alpha /= kGenerator;
      step_[d] = static_cast<std::uint64_t>(std::ldexp(alpha, 64));
      at_[d] = splitmix64(seed);
    }
  }
  Point next() {
    Point point;
    for (int d = 0; d < kDimensions; ++d) {
      at_[d] += step_[d];
      point[static_cast<std::size_t>(d)] = std::ldexp(static_cast<double>(at_[d] >> 11), -53);
    }
    return point;
  }

 private:
  std::uint64_t step_[kDimensions];
  std::uint64_t at_[kDimensions];
};

/// Chooses an index with probability weight / total, and stretches u over the chosen one's share.
std::size_t choose(const std::vector<double>& weights, double total, double* u) {
  double left = *u * total;
  std::size_t k = 0;
  while (k + 1 < weights.size() && left >= weights[k]) left -= weights[k++];
  *u = std::clamp(left / weights[k], 0.0, 1.0);
  return k;
}

/// Uniform on a triangle by the square map that collapses one side.
Vec3 on_triangle(const Triangle& t, double u, double v) {
  const double s = std::sqrt(u);
  return t[0] + s * ((t[1] - t[0]) + v * (t[2] - t[1]));
}

/// Solid angle of the triangle with corner directions a, b, c (unit) [Van Oosterom and Strackee
/// 1983].
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b - a, c - a))),
                        1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

Vec3 unit_across(const Vec3& x, const Vec3& axis) {
  const Vec3 across = x - glm::dot(x, axis) * axis;
  const double length = glm::length(across);
  return length > 0 ? across / length : Vec3(0);
}

/// Uniform direction inside a spherical triangle of the given solid angle [Arvo 1995, algorithm 1].
Vec3 in_spherical_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double angle, double u,
                           double v) {
  const Vec3 to_b = unit_across(b, a);
  const Vec3 to_c = unit_across(c, a);
  const double cos_alpha = std::clamp(glm::dot(to_b, to_c), -1.0, 1.0);
  const double sin_alpha = std::sqrt(1 - cos_alpha * cos_alpha);
  const double phi = u * angle - std::acos(cos_alpha);
  const double s = std::sin(phi);
  const double t = std::cos(phi);
  const double x = t - cos_alpha;
  const double y = s + sin_alpha * glm::dot(a, b);
  const double down = (y * s + x * t) * sin_alpha;
  const double q =
      down != 0 ? std::clamp(((y * t - x * s) * cos_alpha - y) / down, -1.0, 1.0) : 1.0;
  const Vec3 corner = q * a + std::sqrt(1 - q * q) * to_c;
  const double z = 1 - v * (1 - glm::dot(corner, b));
  return z * b + std::sqrt(std::max(0.0, 1 - z * z)) * unit_across(corner, b);
}

/// An opaque polygon, prepared for many segments.
class Blocker {
 public:
  explicit Blocker(const Polygon& polygon)
      : m_(moments(polygon)), flatten_(m_.normal), rounding_(2 * coordinate_rounding(polygon)) {
    for (const Loop& loop : boundary(polygon)) loops_.push_back(flatten_(loop));
  }

  bool hit(const Vec3& a, const Vec3& b) const {
    const double ha = glm::dot(m_.normal, a - m_.centroid);
    const double hb = glm::dot(m_.normal, b - m_.centroid);
    // Ends on the plane are not between the ends: a blocker in the plane of a patch shadows
    // nothing.
    if (ha * hb >= 0 || std::abs(ha) <= rounding_ || std::abs(hb) <= rounding_) return false;
    const Vec2 x = flatten_(a + (b - a) * (ha / (ha - hb)));
    bool inside = false;
    for (const Loop2& loop : loops_) inside ^= locate(x, loop, -1) > 0;
    return inside;
  }

 private:
  Moments m_;
  Projection flatten_;
  double rounding_;
  std::vector<Loop2> loops_;
};

struct Scene {
  std::vector<Triangle> p_triangles, q_triangles;
  std::vector<double> p_areas;
  double p_area = 0;
  Vec3 p_normal, q_normal;
  std::vector<Blocker> blockers;

  bool blocked(const Vec3& a, const Vec3& b) const {
    return std::any_of(blockers.begin(), blockers.end(),
                       [&](const Blocker& x) { return x.hit(a, b); });
  }

  /// One ray: its share of F, whose mean over the points of the unit cube is F from the clipped p.
  double sample(Point u, std::vector<double>* angles) const {
    const Triangle& from = p_triangles[choose(p_areas, p_area, &u[0])];
    const Vec3 x = on_triangle(from, u[0], u[1]);
    double total = 0;
    angles->clear();
    for (const Triangle& t : q_triangles) {
      angles->push_back(solid_angle(glm::normalize(t[0] - x), glm::normalize(t[1] - x),
                                    glm::normalize(t[2] - x)));
      total += angles->back();
    }
    if (!(total > 0)) return 0;
    const std::size_t k = choose(*angles, total, &u[2]);
    const Triangle& to = q_triangles[k];
    const double probability = (*angles)[k] / total;
    Vec3 y;
    double share;
    if ((*angles)[k] > kSmallAngle) {
      const Vec3 d = in_spherical_triangle(glm::normalize(to[0] - x), glm::normalize(to[1] - x),
                                           glm::normalize(to[2] - x), (*angles)[k], u[2], u[3]);
      y = x + d * (glm::dot(q_normal, to[0] - x) / glm::dot(q_normal, d));
      share = glm::dot(p_normal, d) * total;
    } else {
      y = on_triangle(to, u[2], u[3]);
      const Vec3 r = y - x;
      const double r2 = glm::dot(r, r);
      const double area = 0.5 * glm::length(glm::cross(to[1] - to[0], to[2] - to[0]));
      share = -glm::dot(p_normal, r) * glm::dot(q_normal, r) / r2 * (area / r2) / probability;
    }
    if (!(share > 0) || blocked(x, y)) return 0;
    return share * std::numbers::inv_pi;
  }
};

double area_of(const Triangle& t) {
  return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
}

/// Triangles of the part in front of a plane; cut first, clipped then, so that no loop touches
/// itself.
std::vector<Triangle> clipped_triangles(const Polygon& polygon, const Moments& plane) {
  std::vector<Triangle> result;
  for (const Triangle& t : triangulate(polygon)) {
    const Loop loop = clip({{t[0], t[1], t[2]}, {}}, plane.centroid, plane.normal).outer;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      const Triangle piece = {loop[0], loop[k], loop[k + 1]};
      if (area_of(piece) > 0) result.push_back(piece);
    }
  }
  return result;
}

}  // namespace

bool segment_hits(const Vec3& a, const Vec3& b, const Polygon& polygon) {
  return Blocker(polygon).hit(a, b);
}

Estimate monte_carlo(const Polygon& p, const Polygon& q, std::int64_t samples,
                     const std::vector<Polygon>& blockers, std::uint64_t seed) {
  if (samples < 1) throw Error(std::to_string(samples) + " samples; at least 1 is needed");
  if (clip_to_front(p, q).empty()) return {0, 0};
  const Moments mp = moments(p);
  const Moments mq = moments(q);
  Scene scene;
  scene.p_triangles = clipped_triangles(p, mq);
  scene.q_triangles = clipped_triangles(q, mp);
  if (scene.p_triangles.empty() || scene.q_triangles.empty()) return {0, 0};
  scene.p_normal = mp.normal;
  scene.q_normal = mq.normal;
  for (const Triangle& t : scene.p_triangles) {
    scene.p_areas.push_back(area_of(t));
    scene.p_area += scene.p_areas.back();
  }
  for (const Polygon& blocker : blockers) scene.blockers.emplace_back(blocker);

  const int replicates = static_cast<int>(std::min<std::int64_t>(kReplicates, samples));
  const std::int64_t rays = (samples + replicates - 1) / replicates;
  std::vector<double> angles;
  double sum = 0;
  double squares = 0;
  for (int r = 0; r < replicates; ++r) {
    Sequence sequence(&seed);
    double mean = 0;
    for (std::int64_t k = 0; k < rays; ++k) mean += scene.sample(sequence.next(), &angles);
    mean /= static_cast<double>(rays);
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / replicates;
  const double variance =
      std::max(0.0, squares / replicates - mean * mean) / std::max(1, replicates - 1);
  Estimate result{std::min(1.0, mean * scene.p_area / mp.area)};
  if (replicates > 1 && mean > 0) result.relative_error = std::sqrt(variance) / mean;
  return result;
}

}  // namespace host
