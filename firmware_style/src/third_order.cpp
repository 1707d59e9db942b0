#include "urad/third_order.hpp"

#include "cheapest_traits.hpp"
#include "urad/vec.hpp"

namespace urad {

namespace {

constexpr int kArmBits = 12;

/// A corner from the centroid, in units of the patch's own.
struct Arm {
  int32_t x, y, z;
};

constexpr int32_t dot(const Arm& a, const Arm& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

constexpr Arm operator+(const Arm& a, const Arm& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

uint32_t extent(const urad_point& r) noexcept {
  return magnitude(r.x) | magnitude(r.y) | magnitude(r.z);
}

/// r / 2^down.
Arm scaled(const urad_point& r, int down) noexcept {
  const auto move = [=](int32_t x) {
    return down > 0 ? round_shift(x, down) : x * (int32_t{1} << -down);
  };
  return {move(r.x), move(r.y), move(r.z)};
}

Arm unit_q15(const urad_point& n_q30) noexcept { return scaled(n_q30, 15); }

/// w, Q15: r in 15 bits times 1/R, the product below 2^30.
Arm direction_q15(const urad_point& r, int32_t log2_distance_q24) noexcept {
  const int down = top_bit(extent(r)) - 14;
  const Arm r15 = scaled(r, down);
  const int32_t inverse_uq15 = int32_t(exp2_uq(down * (1 << 24) - log2_distance_q24, 30));
  const auto along = [=](int32_t x) { return round_shift(x * inverse_uq15, 15); };
  return {along(r15.x), along(r15.y), along(r15.z)};
}

/// The halves of P: a (8 a^2 - 3 |u|^2) and b (6 a^2 - |u|^2), over 2^14; or sums of them.
struct Cubics {
  int64_t along = 0, across = 0;
};

/// What the other patch is to this one.
class View {
 public:
  View(const Arm& w_q15, const Arm& m_q15) noexcept : w_q15_(w_q15), m_q15_(m_q15) {}

  struct Cubic {
    int32_t along, across;
  };
  Cubic operator()(const Arm& u) const noexcept {
    const int32_t a = round_shift(dot(u, w_q15_), 15), b = round_shift(dot(u, m_q15_), 15);
    const int32_t square = dot(u, u), a2 = a * a;
    return {a * round_shift(8 * a2 - 3 * square, 14), b * round_shift(6 * a2 - square, 14)};
  }

 private:
  Arm w_q15_, m_q15_;
};

/// The corners of a patch from its centroid.
class Corners {
 public:
  Corners(const urad_scene& scene, const Patch& patch) noexcept : scene_(scene), patch_(patch) {
    uint32_t most = 0;
    for (uint16_t k = 0; k < patch.vertex_count; ++k) most |= extent(arm(k));
    down_ = top_bit(most) + 1 - kArmBits;
  }
  Arm operator[](int k) const noexcept { return scaled(arm(uint16_t(k)), down_); }
  int down() const noexcept { return down_; }

 private:
  urad_point arm(uint16_t k) const noexcept {
    return patch_vertex(scene_, patch_, k) - patch_.centroid;
  }
  const urad_scene& scene_;
  const Patch& patch_;
  int down_;
};

/// The sum over the corners of a triangle.
Cubics triangle(const Corners& corners, const View& view) noexcept {
  Cubics sum;
  for (int k = 0; k < 3; ++k) {
    const View::Cubic at = view(corners[k]);
    sum.along += at.along, sum.across += at.across;
  }
  return sum;
}

/// Twice the area of 0, a, b, along the axis that n is nearest to.
int32_t cross(const Arm& a, const Arm& b, const urad_point& n) noexcept {
  const uint32_t x = magnitude(n.x), y = magnitude(n.y), z = magnitude(n.z);
  const auto of = [](int32_t c, int32_t area) { return c < 0 ? -area : area; };
  if (x >= y && x >= z) return of(n.x, a.y * b.z - a.z * b.y);
  if (y >= z) return of(n.y, a.z * b.x - a.x * b.z);
  return of(n.z, a.x * b.y - a.y * b.x);
}

/// The sum over the edges of a polygon, weighted by areas, and the sum of those.
Cubics fan(const Corners& corners, const View& view, const Patch& patch, int64_t* area) noexcept {
  Cubics sum;
  Arm u = corners[patch.vertex_count - 1];
  View::Cubic at_u = view(u);
  for (int k = 0; k < patch.vertex_count; ++k) {
    const Arm v = corners[k];
    const View::Cubic at_v = view(v), at_both = view(u + v);
    const int32_t weight = cross(u, v, patch.shape->normal_q30);
    const auto edge = [](int32_t x, int32_t y, int32_t both) {
      return x + y + round_shift(both, 1);
    };
    sum.along += wide_mul(weight, edge(at_u.along, at_v.along, at_both.along));
    sum.across += wide_mul(weight, edge(at_u.across, at_v.across, at_both.across));
    *area += weight;
    u = v, at_u = at_v;
  }
  return sum;
}

/// x 2^scale, limited.
int32_t term_q22(int64_t x, int64_t log2_scale_q24) noexcept {
  constexpr int32_t least_q24 = -24 * (1 << 24);
  if (x == 0) return 0;
  const int64_t log2_q24 = urad::log2_q24(magnitude(x)) + log2_scale_q24;
  if (log2_q24 < least_q24) return 0;
  const uint32_t limit = uint32_t(kThirdLimit_q22);
  const uint32_t size = log2_q24 > (1 << 24) ? limit : exp2_uq(int32_t(log2_q24), 22);
  return x < 0 ? -int32_t(size) : int32_t(size);
}

/// The part of T3 that belongs to one patch.
ThirdOrder third_of(const urad_scene& scene, const Patch& patch, const View& view,
                    const PairSide& side, int32_t log2_distance_q24) noexcept {
  constexpr int32_t log2_15_q24 = 65546747;
  if (is_parallelogram(scene, patch)) return {0, 0};
  const Corners corners(scene, patch);
  const bool is_triangle = patch.vertex_count == 3;
  int64_t area = 0;
  const Cubics sum = is_triangle ? triangle(corners, view) : fan(corners, view, patch, &area);
  if (is_triangle) area = 2;
  const auto cubics = uint16_t(patch.vertex_count * (is_triangle ? 1 : 2));
  if (area <= 0) return {0, cubics};
  // 2^14 of P's own units, 4 and 2 from its two terms; m.w is negative on either side.
  const int64_t log2_unit_q24 = int64_t{corners.down()} * (1 << 24) - log2_distance_q24;
  const int64_t log2_scale_q24 =
      3 * log2_unit_q24 - log2_15_q24 - log2_q24(uint64_t(area)) + (14 << 24);
  return {term_q22(sum.along, log2_scale_q24 + (2 << 24)) +
              term_q22(sum.across, log2_scale_q24 + (1 << 24) - side.log2_cosine_other_q24),
          cubics};
}

}  // namespace

ThirdOrder third_order(const urad_scene& scene, const Patch& i, const Patch& j,
                       const PairKernel& kernel) noexcept {
  const int32_t log2_r_q24 = log2_distance_q24(kernel.side[0]);
  const Arm w = direction_q15(j.centroid - i.centroid, log2_r_q24), back{-w.x, -w.y, -w.z};
  const ThirdOrder of_i =
      third_of(scene, i, View(w, unit_q15(j.shape->normal_q30)), kernel.side[0], log2_r_q24);
  const ThirdOrder of_j =
      third_of(scene, j, View(back, unit_q15(i.shape->normal_q30)), kernel.side[1], log2_r_q24);
  return {of_i.t3_q22 + of_j.t3_q22, uint16_t(of_i.cubics + of_j.cubics)};
}

}  // namespace urad
