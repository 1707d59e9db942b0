#include "lambert_point.hpp"

#include "lambert_vector.hpp"
#include "urad/angle.hpp"
#include "urad/lambert.hpp"

namespace urad {

namespace {

constexpr uint32_t kInverse2Pi_uq32 = uint32_t(4294967296.0 / (2 * table::kPi) + 0.5);

/// n . unit(b x a) times the angle between a and b, Q30. A patch runs clockwise as seen from a
/// point on its lit side. An edge seen end-on spans no angle, and a point on the edge has no
/// direction.
int64_t edge_term_q30(const urad_point& a, const urad_point& b, const urad_point& n_q30) noexcept {
  const LongVector c = cross(b, a);
  const uint64_t c2 = square(c.direction);
  if (c2 == 0) return 0;
  const InverseRoot root = inverse_root(c2);
  const auto rise = int32_t(round_shift(sparse_dot(n_q30, c.direction), 30));
  const auto cosine_q30 =
      int32_t(round_shift(int64_t(wide_umul(magnitude(rise), root.mantissa_uq30)), root.half));
  const auto length = int64_t(wide_umul(uint32_t(c2 >> 30), root.mantissa_uq30) >> root.half);
  const int64_t across = c.exponent >= 0 ? length * (int64_t{1} << c.exponent)
                                         : round_shift(length, -c.exponent);  // by 29 at most
  const int64_t term_q30 = round_shift(wide_mul(cosine_q30, angle_q29(dot(a, b), across)), 29);
  return rise < 0 ? -term_q30 : term_q30;
}

}  // namespace

uint32_t lambert_sum_uq30(const urad_point& x, const urad_point& normal_q30,
                          const Outline& outline) noexcept {
  int64_t sum_q30 = 0;
  outline.for_each_edge([&](const urad_point& a, const urad_point& b) {
    sum_q30 += edge_term_q30(a - x, b - x, normal_q30);
  });
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
