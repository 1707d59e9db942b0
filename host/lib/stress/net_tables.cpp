#include "stress/net_tables.hpp"

#include <algorithm>
#include <cstring>

#include "urad/network.hpp"
#include "urad/sigmoid.hpp"

namespace host {
namespace {

template <class T>
std::vector<T> table(const T* from, std::size_t count) {
  return {from, from + count};
}

/// round(x m / 2^n), ties away from zero, in 128 bits.
std::int64_t rescaled(std::int64_t x, const urad_rescale& by) {
  const __int128 product = static_cast<__int128>(x < 0 ? -x : x) * by.multiplier;
  const auto value = std::int64_t((product + (__int128{1} << (by.shift - 1))) >> by.shift);
  return x < 0 ? -value : value;
}

template <class T>
T number(NetTemper temper, Random& random) {
  constexpr auto low = std::numeric_limits<T>::min(), high = std::numeric_limits<T>::max();
  if (temper == NetTemper::zero) return 0;
  if (temper == NetTemper::extreme) return random.below(2) ? low : high;
  const auto wide = std::int64_t(random.uniform(double(low), double(high)));
  return T(wide >> random.below(int(8 * sizeof(T))));
}

}  // namespace

OpenNet::OpenNet(int inputs, int hidden, int weight_bits)
    : hidden_weight(std::size_t(inputs * hidden * weight_bits / 8)),
      hidden_bias(std::size_t(hidden)),
      hidden_rescale(std::size_t(hidden), urad_rescale{1, 17}),
      output_weight(std::size_t(hidden)),
      skip_weight(std::size_t(inputs)) {
  fields.abi = URAD_NET_ABI;
  fields.inputs = std::uint8_t(inputs);
  fields.hidden = std::uint8_t(hidden);
  fields.weight_bits = std::uint8_t(weight_bits);
  fields.output_rescale = {1, 17};
}

OpenNet::OpenNet(const urad_net& net) : OpenNet(net.inputs, net.hidden, net.weight_bits) {
  fields = net;
  std::memcpy(hidden_weight.data(), net.hidden_weight, hidden_weight.size());
  hidden_bias = table(net.hidden_bias, net.hidden);
  hidden_rescale = table(net.hidden_rescale, net.hidden);
  output_weight = table(net.output_weight, net.hidden);
  skip_weight = table(net.skip_weight, net.inputs);
}

const urad_net& OpenNet::pod() {
  fields.hidden_weight = hidden_weight.data();
  fields.hidden_bias = hidden_bias.data();
  fields.hidden_rescale = hidden_rescale.data();
  fields.output_weight = output_weight.data();
  fields.skip_weight = skip_weight.data();
  return fields;
}

void OpenNet::seal() { fields.crc32 = urad::network_crc32(pod()); }

std::vector<OpenNet::Bytes> OpenNet::bytes() {
  const auto all = [](auto& items) { return Bytes{items.data(), items.size() * sizeof(items[0])}; };
  const auto one = [](auto& field) { return Bytes{&field, sizeof field}; };
  return {one(fields.abi),          one(fields.flags),
          one(fields.inputs),       one(fields.hidden),
          one(fields.weight_bits),  one(fields.reserved),
          one(fields.far_rho_uq16), one(fields.near_rho_uq16),
          one(fields.output_bias),  one(fields.output_rescale),
          one(fields.crc32),        all(hidden_weight),
          all(hidden_bias),         all(hidden_rescale),
          all(output_weight),       all(skip_weight)};
}

std::size_t OpenNet::bits() const {
  std::size_t sum = 0;
  for (const Bytes& part : const_cast<OpenNet*>(this)->bytes()) sum += 8 * part.size;
  return sum;
}

void OpenNet::flip(std::size_t bit) {
  for (const Bytes& part : bytes()) {
    if (bit < 8 * part.size) {
      static_cast<std::uint8_t*>(part.data)[bit / 8] ^= std::uint8_t(1u << bit % 8);
      return;
    }
    bit -= 8 * part.size;
  }
}

void randomise(OpenNet* net, NetTemper temper, Random& random) {
  for (std::uint8_t& byte : net->hidden_weight)
    byte = std::uint8_t(temper == NetTemper::zero ? 0 : random.below(256));
  if (temper == NetTemper::extreme) {
    const bool wide = net->fields.weight_bits == 16;
    for (std::size_t k = 0; k < net->hidden_weight.size(); ++k) {
      const bool high_byte = !wide || k % 2 == 1;
      net->hidden_weight[k] =
          std::uint8_t(random.below(2) ? (high_byte ? 0x80 : 0) : (high_byte ? 0x7F : 0xFF));
    }
  }
  for (auto& bias : net->hidden_bias) bias = number<std::int32_t>(temper, random);
  for (auto& weight : net->output_weight) weight = number<std::int16_t>(temper, random);
  for (auto& weight : net->skip_weight) weight = number<std::int16_t>(temper, random);
  const auto rescale = [&] {
    return urad_rescale{std::uint16_t(random.below(65536)), std::uint16_t(17 + random.below(31))};
  };
  for (auto& by : net->hidden_rescale) by = rescale();
  net->fields.output_bias = number<std::int32_t>(temper, random);
  net->fields.output_rescale = rescale();
  net->fields.flags = std::uint16_t(random.below(2));
  net->fields.far_rho_uq16 = std::uint16_t(random.below(65536) >> random.below(16));
  net->fields.near_rho_uq16 = std::uint16_t(random.below(65536) >> random.below(16));
  net->seal();
}

std::int32_t wide_network(const urad_net& net, const std::int16_t* input_q15) {
  std::int64_t sum = net.output_bias;
  for (int n = 0; n < net.inputs; ++n) sum += std::int64_t{net.skip_weight[n]} * input_q15[n];
  for (int h = 0; h < net.hidden; ++h) {
    std::int64_t z = net.hidden_bias[h];
    for (int n = 0; n < net.inputs; ++n) {
      const int at = h * net.inputs + n;
      const std::int64_t weight = net.weight_bits == 8
                                      ? static_cast<const std::int8_t*>(net.hidden_weight)[at]
                                      : static_cast<const std::int16_t*>(net.hidden_weight)[at];
      z += weight * input_q15[n];
    }
    const std::int64_t z_q11 =
        std::clamp<std::int64_t>(rescaled(z, net.hidden_rescale[h]), -32767, 32767);
    sum += std::int64_t{net.output_weight[h]} * urad::sigmoid_uq15(std::int16_t(z_q11));
  }
  return std::int32_t(rescaled(sum, net.output_rescale));
}

}  // namespace host
