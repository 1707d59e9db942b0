#include "urad/network.hpp"

#include "urad/q.hpp"
#include "urad/sigmoid.hpp"

namespace urad {

namespace {

constexpr int32_t kZLimit_q11 = 32767;  // the sigmoid is flat beyond +-16

/// network_check() has seen to it that the result fits 32 bits.
constexpr int32_t rescaled(int32_t accumulator, const urad_rescale& scale) noexcept {
  return mul_shift(accumulator, scale.multiplier, scale.shift);
}

constexpr int32_t clamped(int32_t x, int32_t limit) noexcept {
  return x > limit ? limit : x < -limit ? -limit : x;
}

template <class Weight>
int32_t hidden_layer(const urad_net& net, const int16_t* input_q15, int32_t sum) noexcept {
  const auto* weight = static_cast<const Weight*>(net.hidden_weight);
  for (int h = 0; h < net.hidden; ++h, weight += net.inputs) {
    const int32_t z = add_products(net.hidden_bias[h], weight, input_q15, net.inputs);
    int32_t z_q11 = rescaled(z, net.hidden_rescale[h]);
    if (!(net.flags & URAD_NET_PROVEN)) z_q11 = clamped(z_q11, kZLimit_q11);
    sum += net.output_weight[h] * int32_t{sigmoid_uq15(int16_t(z_q11))};
  }
  return sum;
}

}  // namespace

int32_t network_run(const urad_net& net, const int16_t* input_q15) noexcept {
  const int32_t skip = add_products(net.output_bias, net.skip_weight, input_q15, net.inputs);
  const int32_t sum = net.weight_bits == 8 ? hidden_layer<int8_t>(net, input_q15, skip)
                                           : hidden_layer<int16_t>(net, input_q15, skip);
  return rescaled(sum, net.output_rescale);
}

}  // namespace urad
