// visibility_sample.hpp -- points on a patch from numbers in [0, 1), and where the numbers come
// from.
#pragma once
#include "urad/patch.hpp"

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

/// The part of a form factor that goes less than the square root of `distance2` far, by `tries`
/// rays that leave `from` by the cosine law (Malley) and are looked for on `to`; blockers are
/// ignored. log2 F in Q7.24, or kNoHit.
inline constexpr int32_t kNoHit = INT32_MIN;
int32_t log2_factor_by_rays_q24(const Patch& from, const PatchSampler& on_from, const Patch& to,
                                const PatchSampler& on_to, uint64_t distance2, int tries,
                                Sequence* sequence) noexcept;

}  // namespace urad
