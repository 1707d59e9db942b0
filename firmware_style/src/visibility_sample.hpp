// visibility_sample.hpp -- points on a patch from numbers in [0, 1), and where the numbers come
// from.
#pragma once
#include "urad/patch.hpp"
#include "urad/ratio.hpp"

namespace urad {

/// The two axes that a plane lies along most.
class Flat {
 public:
  explicit Flat(const urad_point& normal_q30) noexcept;
  int32_t u(const urad_point& p) const noexcept { return drop_ == 0 ? p.y : p.x; }
  int32_t v(const urad_point& p) const noexcept { return drop_ == 2 ? p.y : p.z; }
  int32_t dropped(const urad_point& p) const noexcept {
    return drop_ == 0 ? p.x : drop_ == 1 ? p.y : p.z;
  }
  urad_point join(int32_t u, int32_t v, int32_t dropped) const noexcept;
  /// u, v and the dropped axis make a left-handed frame.
  bool is_mirror() const noexcept { return drop_ == 1; }

 private:
  int drop_;
};

/// Uniform points on a patch: affine on parallelograms, folded on triangles, by rejection from the
/// box around any other.
class PatchSampler {
 public:
  PatchSampler(const urad_scene& scene, const Patch& patch) noexcept;
  /// False when (x, y) falls beside the polygon. Never on parallelograms and triangles.
  bool point(uint32_t x_uq31, uint32_t y_uq31, urad_point* p) const noexcept;
  /// Whether a point of the plane, given by all its coordinates, lies in the polygon.
  bool holds(const urad_point& p) const noexcept { return inside(flat_.u(p), flat_.v(p)); }

 private:
  enum class Kind : uint8_t { parallelogram, triangle, any };
  bool inside(int32_t u, int32_t v) const noexcept;

  const urad_scene& scene_;
  const Patch& patch_;
  Flat flat_;
  Kind kind_;
  urad_point origin_, along_x_, along_y_;  // any: origin_ the first vertex
  int32_t low_u_ = 0, low_v_ = 0, size_u_ = 0, size_v_ = 0;
  Scaled inverse_steep_{0, 0};  // 1 / the dropped component of the normal; 0: the others are 0
};

/// Sobol's sequence in four dimensions, 2^16 points, moved by an offset (exclusive or) that belongs
/// to the pair, so that the errors of different pairs are independent. Over offsets its rms error
/// on rooms is half that of additive sequences.
class Sequence {
 public:
  Sequence(uint16_t i, uint16_t j) noexcept;
  void advance() noexcept;
  uint32_t uq31(int dimension) const noexcept { return at_[dimension] >> 1; }

 private:
  uint32_t at_[4];
  uint32_t count_ = 0;
};

/// Rays that leave a patch by the cosine law (Malley): of `sent`, these meet the other patch near by.
struct NearRays {
  uint32_t sent = 0, open = 0, shut = 0;
};

/// Whether something stands between a and b; context is the caller's.
using Stop = bool (*)(void* context, const urad_point& a, const urad_point& b);

/// The part of a form factor that goes less than the square root of `distance2` far, by `tries` rays
/// from `from` that are looked for on `to`.
NearRays near_rays(const Patch& from, const PatchSampler& on_from, const Patch& to,
                   const PatchSampler& on_to, uint64_t distance2, int tries, Sequence* sequence,
                   Stop stop, void* context) noexcept;

}  // namespace urad
