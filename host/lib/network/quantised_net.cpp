#include "network/quantised_net.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

#include "base/error.hpp"
#include "urad/network.hpp"

namespace host {

namespace {

constexpr std::int64_t kAccumulatorMax = 2147483647;  // 2^31 - 1
constexpr std::int64_t kFullScale = 32768;            // largest |input_q15| and sigmoid

void require(bool holds, const char* what) {
  if (!holds) throw Error(fmt::format("not a network the engine can run: {}", what));
}

void check_rescale(const urad_rescale& r) {
  require(r.multiplier >= 1 && r.shift >= 17 && r.shift <= 47,
          "a multiplier is 0 or a shift is not 17 to 47");
}

// Largest |accumulator| over all inputs.
template <class Weights>
std::int64_t reach(const Weights& begin, const Weights& end, std::int32_t bias) {
  std::int64_t sum = std::llabs(std::int64_t{bias});
  for (auto w = begin; w != end; ++w) sum += std::llabs(std::int64_t{*w}) * kFullScale;
  return sum;
}

void check_sizes(const NetTables& t) {
  const auto inputs = std::size_t(t.inputs), hidden = std::size_t(t.hidden);
  require(t.inputs >= 1 && t.inputs <= URAD_NET_MAX_INPUTS, "inputs are not 1 to 32");
  require(t.hidden >= 1 && t.hidden <= URAD_NET_MAX_HIDDEN, "hidden neurons are not 1 to 64");
  require(t.weight_bits == 8 || t.weight_bits == 16, "weights have neither 8 nor 16 bits");
  require(t.hidden_weight.size() == inputs * hidden && t.hidden_bias.size() == hidden &&
              t.hidden_rescale.size() == hidden && t.output_weight.size() == hidden &&
              t.skip_weight.size() == inputs,
          "a table has the wrong length");
}

}  // namespace

QuantisedNet::QuantisedNet(const NetTables& tables) {
  check_sizes(tables);
  const auto owned = std::make_shared<Owned>();
  owned->tables = tables;
  const NetTables& t = owned->tables;
  if (t.weight_bits == 8)
    for (const std::int16_t w : t.hidden_weight) {
      require(w >= -128 && w <= 127, "an 8-bit weight is not -128 to 127");
      owned->narrow_weight.push_back(static_cast<std::int8_t>(w));
    }

  bool proven = true;
  for (int h = 0; h < t.hidden; ++h) {
    const auto row = t.hidden_weight.begin() + std::ptrdiff_t(h) * t.inputs;
    const std::int64_t most = reach(row, row + t.inputs, t.hidden_bias[std::size_t(h)]);
    require(most <= kAccumulatorMax, "a hidden accumulator could overflow");
    const urad_rescale r = t.hidden_rescale[std::size_t(h)];
    check_rescale(r);
    const std::int64_t z_q11 =
        (most * r.multiplier + (std::int64_t{1} << (r.shift - 1))) >> r.shift;
    proven = proven && z_q11 <= 32767;
    owned->hidden_range = std::max(owned->hidden_range, double(z_q11) / 2048);
  }
  check_rescale(t.output_rescale);
  std::vector<std::int16_t> last = t.output_weight;
  last.insert(last.end(), t.skip_weight.begin(), t.skip_weight.end());
  const std::int64_t most = reach(last.begin(), last.end(), t.output_bias);
  require(most <= kAccumulatorMax, "the output accumulator could overflow");

  urad_net& pod = owned->pod;
  pod.abi = URAD_NET_ABI;
  pod.flags = proven ? URAD_NET_PROVEN : 0;
  pod.inputs = static_cast<std::uint8_t>(t.inputs);
  pod.hidden = static_cast<std::uint8_t>(t.hidden);
  pod.weight_bits = static_cast<std::uint8_t>(t.weight_bits);
  pod.far_rho_uq16 = t.far_rho_uq16;
  pod.near_rho_uq16 = t.near_rho_uq16;
  pod.hidden_weight = t.weight_bits == 8 ? static_cast<const void*>(owned->narrow_weight.data())
                                         : static_cast<const void*>(t.hidden_weight.data());
  pod.hidden_bias = t.hidden_bias.data();
  pod.hidden_rescale = t.hidden_rescale.data();
  pod.output_weight = t.output_weight.data();
  pod.skip_weight = t.skip_weight.data();
  pod.output_bias = t.output_bias;
  pod.output_rescale = t.output_rescale;
  pod.crc32 = urad::network_crc32(pod);
  require(urad::network_check(&pod) == urad::Status::ok, "network_check() refuses it");
  owned_ = owned;
}

int QuantisedNet::flash_bytes() const {
  const NetTables& t = tables();
  const int tables_bytes = t.hidden * (t.inputs * t.weight_bits / 8 + 4 + 4 + 2) + t.inputs * 2;
  const int struct_bytes = 12 + 5 * 4 + 4 + 4 + 4;
  return tables_bytes + struct_bytes;
}

}  // namespace host
