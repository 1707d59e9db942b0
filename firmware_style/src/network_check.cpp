#include "crc32.hpp"
#include "urad/network.hpp"
#include "urad/q.hpp"

namespace urad {

namespace {

int32_t hidden_weight(const urad_net& net, int index) noexcept {
  return net.weight_bits == 8 ? static_cast<const int8_t*>(net.hidden_weight)[index]
                              : static_cast<const int16_t*>(net.hidden_weight)[index];
}

bool good(const urad_rescale& scale) noexcept { return scale.shift >= 17 && scale.shift <= 47; }

/// Greatest accumulator: every |input| <= 2^15 (sigmoids reach 2^15 exactly).
int64_t reach(const urad_net& net, int h) noexcept {
  int64_t sum = magnitude(net.hidden_bias[h]);
  for (int n = 0; n < net.inputs; ++n)
    sum += int64_t{magnitude(hidden_weight(net, h * net.inputs + n))} << 15;
  return sum;
}

bool accumulators_fit(const urad_net& net) noexcept {
  constexpr int64_t limit = INT32_MAX;
  int64_t output = magnitude(net.output_bias);
  for (int n = 0; n < net.inputs; ++n)
    output += int64_t{magnitude(int32_t{net.skip_weight[n]})} << 15;
  for (int h = 0; h < net.hidden; ++h) {
    const int64_t z = reach(net, h);
    if (z > limit) return false;
    const int64_t z_q11 =
        round_shift(z * net.hidden_rescale[h].multiplier, net.hidden_rescale[h].shift);
    if ((net.flags & URAD_NET_PROVEN) && z_q11 > 32767) return false;
    output += int64_t{magnitude(int32_t{net.output_weight[h]})} << 15;
  }
  return output <= limit;
}

}  // namespace

uint32_t network_crc32(const urad_net& net) noexcept {
  Crc32 crc;
  crc.half(net.abi), crc.half(net.flags);
  crc.byte(net.inputs), crc.byte(net.hidden), crc.byte(net.weight_bits), crc.byte(net.reserved);
  crc.half(net.far_rho_uq16), crc.half(net.near_rho_uq16);
  for (int k = 0; k < net.hidden * net.inputs; ++k) {
    const uint32_t weight = uint32_t(hidden_weight(net, k));
    net.weight_bits == 8 ? crc.byte(weight) : crc.half(weight);
  }
  for (int h = 0; h < net.hidden; ++h) crc.word(uint32_t(net.hidden_bias[h]));
  for (int h = 0; h < net.hidden; ++h) {
    crc.half(net.hidden_rescale[h].multiplier), crc.half(net.hidden_rescale[h].shift);
  }
  for (int h = 0; h < net.hidden; ++h) crc.half(uint32_t(int32_t{net.output_weight[h]}));
  for (int n = 0; n < net.inputs; ++n) crc.half(uint32_t(int32_t{net.skip_weight[n]}));
  crc.word(uint32_t(net.output_bias));
  crc.half(net.output_rescale.multiplier), crc.half(net.output_rescale.shift);
  return crc.value();
}

Status network_check(const urad_net* net) noexcept {
  if (!net) return Status::bad_net;
  if (net->abi != URAD_NET_ABI || (net->flags & ~URAD_NET_PROVEN) || net->reserved) {
    return Status::bad_net;
  }
  if (net->inputs < 1 || net->inputs > URAD_NET_MAX_INPUTS) return Status::bad_net;
  if (net->hidden < 1 || net->hidden > URAD_NET_MAX_HIDDEN) return Status::bad_net;
  if (net->weight_bits != 8 && net->weight_bits != 16) return Status::bad_net;
  if (!net->hidden_weight || !net->hidden_bias || !net->hidden_rescale || !net->output_weight ||
      !net->skip_weight) {
    return Status::bad_net;
  }
  for (int h = 0; h < net->hidden; ++h) {
    if (!good(net->hidden_rescale[h])) return Status::bad_net;
  }
  if (!good(net->output_rescale) || !accumulators_fit(*net)) return Status::bad_net;
  return network_crc32(*net) == net->crc32 ? Status::ok : Status::bad_net;
}

}  // namespace urad
