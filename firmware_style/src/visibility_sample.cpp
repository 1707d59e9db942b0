#include "visibility_sample.hpp"

#include "urad/hemicube.hpp"
#include "urad/log2.hpp"
#include "urad/ratio.hpp"
#include "urad/vec.hpp"

namespace urad {

namespace {

/// Direction numbers of Sobol's sequence [Joe & Kuo 2008], computed at compile time.
struct Directions {
  uint32_t bit[4][16];
};

constexpr Directions make_directions() {
  constexpr int degree[4] = {0, 1, 2, 3}, inner[4] = {0, 0, 1, 1};
  constexpr uint32_t first[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 3, 0}, {1, 3, 1}};
  Directions d{};
  for (int k = 0; k < 16; ++k) d.bit[0][k] = uint32_t{1} << (31 - k);
  for (int n = 1; n < 4; ++n) {
    const int s = degree[n];
    for (int k = 0; k < 16; ++k) {
      if (k < s) {
        d.bit[n][k] = first[n][k] << (31 - k);
        continue;
      }
      d.bit[n][k] = d.bit[n][k - s] ^ d.bit[n][k - s] >> s;
      for (int m = 1; m < s; ++m) {
        if (inner[n] >> (s - 1 - m) & 1) d.bit[n][k] ^= d.bit[n][k - m];
      }
    }
  }
  return d;
}

constexpr Directions kDirections = make_directions();  // 256 bytes of ROM

/// x times a length, the sum of two of which stays below 2^62.
constexpr int64_t part_q31(uint32_t x_uq31, int32_t length) noexcept {
  return wide_mul(int32_t(x_uq31), length);
}

constexpr bool within(int32_t x, int32_t limit) noexcept { return x <= limit && x >= -limit; }

}  // namespace

Flat::Flat(const urad_point& normal_q30) noexcept {
  const uint32_t x = magnitude(normal_q30.x), y = magnitude(normal_q30.y),
                 z = magnitude(normal_q30.z);
  drop_ = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
}

urad_point Flat::join(int32_t u, int32_t v, int32_t dropped) const noexcept {
  if (drop_ == 0) return {dropped, u, v};
  if (drop_ == 1) return {u, dropped, v};
  return {u, v, dropped};
}

PatchSampler::PatchSampler(const urad_scene& scene, const Patch& patch) noexcept
    : scene_(scene),
      patch_(patch),
      flat_(patch.shape->normal_q30),
      kind_(Kind::any),
      origin_(patch_vertex(scene, patch, 0)),
      along_x_(patch_vertex(scene, patch, 1) - origin_),
      along_y_(patch_vertex(scene, patch, uint16_t(patch.vertex_count - 1)) - origin_) {
  if (patch.vertex_count == 3) kind_ = Kind::triangle;
  if (patch.vertex_count == 4) {
    // The fourth corner where a parallelogram has it, to the rounding of four vertices.
    const urad_point d = patch_vertex(scene, patch, 2) - origin_ - along_x_ - along_y_;
    if (within(d.x, 4) && within(d.y, 4) && within(d.z, 4)) kind_ = Kind::parallelogram;
  }
  if (kind_ != Kind::any) return;
  int32_t high_u = low_u_ = flat_.u(origin_), high_v = low_v_ = flat_.v(origin_);
  for (uint16_t k = 1; k < patch.vertex_count; ++k) {
    const urad_point p = patch_vertex(scene, patch, k);
    const int32_t u = flat_.u(p), v = flat_.v(p);
    low_u_ = u < low_u_ ? u : low_u_, high_u = u > high_u ? u : high_u;
    low_v_ = v < low_v_ ? v : low_v_, high_v = v > high_v ? v : high_v;
  }
  size_u_ = high_u - low_u_, size_v_ = high_v - low_v_;
  const urad_point& n = patch.shape->normal_q30;
  if (flat_.u(n) || flat_.v(n))
    inverse_steep_ = inverse(scaled(uint64_t{magnitude(flat_.dropped(n))}));
}

bool PatchSampler::inside(int32_t u, int32_t v) const noexcept {
  bool in = false;
  urad_point p = patch_vertex(scene_, patch_, uint16_t(patch_.vertex_count - 1));
  for (uint16_t k = 0; k < patch_.vertex_count; ++k) {
    const urad_point q = patch_vertex(scene_, patch_, k);
    const int32_t pu = flat_.u(p), pv = flat_.v(p), qu = flat_.u(q), qv = flat_.v(q);
    p = q;
    if ((pv > v) == (qv > v) || (u > pu && u > qu)) continue;
    if (u < pu && u < qu) {
      in = !in;
      continue;
    }
    const int64_t cross = wide_mul(qu - pu, v - pv) - wide_mul(qv - pv, u - pu);
    if (qv > pv ? cross > 0 : cross < 0) in = !in;
  }
  return in;
}

bool PatchSampler::point(uint32_t x_uq31, uint32_t y_uq31, urad_point* p) const noexcept {
  if (kind_ == Kind::any) {
    const int32_t u = low_u_ + int32_t(part_q31(x_uq31, size_u_) >> 31);
    const int32_t v = low_v_ + int32_t(part_q31(y_uq31, size_v_) >> 31);
    if (!inside(u, v)) return false;
    // On the plane: n.(p - origin) = 0, by the component of n that is at least 1/sqrt 3.
    int32_t dropped = flat_.dropped(origin_);
    if (inverse_steep_.mantissa) {
      const urad_point& n = patch_.shape->normal_q30;
      const int64_t rise = -(wide_mul(flat_.u(n), u - flat_.u(origin_)) +
                             wide_mul(flat_.v(n), v - flat_.v(origin_)));
      const auto d = int32_t(to_q(scaled(magnitude(rise)) * inverse_steep_, 0));
      dropped += (rise < 0) != (flat_.dropped(n) < 0) ? -d : d;
    }
    *p = flat_.join(u, v, dropped);
    return true;
  }
  if (kind_ == Kind::triangle && x_uq31 + y_uq31 > 0x7FFFFFFFu) {
    x_uq31 = 0x7FFFFFFFu - x_uq31;
    y_uq31 = 0x7FFFFFFFu - y_uq31;
  }
  const int32_t x_uq16 = int32_t(x_uq31 >> 15), y_uq16 = int32_t(y_uq31 >> 15);
  const auto at = [=](int32_t origin, int32_t a, int32_t b) {
    if (a) origin += mul_round(a, x_uq16, 16);
    if (b) origin += mul_round(b, y_uq16, 16);
    return origin;
  };
  *p = {at(origin_.x, along_x_.x, along_y_.x), at(origin_.y, along_x_.y, along_y_.y),
        at(origin_.z, along_x_.z, along_y_.z)};
  return true;
}

Sequence::Sequence(uint16_t i, uint16_t j) noexcept {
  uint32_t hash = uint32_t{i} << 16 | j;
  for (int d = 0; d < 4; ++d) {
    hash = (hash ^ hash >> 16) * 0x7FEB352Du;  // lowbias32 [Wellons]
    hash = (hash ^ hash >> 15) * 0x846CA68Bu;
    hash ^= hash >> 16;
    at_[d] = hash;
    hash += 0x9E3779B9u;
  }
}

void Sequence::advance() noexcept {
  ++count_;
  const int lowest = top_bit(count_ & (0u - count_)) & 15;
  for (int d = 0; d < 4; ++d) at_[d] ^= kDirections.bit[d][lowest];
}

namespace {

/// Direction by the cosine law about axis[2]: a point of the unit disc, raised. False for the
/// corners beside the disc.
bool cosine_direction(const HemicubeFrame& frame, uint32_t x_uq31, uint32_t y_uq31,
                      urad_point* d_q30) noexcept {
  const int64_t x = int64_t{x_uq31} - (1 << 30), y = int64_t{y_uq31} - (1 << 30);
  const int64_t z2_q60 = (int64_t{1} << 60) - x * x - y * y;
  if (z2_q60 <= 0) return false;
  const int64_t z = exp2_uq(shift_down(log2_q24(uint64_t(z2_q60)), 1), 0);
  const auto along = [=](int32_t a, int32_t b, int32_t c) {
    return int32_t(round_shift(x * a + y * b + z * c, 30));
  };
  const urad_point* axis = frame.axis;
  *d_q30 = {along(axis[0].x, axis[1].x, axis[2].x), along(axis[0].y, axis[1].y, axis[2].y),
            along(axis[0].z, axis[1].z, axis[2].z)};
  return true;
}

/// Where the ray meets the lit side of the plane of `to`. False when it does not, or outside the
/// scene.
bool meet(const Patch& to, const urad_point& x, const urad_point& d_q30, urad_point* hit) noexcept {
  const int64_t height_q30 = dot(to.shape->normal_q30, x - to.centroid);
  const int64_t fall_q30 = -round_shift(dot(to.shape->normal_q30, d_q30), 30);
  if (height_q30 <= 0 || fall_q30 <= 0) return false;
  const int64_t distance = ratio_q(height_q30, fall_q30, 0);
  if (distance > INT32_MAX) return false;
  const auto at = [=](int32_t origin, int32_t d) { return origin + round_shift(distance * d, 30); };
  const int64_t u = at(x.x, d_q30.x), v = at(x.y, d_q30.y), w = at(x.z, d_q30.z);
  const auto within_scene = [](int64_t c) { return magnitude(c) <= uint64_t{URAD_COORDINATE_MAX}; };
  if (!within_scene(u) || !within_scene(v) || !within_scene(w)) return false;
  *hit = {int32_t(u), int32_t(v), int32_t(w)};
  return true;
}

}  // namespace

NearRays near_rays(const Patch& from, const PatchSampler& on_from, const Patch& to,
                   const PatchSampler& on_to, uint64_t distance2, int tries, Sequence* sequence,
                   Stop stop, void* context) noexcept {
  const HemicubeFrame frame = hemicube_frame(from.shape->normal_q30, 0, false);
  NearRays rays;
  for (int n = 0; n < tries; ++n) {
    urad_point x, d_q30, hit;
    sequence->advance();
    if (!on_from.point(sequence->uq31(0), sequence->uq31(1), &x)) continue;
    if (!cosine_direction(frame, sequence->uq31(2), sequence->uq31(3), &d_q30)) continue;
    ++rays.sent;
    if (!meet(to, x, d_q30, &hit)) continue;
    const urad_point r = hit - x;
    if (uint64_t(dot(r, r)) < distance2 && on_to.holds(hit))
      ++(stop(context, x, hit) ? rays.shut : rays.open);
  }
  return rays;
}

}  // namespace urad
