// The engine's fixed-point functions (q.hpp, log2.hpp, sigmoid.hpp) for many numbers at once: the same bits in every lane.
// Included once per instruction set by Highway's foreach_target, hence no include guard of the usual kind.
#if defined(URAD_LANES_FIXED_MATH) == defined(HWY_TARGET_TOGGLE)
#ifdef URAD_LANES_FIXED_MATH
#undef URAD_LANES_FIXED_MATH
#else
#define URAD_LANES_FIXED_MATH
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "urad/log2.hpp"
#include "urad/sigmoid.hpp"

HWY_BEFORE_NAMESPACE();
namespace host::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
inline constexpr hn::ScalableTag<std::int32_t> kInts;
inline constexpr hn::ScalableTag<std::uint32_t> kWords;
using Ints = hn::Vec<decltype(kInts)>;
using Words = hn::Vec<decltype(kWords)>;
using IntMask = hn::Mask<decltype(kInts)>;

HWY_INLINE Ints ints(std::int32_t x) { return hn::Set(kInts, x); }
HWY_INLINE Words words(std::uint32_t x) { return hn::Set(kWords, x); }
HWY_INLINE Ints as_ints(Words x) { return hn::BitCast(kInts, x); }
HWY_INLINE Words as_words(Ints x) { return hn::BitCast(kWords, x); }

/// Lanes of x with the sign of `sign`.
HWY_INLINE Ints with_sign(Words x, Ints sign) {
  return hn::IfThenElse(hn::Lt(sign, hn::Zero(kInts)), hn::Neg(as_ints(x)), as_ints(x));
}
HWY_INLINE Words magnitude(Ints x) { return as_words(hn::Abs(x)); }

template <int N>
HWY_INLINE Ints round_shift(Ints x) {
  return with_sign(hn::ShiftRight<N>(hn::Add(magnitude(x), words(1u << (N - 1)))), x);
}

template <int N>
HWY_INLINE Ints mul_round(Ints x, Ints y) {
  const Words a = magnitude(x), b = magnitude(y), low = words((1u << N) - 1);
  const Words rest = hn::ShiftRight<N>(hn::Add(hn::Mul(hn::And(a, low), b), words(1u << (N - 1))));
  return with_sign(hn::Add(hn::Mul(hn::ShiftRight<N>(a), b), rest), hn::Xor(x, y));
}

/// x y / 2^n to nearest, n the same in all lanes, 17 .. 47.
HWY_INLINE Ints mul_shift(Ints x, Words y, int n) {
  const Words a = magnitude(x);
  const Words high = hn::Add(hn::Mul(hn::ShiftRight<16>(a), y),
                             hn::ShiftRight<16>(hn::Mul(hn::And(a, words(0xFFFF)), y)));
  return with_sign(hn::ShiftRightSame(hn::Add(high, words(1u << (n - 17))), n - 16), x);
}

/// Position of the highest set bit of x, 0 for x = 0: the exponent of a float that cannot round up to the next one.
HWY_INLINE Ints top_bit(Words x) {
  const hn::Repartition<float, decltype(kInts)> floats;
  const Words half = hn::ShiftRight<1>(x);  // positive as a signed number
  const auto f = hn::ConvertTo(floats, as_ints(hn::AndNot(hn::ShiftRight<1>(half), half)));
  const Ints exponent = as_ints(hn::ShiftRight<23>(hn::BitCast(kWords, f)));
  return hn::Max(hn::Sub(exponent, ints(126)), hn::Zero(kInts));
}

/// log2 of 2^31 <= m < 2^32, relative to 2^31.
HWY_INLINE Ints log2_mantissa_q24(Words m) {
  const auto* knots = urad::table::kLog2.value;
  const Ints k = as_ints(hn::And(hn::ShiftRight<23>(m), words(255)));
  const Words f_q15 = hn::And(hn::ShiftRight<8>(m), words(0x7FFF));
  const Words y = hn::GatherIndex(kWords, knots, k), next = hn::GatherIndex(kWords, knots + 1, k);
  return as_ints(
      hn::Add(y, hn::ShiftRight<15>(hn::Add(hn::Mul(hn::Sub(next, y), f_q15), words(0x4000)))));
}

HWY_INLINE Ints log2_q24(Words x) {
  const Ints n = top_bit(x);
  const Words m = hn::Shl(x, as_words(hn::Sub(ints(31), n)));
  const Ints y = hn::Add(hn::ShiftLeft<24>(n), log2_mantissa_q24(m));
  return hn::IfThenZeroElse(hn::Eq(as_ints(x), hn::Zero(kInts)), y);
}

/// log2 of high 2^32 + low, not 0.
HWY_INLINE Ints log2_q24(Words high, Words low) {
  const IntMask narrow = hn::Eq(as_ints(high), hn::Zero(kInts));
  const Words top = as_words(hn::IfThenElse(narrow, as_ints(low), as_ints(high)));
  const Ints n = top_bit(top);
  const Words rest = hn::Shr(hn::ShiftRight<1>(low), as_words(n));
  const Words m = hn::Or(hn::Shl(top, as_words(hn::Sub(ints(31), n))),
                         as_words(hn::IfThenZeroElse(narrow, as_ints(rest))));
  return hn::Add(hn::Add(hn::ShiftLeft<24>(n), hn::IfThenZeroElse(narrow, ints(32 << 24))),
                 log2_mantissa_q24(m));
}

HWY_INLINE Words exp2_uq(Ints x_q24, int fraction_bits) {
  const auto* knots = urad::table::kExp2.value;
  const Ints e = hn::Add(hn::ShiftRight<24>(x_q24), ints(fraction_bits));
  const Words f_uq24 = hn::And(as_words(x_q24), words(0xFFFFFF));
  const Ints k = as_ints(hn::ShiftRight<16>(f_uq24));
  const Words y = hn::GatherIndex(kWords, knots, k), next = hn::GatherIndex(kWords, knots + 1, k);
  const Words slope = hn::Mul(hn::ShiftRight<7>(hn::Sub(next, y)), hn::And(f_uq24, words(0xFFFF)));
  const Words m_uq30 = hn::Add(y, hn::ShiftRight<9>(hn::Add(slope, words(0x100))));
  // From 2^29 down the mantissa is rounded, above it is moved up.
  const Ints down = hn::Min(hn::Max(hn::Sub(ints(30), e), ints(1)), ints(31));
  const Words half = hn::Shl(words(1), as_words(hn::Sub(down, ints(1))));
  Ints result = as_ints(hn::Shr(hn::Add(m_uq30, half), as_words(down)));
  result = hn::IfThenElse(hn::Eq(e, ints(30)), as_ints(m_uq30), result);
  result = hn::IfThenElse(hn::Eq(e, ints(31)), as_ints(hn::ShiftLeft<1>(m_uq30)), result);
  result = hn::IfThenElse(hn::Gt(e, ints(31)), ints(-1), result);
  return as_words(hn::IfThenZeroElse(hn::Lt(e, ints(-1)), result));
}

HWY_INLINE Ints log2_1p_q24(Words x, int fraction_bits) {
  return hn::Sub(log2_q24(hn::Add(x, words(1u << fraction_bits))), ints(fraction_bits << 24));
}

/// Knot k of the sigmoid's table in the low half, the step to the next in the high half.
struct SigmoidSteps {
  std::uint32_t step[256];
};
constexpr SigmoidSteps make_sigmoid_steps() {
  SigmoidSteps t{};
  for (int k = 0; k < 256; ++k) {
    const std::uint32_t y = urad::table::kSigmoid.knot[k];
    t.step[k] = y | (urad::table::kSigmoid.knot[k + 1] - y) << 16;
  }
  return t;
}
inline constexpr SigmoidSteps kSigmoidSteps = make_sigmoid_steps();

HWY_INLINE Ints sigmoid_uq15(Ints x_q11) {
  const Words u = hn::Min(magnitude(x_q11), words(32767));
  const Words step = hn::GatherIndex(kWords, kSigmoidSteps.step, as_ints(hn::ShiftRight<7>(u)));
  const Words y = hn::And(step, words(0xFFFF)), dy = hn::ShiftRight<16>(step);
  const Words s =
      hn::Add(y, hn::ShiftRight<7>(hn::Add(hn::Mul(dy, hn::And(u, words(127))), words(64))));
  return hn::IfThenElse(hn::Lt(x_q11, hn::Zero(kInts)), hn::Sub(ints(32768), as_ints(s)),
                        as_ints(s));
}

/// Sums of products of 32 bits, exact in 64.
#if HWY_TARGET == HWY_SCALAR
struct WideSum {
  std::int64_t sum = 0;

  HWY_INLINE void add(Ints a, Ints b) { sum += std::int64_t{hn::GetLane(a)} * hn::GetLane(b); }
  HWY_INLINE Words low() const { return words(std::uint32_t(sum)); }
  HWY_INLINE Words high() const { return words(std::uint32_t(sum >> 32)); }
  HWY_INLINE WideSum negative() const { return {-sum}; }
};
#else
inline constexpr hn::Repartition<std::int64_t, decltype(kInts)> kWide;
using Wide = hn::Vec<decltype(kWide)>;

struct WideSum {
  Wide even = hn::Zero(kWide), odd = hn::Zero(kWide);  // of the lanes with these numbers

  HWY_INLINE void add(Ints a, Ints b) {
    even = hn::Add(even, hn::MulEven(a, b));
    odd = hn::Add(odd, hn::MulEven(upper(a), upper(b)));
  }
  HWY_INLINE Words low() const {
    return as_words(
        hn::OddEven(hn::BitCast(kInts, hn::ShiftLeft<32>(odd)), hn::BitCast(kInts, even)));
  }
  HWY_INLINE Words high() const {
    return as_words(hn::OddEven(hn::BitCast(kInts, odd), upper(hn::BitCast(kInts, even))));
  }
  HWY_INLINE WideSum negative() const { return {hn::Neg(even), hn::Neg(odd)}; }

 private:
  /// Odd lanes moved to the even ones.
  static HWY_INLINE Ints upper(Ints x) {
    return hn::BitCast(kInts, hn::ShiftRight<32>(hn::BitCast(kWide, x)));
  }
};
#endif

HWY_INLINE IntMask positive(const WideSum& x) {
  const Ints high = as_ints(x.high()), low = as_ints(x.low());
  return hn::Or(hn::Gt(high, hn::Zero(kInts)),
                hn::And(hn::Eq(high, hn::Zero(kInts)), hn::Ne(low, hn::Zero(kInts))));
}

}  // namespace host::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
