// visibility_rays.hpp -- sums of what rays bring, for fixed and adaptive numbers of rays.
#pragma once
#include "urad/log2.hpp"
#include "urad/ratio.hpp"
#include "urad/vec.hpp"
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
    const uint32_t part_uq16 = uint32_t(round_shift(part_uq24, 8));  // a half at most
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

/// Whether both ends of r look at each other: weight_of() is above 0.
bool faces(const urad_shape& i, const urad_shape& j, const urad_point& r) noexcept;

/// Where patches may touch: rho above this. Weights of points there are as great as they like.
inline constexpr uint32_t kTouching_uq16 = 4096;

/// What rays between two patches are to bring.
struct RayPlan {
  const Patch &i, &j;
  Candidates* candidates;
  urad_counters* counters;
  bool turned;     ///< i is the receiver of the run
  bool weighted;   ///< by cos cos / r^2
  uint64_t near2;  ///< square of the distance below which weights are left out of the sums
  int wanted, tries;
};

/// What they brought.
struct Brought {
  Sums sums;  ///< empty where the rays agree, unless asked for
  int tried = 0, made = 0, weighed = 0;
  bool agree = true, open = false;  ///< all that were weighed got through, or none did
};

/// The answer of a pair whose rays agree.
uint32_t agreed_uq16(const RayPlan& plan, const urad_scene& scene, const Brought& brought) noexcept;

/// Makes rays until as many are weighed as are wanted. make(sequence, &a, &b): false where there is no
/// point. Weights matter only where rays disagree: those before the first that does are then made
/// once more. sums_too: all are weighed at once.
template <class Make>
Brought bring(const RayPlan& plan, bool sums_too, Sequence* sequence, Make make) noexcept {
  const Sequence start = *sequence;
  Brought brought;
  const auto add = [&](const urad_point& r, bool open) {
    Scaled weight = weight_of(*plan.i.shape, *plan.j.shape, r);
    if (weight.mantissa == 0) return false;
    if (!plan.weighted) weight = {0x80000000u, 0};
    brought.sums.add(weight, open, plan.near2 && uint64_t(dot(r, r)) < plan.near2);
    return true;
  };
  urad_point r;
  bool open = false;
  const auto next = [&] {
    urad_point a, b;
    ++brought.tried;
    sequence->advance();
    if (!make(sequence, &a, &b)) return false;
    ++brought.made;
    r = b - a;
    if (!faces(*plan.i.shape, *plan.j.shape, r)) return false;
    open = !plan.candidates->stop(a, b, plan.turned, plan.counters);
    ++brought.weighed;
    return true;
  };
  const auto more = [&] { return brought.weighed < plan.wanted && brought.tried < plan.tries; };
  while (brought.agree && more()) {
    if (!next()) continue;
    if (brought.weighed == 1) brought.open = open;
    brought.agree = open == brought.open;
    if (sums_too) add(r, open);
  }
  if (brought.agree) return brought;
  Sequence again = start;
  for (int left = sums_too ? 0 : brought.weighed - 1; left > 0;) {
    urad_point a, b;
    again.advance();
    if (make(&again, &a, &b)) left -= add(b - a, brought.open);
  }
  if (!sums_too) add(r, open);
  while (more()) {
    if (next()) add(r, open);
  }
  return brought;
}

/// log2 of tr M_i + tr M_j.
int32_t log2_spread_sum_q24(const Patch& i, const Patch& j) noexcept;

}  // namespace urad
