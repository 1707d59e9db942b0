// visibility_rays.hpp -- sums of what rays bring, for fixed and adaptive numbers of rays.
#pragma once
#include "urad/log2.hpp"
#include "urad/ratio.hpp"
#include "urad/visibility.hpp"
#include "visibility_candidates.hpp"
#include "visibility_sample.hpp"

namespace urad {

inline constexpr int32_t kNoHit = INT32_MIN;
// Logs of near weights are this much less, which keeps them in 32 bits.
inline constexpr int kNearBits = 20;

/// Sums of weights of any size: 64 bits over the exponent of the greatest so far.
class Sums {
 public:
  void add(const Scaled& weight, bool open, bool near) noexcept {
    if (weight.mantissa == 0) return;
    ++(open ? open_count_ : shut_count_);
    if (near) return;
    raise(weight.exponent);
    const int down = exponent_ - weight.exponent;
    (open ? open_ : shut_) += down < 32 ? weight.mantissa >> down : 0;
  }

  /// What open or shut rays brought together.
  Scaled total(bool open) const noexcept {
    const Scaled sum = scaled(open ? open_ : shut_);
    return {sum.mantissa, sum.exponent + exponent_};
  }

  bool all_open() const noexcept { return shut_count_ == 0; }
  bool all_shut() const noexcept { return open_count_ == 0; }
  bool none() const noexcept { return open_count_ + shut_count_ == 0; }

  /// Adds what near weights come to by other means, log2 in Q7.24 less kNearBits, or kNoHit.
  void add_near(int32_t log2_open_q24, int32_t log2_shut_q24) noexcept {
    const auto weight = [this](int32_t log2_q24) {
      return log2_q24 == kNoHit ? 0 : uint64_t{exp2_uq(log2_q24, kNearBits - exponent_ - 12)} << 12;
    };
    const int32_t most_q24 = log2_open_q24 < log2_shut_q24 ? log2_shut_q24 : log2_open_q24;
    if (most_q24 == kNoHit) return;
    raise(int(shift_down(most_q24, 24)) + kNearBits - 43);
    open_ += weight(log2_open_q24);
    shut_ += weight(log2_shut_q24);
  }

  /// The lesser of open and shut over all weights.
  uint32_t fraction_uq16() const noexcept {
    const uint64_t lesser = open_ < shut_ ? open_ : shut_, all = open_ + shut_;
    const int64_t part_uq24 = all ? ratio_q(int64_t(lesser), int64_t(all), 24) : 0;
    const uint32_t part_uq16 =
        part_uq24 < 1 << 24 ? uint32_t(round_shift(part_uq24, 8)) : kAllVisible_uq16;
    const uint32_t f_uq16 = open_ < shut_ ? part_uq16 : kAllVisible_uq16 - part_uq16;
    return f_uq16 < 1 ? 1 : f_uq16 >= kAllVisible_uq16 ? kAllVisible_uq16 - 1 : f_uq16;
  }

 private:
  /// Sums in units of 2^exponent at least.
  void raise(int exponent) noexcept {
    if (open_ + shut_ == 0) exponent_ = exponent;
    if (exponent <= exponent_) return;
    const int up = exponent - exponent_ < 63 ? exponent - exponent_ : 63;
    open_ >>= up, shut_ >>= up;
    exponent_ = exponent;
  }

  uint64_t open_ = 0, shut_ = 0;  // but for near weights
  int exponent_ = 0;
  uint32_t open_count_ = 0, shut_count_ = 0;
};

/// The answer of a pair that needs no ray, counted as so many rays spared; kAskRays when it needs them.
inline constexpr uint32_t kAskRays = ~0u;
uint32_t without_rays(const Candidates& candidates, uint32_t rays,
                      urad_counters* counters) noexcept;

/// The answer of a pair of which no ray could be made: nothing is seen where a blocker may stand between.
uint32_t without_a_ray(const urad_scene& scene, const Patch& i, const Patch& j) noexcept;

/// cos cos / r^2 times 2^60: (n_i . r)(-n_j . r) / r^4, to 2^-13. Nothing when one end looks away.
Scaled weight_of(const urad_shape& i, const urad_shape& j, const urad_point& r) noexcept;

/// Where patches may touch: rho above this. Weights of points there are as great as they like.
inline constexpr uint32_t kTouching_uq16 = 4096;

/// log2 of tr M_i + tr M_j.
int32_t log2_spread_sum_q24(const Patch& i, const Patch& j) noexcept;

}  // namespace urad
