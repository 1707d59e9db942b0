// network.hpp for many inputs at once.
#if defined(URAD_LANES_NETWORK) == defined(HWY_TARGET_TOGGLE)
#ifdef URAD_LANES_NETWORK
#undef URAD_LANES_NETWORK
#else
#define URAD_LANES_NETWORK
#endif

#include "lanes/fixed_math-inl.hpp"
#include "urad/network.hpp"

HWY_BEFORE_NAMESPACE();
namespace host::HWY_NAMESPACE {

template <class Weight>
HWY_INLINE Ints weighted_sum(const Weight* weight, const Ints* input, int n, std::int32_t bias) {
  Ints sum = ints(bias);
  for (int k = 0; k < n; ++k) sum = hn::Add(sum, hn::Mul(ints(weight[k]), input[k]));
  return sum;
}

HWY_INLINE Ints rescaled(Ints accumulator, const urad_rescale& scale) {
  return mul_shift(accumulator, words(scale.multiplier), scale.shift);
}

HWY_INLINE Ints clamped(Ints x, std::int32_t limit) {
  return hn::Max(hn::Min(x, ints(limit)), ints(-limit));
}

template <class Weight>
HWY_INLINE Ints hidden_layer(const urad_net& net, const Ints* input_q15, Ints sum) {
  const auto* weight = static_cast<const Weight*>(net.hidden_weight);
  for (int h = 0; h < net.hidden; ++h, weight += net.inputs) {
    const Ints z = weighted_sum(weight, input_q15, net.inputs, net.hidden_bias[h]);
    const Ints z_q11 = clamped(rescaled(z, net.hidden_rescale[h]), 32767);
    sum = hn::Add(sum, hn::Mul(ints(net.output_weight[h]), sigmoid_uq15(z_q11)));
  }
  return sum;
}

/// Output y in Q15.16 for net.inputs vectors of Q0.15 inputs.
HWY_INLINE Ints network_run(const urad_net& net, const Ints* input_q15) {
  const Ints skip = weighted_sum(net.skip_weight, input_q15, net.inputs, net.output_bias);
  const Ints sum = net.weight_bits == 8 ? hidden_layer<std::int8_t>(net, input_q15, skip)
                                        : hidden_layer<std::int16_t>(net, input_q15, skip);
  return rescaled(sum, net.output_rescale);
}

HWY_INLINE Ints word_q24(Ints y_q16, Ints gate_uq16) {
  const Ints whole = hn::Mul(as_ints(hn::ShiftRight<16>(magnitude(y_q16))), gate_uq16);
  const IntMask too_much = hn::Gt(whole, ints(((urad::kMostWord - 1) << 16) - 1));
  const Ints most_q24 = with_sign(words(std::uint32_t{urad::kMostWord} << 24), y_q16);
  return hn::IfThenElse(too_much, most_q24, mul_round<8>(y_q16, gate_uq16));
}

}  // namespace host::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
