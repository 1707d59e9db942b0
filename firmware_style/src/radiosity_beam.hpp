// radiosity_beam.hpp -- the inner loops of a shot: sums of factors, and power on its way to a
// surface.
#pragma once
#include "urad/q.hpp"

namespace urad {

constexpr uint32_t kRounded = 8;  // shots of fewer power units are cut, not rounded

/// The power of one shot in one channel: negative ? -p : p, p = mantissa * 2^exponent.
struct Beam {
  uint32_t mantissa;  // below 2^15
  int exponent;       // 0 .. 15
  bool negative;
  int64_t reflected;  // sum of what receivers got, as a magnitude
};

/// What one channel of a beam is to a surface: received times reflectance = F * mantissa / 2^16 /
/// 2^shift.
struct Reflection {
  uint32_t mantissa;  // at most 2^15
  uint32_t shift;     // 0 .. 31
  uint32_t sum;       // F * mantissa / 2^16 over the receivers so far
};

inline Beam beam_of(int32_t power) noexcept {
  const uint32_t p = magnitude(power);
  const int leading = top_bit(p) - 14, exponent = leading > 0 ? leading : 0;
  return {p >> exponent, exponent, power < 0, 0};
}

/// Both roundings are to either side by chance, in proportion: over many shots none has a bias, for
/// no receiver. Chance: fractions of shots times the golden ratio, spread evenly however few shots
/// share a rounding error.
inline Reflection reflection_of(const Beam& beam, uint16_t reflectance_uq15, uint32_t shots,
                                uint32_t receivers) noexcept {
  const uint32_t product = beam.mantissa * reflectance_uq15, chance = shots * 0x9E3779B9u;
  const int leading = top_bit(product) - 14, cut = leading > 0 ? leading : 0;
  // Receivers lose half a unit of the sum each: given back in proportion, but nothing is made of a
  // mirror's light.
  const uint32_t step = uint32_t{1} << cut, lost = (receivers << cut) >> 17;
  const uint32_t dither = (cut ? chance >> (32 - cut) : 0) + lost;
  // Were the last, tiny shots rounded too, their light would go round for ever.
  const uint32_t shift = uint32_t(31 - beam.exponent - cut);
  const uint32_t start = shift < 31 ? (chance * 5) >> (32 - shift) : uint32_t{1} << 30;
  return {(product + (dither < step ? dither : step - 1)) >> cut, shift,
          beam.mantissa >= kRounded ? start : 0};
}

/// Adds (or takes away) F * reflection in one channel of `count` receivers; returns the sum. The
/// inner loop of the solver: whole units are differences of a running sum, so that rests carry on.
///
/// No overflow: rows sum to less than 1.5 and the mantissa is at most 2^15, so that F * mantissa /
/// 2^16 adds up to less than 1.5 * 2^31, and what the sum starts with is at most 2^30. Powers are
/// seen as unsigned because the difference is taken in two steps, the first of which may wrap.
template <bool kNegative>
[[gnu::noinline]] uint32_t reflect(const uint32_t* f_uq32, uint32_t count, int32_t* unshot,
                                   Reflection* to) noexcept {
  const uint32_t m = to->mantissa, shift = to->shift, first = to->sum >> shift;
  uint32_t* power = reinterpret_cast<uint32_t*>(unshot);
  const uint32_t* const end = power + 3 * count;
  uint32_t sum = to->sum, units = first;
  const auto receive = [&](uint32_t f, uint32_t* to_power) {
    const uint32_t high = f >> 16, low = f & 0xFFFFu;
    sum += ((low * m) >> 16) + high * m;
    const uint32_t before = units;
    units = sum >> shift;
    *to_power = kNegative ? *to_power + before - units : *to_power + units - before;
  };
  if (count & 1u) {
    receive(*f_uq32++, power);
    power += 3;
  }
  for (; power != end; power += 6, f_uq32 += 2) {  // two at a time: a third of a loop is its ends
    receive(f_uq32[0], power);
    receive(f_uq32[1], power + 3);
  }
  to->sum = sum;
  return units - first;
}

/// A sum of up to 65,535 32-bit numbers without a carry to follow: of their high halves, and of all
/// of them modulo 2^32. What the low halves add to stays below 2^32.
struct WideSum {
  uint32_t all = 0, high = 0;
  [[gnu::always_inline]] void add(uint32_t x) noexcept {
    all += x;
    high += x >> 16;
  }
  uint64_t value() const noexcept { return (uint64_t{high} << 16) + (all - (high << 16)); }
};

[[gnu::noinline]] inline uint64_t sum_run(const uint32_t* f_uq32, uint32_t count) noexcept {
  WideSum sum;
  const uint32_t* const end = f_uq32 + count;
  if (count & 1u) sum.add(*f_uq32++);
  for (; f_uq32 != end; f_uq32 += 2) {
    sum.add(f_uq32[0]);
    sum.add(f_uq32[1]);
  }
  return sum.value();
}

/// Lets through what is left of a row, in the order of the patches.
inline void cut_run(uint32_t* f_uq32, uint32_t count, uint64_t left_uq32) noexcept {
  for (uint32_t k = 0; k < count; ++k) {
    if (f_uq32[k] > left_uq32) f_uq32[k] = uint32_t(left_uq32);
    left_uq32 -= f_uq32[k];
  }
}

}  // namespace urad
