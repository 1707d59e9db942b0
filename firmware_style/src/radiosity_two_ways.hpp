// radiosity_two_ways.hpp -- overshooting after a change that makes as much darker as brighter.
#pragma once
#include "radiosity_power.hpp"

namespace urad {

// A light that moves takes about as much away as it brings, and little of that is left in the mean
// of the scene: what comes back to a patch is its neighbourhood's. It is taken for up to kNearbyMost
// times the share of the mean, as often as |unshot| is the sum; with all bounces for no more than
// kTwoWaysGainMost. Measured on strips and patches of light that move in five scenes, at
// reflectances up to 0.99.
inline constexpr uint32_t kNearbyMost_uq16 = 5u << 15;
inline constexpr uint32_t kTwoWaysGainMost_uq16 = 5u << 16;

/// |unshot| of the channels as wholes.
inline uint64_t one_way(const urad_radiosity& s) noexcept {
  uint64_t sum = 0;
  for (int c = 0; c < 3; ++c) sum += magnitude(s.ledger.unshot[c]);
  return sum;
}

/// What the means of the channels will make of themselves is less than |unshot|: its pattern counts.
inline bool mostly_nearby(const urad_radiosity& s) noexcept {
  if (!(s.flags & kTwoWays)) return false;
  uint64_t ambient = 0;
  for (int c = 0; c < 3; ++c) {
    const uint32_t gain = gain_uq16(effective_reflectance_uq16(s, c));
    ambient += (magnitude(s.ledger.unshot[c]) >> 8) * (gain >> 8);
  }
  return ambient < s.remaining;
}

/// What is then taken for the gain of all bounces.
inline uint32_t two_ways_gain_uq16(const urad_radiosity& s, uint32_t gain) noexcept {
  const uint64_t mean = one_way(s);
  uint32_t times_uq16 = s.remaining > mean ? kNearbyMost_uq16 : 65536;
  if (s.remaining > mean && s.remaining < 4 * mean) {
    const uint32_t ratio_uq16 = exp2_uq(log2_q24(s.remaining) - log2_q24(mean), 16);
    if (ratio_uq16 < times_uq16) times_uq16 = ratio_uq16;
  }
  uint64_t more = wide_umul(gain, times_uq16) >> 16;
  if (more > kTwoWaysGainMost_uq16) more = kTwoWaysGainMost_uq16;
  return more > gain || mostly_nearby(s) ? uint32_t(more) : gain;
}

}  // namespace urad
