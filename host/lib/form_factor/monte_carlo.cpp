#include "form_factor/monte_carlo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "form_factor/facing.hpp"
#include "geometry/order.hpp"
#include "geometry/planar.hpp"
#include "geometry/triangulate.hpp"

namespace host {
namespace {

constexpr int kReplicates = 16;
constexpr int kDimensions = 4;
constexpr double kSmallAngle = 1e-4;  // steradians below which spherical trigonometry loses digits
// Within the same of a whole hemisphere it loses them, too; there a ray in any direction hits, but
// for one in 10^8.
constexpr double kWideAngle = 2 * std::numbers::pi - kSmallAngle;

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

/// Chooses one with probability weight / total, and stretches u over the chosen one's share.
template <class T, class Weight>
const T& choose(const std::vector<T>& all, const Weight& weight, double total, double* u) {
  double left = *u * total;
  std::size_t k = 0;
  while (k + 1 < all.size() && left >= weight(all[k])) left -= weight(all[k++]);
  *u = std::clamp(left / weight(all[k]), 0.0, 1.0);
  return all[k];
}

double area_of(const Triangle& t) {
  return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
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

/// A triangle as an eye sees it: corners less the eye, and their solid angle.
struct Seen {
  Triangle corner;
  Triangle direction;
  double angle;

  explicit Seen(const Triangle& less_eye)
      : corner(less_eye),
        direction{glm::normalize(corner[0]), glm::normalize(corner[1]), glm::normalize(corner[2])},
        angle(solid_angle(direction[0], direction[1], direction[2])) {}
};

/// Adds the triangle, in two parts where an edge passes so close to the eye that its ends lie in
/// opposite directions: they do not say which half of a circle the edge is, its nearest point does.
void add_seen(const Triangle& less_eye, std::vector<Seen>* seen) {
  constexpr double kOpposite = 1e-6;  // 1 + cosine: within 0.08 degrees
  const Seen whole(less_eye);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (glm::dot(whole.direction[k], whole.direction[next]) > kOpposite - 1) continue;
    const Vec3 &a = less_eye[k], &b = less_eye[next], &c = less_eye[(k + 2) % 3];
    const Vec3 nearest = a + (b - a) * (glm::dot(a, a - b) / glm::dot(b - a, b - a));
    if (nearest == a || nearest == b || nearest == Vec3(0)) break;  // no digits left between
    add_seen({a, nearest, c}, seen);
    add_seen({nearest, b, c}, seen);
    return;
  }
  seen->push_back(whole);
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

/// Triangles of what one polygon shows to the other.
struct Side {
  std::vector<Triangle> triangles;
  double area = 0;
  Vec3 normal{0};
};

struct Scene {
  Side from, to;
  std::vector<Blocker> blockers;

  bool blocked(const Vec3& a, const Vec3& b) const {
    return std::any_of(blockers.begin(), blockers.end(),
                       [&](const Blocker& x) { return x.hit(a, b); });
  }

  /// Whether a ray that leaves x by the cosine law gets there.
  bool seen_by_cosine(const Vec3& x, double u, double v) const {
    const Vec3 side = glm::normalize(from.triangles[0][1] - from.triangles[0][0]);
    const double angle = 2 * std::numbers::pi * u;
    const Vec3 d =
        std::sqrt(v) * (std::cos(angle) * side + std::sin(angle) * glm::cross(from.normal, side)) +
        std::sqrt(1 - v) * from.normal;
    const double slope = glm::dot(to.normal, d);
    if (!(slope < 0)) return false;
    const Vec3 y = x + d * (glm::dot(to.normal, to.triangles[0][0] - x) / slope);
    const auto holds = [&](const Triangle& t) {
      for (std::size_t k = 0; k < 3; ++k)
        if (glm::dot(to.normal, glm::cross(t[(k + 1) % 3] - t[k], y - t[k])) < 0) return false;
      return true;
    };
    return std::any_of(to.triangles.begin(), to.triangles.end(), holds) && !blocked(x, y);
  }

  /// One ray: its share of F, whose mean over the points of the unit cube is F from `from`.
  double sample(Point u, std::vector<Seen>* seen) const {
    const Triangle& start = choose(from.triangles, area_of, from.area, &u[0]);
    const Vec3 x = on_triangle(start, u[0], u[1]);
    double total = 0;
    seen->clear();
    for (const Triangle& t : to.triangles) add_seen({t[0] - x, t[1] - x, t[2] - x}, seen);
    for (const Seen& part : *seen) total += part.angle;
    if (!(total > 0)) return 0;
    if (total > kWideAngle) return seen_by_cosine(x, u[2], u[3]) ? 1 : 0;
    const Seen& aim = choose(
        *seen, [](const Seen& part) { return part.angle; }, total, &u[2]);
    Vec3 r;
    double share;
    if (aim.angle > kSmallAngle) {
      const auto& [a, b, c] = aim.direction;
      const Vec3 d = in_spherical_triangle(a, b, c, aim.angle, u[2], u[3]);
      r = d * (glm::dot(to.normal, aim.corner[0]) / glm::dot(to.normal, d));
      share = glm::dot(from.normal, d) * total;
    } else {
      r = on_triangle(aim.corner, u[2], u[3]);
      const double r2 = glm::dot(r, r);
      share = -glm::dot(from.normal, r) * glm::dot(to.normal, r) / r2 * (area_of(aim.corner) / r2) *
              (total / aim.angle);
    }
    if (!(share > 0) || blocked(x, x + r)) return 0;
    return share * std::numbers::inv_pi;
  }
};

/// The part in front of a plane; cut first, clipped then, so that no loop touches itself.
Side clipped_side(const Polygon& polygon, const Vec3& normal, const Moments& plane) {
  Side result;
  result.normal = normal;
  for (const Triangle& t : triangulate(polygon)) {
    const Loop loop = clip({{t[0], t[1], t[2]}, {}}, plane.centroid, plane.normal).outer;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      const Triangle piece = {loop[0], loop[k], loop[k + 1]};
      if (!(area_of(piece) > 0)) continue;
      result.triangles.push_back(piece);
      result.area += area_of(piece);
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
  Polygon first = standard_order(p);
  Polygon second = standard_order(q);
  const double area = moments(first).area;
  if (written_before(second, first)) std::swap(first, second);
  if (clip_to_front(first, second).empty()) return {0, 0};
  const Moments mp = moments(first);
  const Moments mq = moments(second);
  Scene scene;
  scene.from = clipped_side(first, mp.normal, mq);
  scene.to = clipped_side(second, mq.normal, mp);
  if (scene.from.triangles.empty() || scene.to.triangles.empty()) return {0, 0};
  // From the smaller one: most rays of a large polygon start where a small one is nearly nothing.
  if (scene.from.area > scene.to.area) std::swap(scene.from, scene.to);
  for (const Polygon& blocker : blockers) scene.blockers.emplace_back(blocker);

  const int replicates = static_cast<int>(std::min<std::int64_t>(kReplicates, samples));
  const std::int64_t rays = (samples + replicates - 1) / replicates;
  std::vector<Seen> seen;
  double sum = 0;
  double squares = 0;
  for (int r = 0; r < replicates; ++r) {
    Sequence sequence(&seed);
    double mean = 0;
    for (std::int64_t k = 0; k < rays; ++k) mean += scene.sample(sequence.next(), &seen);
    mean /= static_cast<double>(rays);
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / replicates;
  const double variance =
      std::max(0.0, squares / replicates - mean * mean) / std::max(1, replicates - 1);
  Estimate result{std::min(1.0, std::min(1.0, mean) * (scene.from.area / area))};
  if (replicates > 1 && mean > 0) result.relative_error = std::sqrt(variance) / mean;
  return result;
}

}  // namespace host
