#include "lambert_point.hpp"

#include "lambert_vector.hpp"
#include "urad/angle.hpp"
#include "urad/lambert.hpp"

namespace urad {

namespace {

constexpr uint32_t kInverse2Pi_uq32 = uint32_t(4294967296.0 / (2 * table::kPi) + 0.5);

/// An edge seen from a point: n . unit(b x a), and the two sides of the angle between a and b. A patch
/// runs clockwise as seen from a point on its lit side. An edge seen end-on spans no angle, and a
/// point on the edge has no direction: both are 0.
struct SeenEdge {
  int32_t cosine_q30;
  int64_t along, across;
};

SeenEdge seen_edge(const urad_point& a, const urad_point& b, const urad_point& n_q30) noexcept {
  const LongVector c = cross(b, a);
  const uint64_t c2 = square(c.direction);
  if (c2 == 0) return {0, 0, 0};
  const InverseRoot root = inverse_root(c2);
  const auto rise = int32_t(round_shift(sparse_dot(n_q30, c.direction), 30));
  const auto cosine_q30 =
      int32_t(round_shift(int64_t(wide_umul(magnitude(rise), root.mantissa_uq30)), root.half));
  const auto length = int64_t(wide_umul(uint32_t(c2 >> 30), root.mantissa_uq30) >> root.half);
  const int64_t across = c.exponent >= 0 ? length * (int64_t{1} << c.exponent)
                                         : round_shift(length, -c.exponent);  // by 29 at most
  return {rise < 0 ? -cosine_q30 : cosine_q30, dot(a, b), across};
}

/// Edges whose terms are worked out together. A term is one long chain of products; where the
/// processor can, it goes on with the next edge while it waits.
constexpr int kEdgesAtOnce = kWideRegisters ? 4 : 1;

/// Sum of n . unit(b x a) times the angle between a and b.
class EdgeSum {
 public:
  explicit EdgeSum(const urad_point& n_q30) noexcept : n_q30_(n_q30) {}

  void add(const urad_point& a, const urad_point& b) noexcept {
    edge_[count_] = seen_edge(a, b, n_q30_);
    if (++count_ == kEdgesAtOnce) add_terms();
  }
  int64_t sum_q30() noexcept {
    add_terms();
    return sum_q30_;
  }

 private:
  void add_terms() noexcept {
    Tangent seen[kEdgesAtOnce];
    for (int k = 0; k < count_; ++k) seen[k] = tangent(edge_[k].along, edge_[k].across);
    for (int k = 0; k < count_; ++k)
      sum_q30_ += round_shift(wide_mul(edge_[k].cosine_q30, angle_q29(seen[k])), 29);
    count_ = 0;
  }

  const urad_point& n_q30_;
  SeenEdge edge_[kEdgesAtOnce];
  int count_ = 0;
  int64_t sum_q30_ = 0;
};

}  // namespace

uint32_t lambert_sum_uq30(const urad_point& x, const urad_point& normal_q30,
                          const Outline& outline) noexcept {
  EdgeSum sum(normal_q30);
  outline.for_each_edge([&](const urad_point& a, const urad_point& b) { sum.add(a - x, b - x); });
  const int64_t sum_q30 = sum.sum_q30();
  if (sum_q30 <= 0) return 0;
  const uint64_t f_uq30 = (uint64_t(sum_q30) * kInverse2Pi_uq32) >> 32;
  return f_uq30 > (1u << 30) ? 1u << 30 : uint32_t(f_uq30);
}

int frame_shift(const urad_scene& scene, const Patch& patch, const urad_point& origin) noexcept {
  uint32_t extent = 0;
  for (uint16_t k = 0; k < patch.vertex_count; ++k) {
    const urad_point d = patch_vertex(scene, patch, k) - origin;
    extent |= magnitude(d.x) | magnitude(d.y) | magnitude(d.z);
  }
  return 28 - top_bit(extent);
}

uint32_t point_factor_uq30(const urad_scene& scene, const urad_point& x,
                           const urad_point& normal_q30, const Patch& polygon) noexcept {
  if (dot(polygon.shape->normal_q30, x - polygon.centroid) <= 0) return 0;
  const Frame frame{x, frame_shift(scene, polygon, x)};
  const Plane horizon{normal_q30, {0, 0, 0}};
  return lambert_sum_uq30({0, 0, 0}, normal_q30, Outline(scene, polygon, frame, &horizon));
}

}  // namespace urad
