#include "legacy/legacy_fixed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "urad/legacy.hpp"

namespace host {

namespace {

constexpr int kMostHiddenBits = 20;  // finer than the sums are rounded

/// Most fraction bits with which every |value| rounds to at most `limit`; below 0: none.
int fraction_bits(const float* values, std::size_t count, double limit, int most) {
  double largest = 0;
  for (std::size_t k = 0; k < count; ++k) largest = std::max(largest, std::fabs(double(values[k])));
  int bits = most;
  while (bits >= 0 && std::ldexp(largest, bits) > limit) --bits;
  return bits;
}

std::int64_t rounded(double value, int bits) { return std::llround(std::ldexp(value, bits)); }

std::int64_t largest_sum(const LegacyTables& t) {
  std::int64_t sum = std::abs(std::int64_t{t.output_bias});
  for (const std::int16_t weight : t.output_weight)
    sum += std::int64_t{std::abs(int{weight})} << 15;
  return sum;
}

}  // namespace

LegacyTables round_legacy(const LegacyNet& net) {
  if (net.hidden > URAD_LEGACY_MAX_HIDDEN)
    throw Error(
        fmt::format("{}: the engine takes {} hidden units", net.name(), URAD_LEGACY_MAX_HIDDEN));
  LegacyTables t;
  t.hidden = net.hidden;
  t.scaling = net.scaling;
  if (!(net.hidden_range() < 255))
    throw Error(fmt::format("{}: |z| may reach {:.0f}; the engine holds 255", net.name(),
                            net.hidden_range()));
  for (std::size_t h = 0; h < std::size_t(net.hidden); ++h) {
    const float* row = &net.hidden_weight[h * kLegacyInputs];
    const int bits = fraction_bits(row, kLegacyInputs, 32767, kMostHiddenBits);
    t.hidden_shift.push_back(std::uint8_t(bits));
    for (int n = 0; n < kLegacyInputs; ++n)
      t.hidden_weight.push_back(std::int16_t(rounded(double(row[n]), bits)));
    t.hidden_bias.push_back(std::int32_t(rounded(double(net.hidden_bias[h]), 23)));
  }
  t.output_shift = fraction_bits(net.output_weight.data(), net.output_weight.size(), 32767, 15);
  for (; t.output_shift >= 0; --t.output_shift) {
    t.output_weight.clear();
    for (const float v : net.output_weight)
      t.output_weight.push_back(std::int16_t(rounded(double(v), t.output_shift)));
    const std::int64_t bias = rounded(double(net.output_bias), t.output_shift + 15);
    if (std::abs(bias) > INT32_MAX) continue;
    t.output_bias = std::int32_t(bias);
    if (largest_sum(t) <= INT32_MAX) return t;
  }
  throw Error(fmt::format("{}: output weights too large for the engine", net.name()));
}

LegacyFixed::LegacyFixed(const LegacyTables& tables) {
  const auto owned = std::make_shared<Owned>();
  owned->tables = tables;
  const LegacyTables& t = owned->tables;
  const auto hidden = std::size_t(std::max(t.hidden, 0));
  if (t.hidden < 1 || t.hidden > URAD_LEGACY_MAX_HIDDEN || t.output_shift < 0 ||
      t.output_shift > 15 || t.hidden_weight.size() != hidden * kLegacyInputs ||
      t.hidden_shift.size() != hidden || t.hidden_bias.size() != hidden ||
      t.output_weight.size() != hidden)
    throw Error("a network of the report whose tables do not fit together");
  urad_legacy_net& pod = owned->pod;
  pod.abi = URAD_LEGACY_ABI;
  pod.flags = t.scaling == LegacyScaling::log ? URAD_LEGACY_LOG : 0;
  pod.hidden = std::uint8_t(t.hidden);
  pod.output_shift = std::uint8_t(t.output_shift);
  pod.hidden_weight = t.hidden_weight.data();
  pod.hidden_shift = t.hidden_shift.data();
  pod.hidden_bias = t.hidden_bias.data();
  pod.output_weight = t.output_weight.data();
  pod.output_bias = t.output_bias;
  pod.flags |= URAD_LEGACY_PROVEN;
  pod.crc32 = urad::legacy_crc32(pod);
  if (urad::legacy_check(&pod) != urad::Status::ok) {  // the proof fails: the kernel clamps
    pod.flags = std::uint16_t(pod.flags & ~URAD_LEGACY_PROVEN);
    pod.crc32 = urad::legacy_crc32(pod);
  }
  if (urad::legacy_check(&pod) != urad::Status::ok)
    throw Error("a network of the report whose sums could overflow in the engine");
  owned_ = owned;
}

double LegacyFixed::hidden_range() const {
  const LegacyTables& t = tables();
  double range = 0;
  for (std::size_t h = 0; h < std::size_t(t.hidden); ++h) {
    double sum = std::fabs(std::ldexp(t.hidden_bias[h], -23));
    for (std::size_t n = 0; n < kLegacyInputs; ++n)
      sum += std::fabs(std::ldexp(t.hidden_weight[h * kLegacyInputs + n], -t.hidden_shift[h]));
    range = std::max(range, sum);
  }
  return range;
}

int LegacyFixed::flash_bytes() const {
  return 32 + tables().hidden * (2 * kLegacyInputs + 1 + 4 + 2);
}

std::uint16_t legacy_output_uq15(const urad_legacy_net& net, const LegacyInput& input) {
  const auto coordinate = [](float x) {
    return std::int32_t(std::llround(std::ldexp(double(x) - 0.5, 30)));
  };
  urad_point vertex[8];
  for (std::size_t k = 0; k < 8; ++k)
    vertex[k] = {coordinate(input[3 * k]), coordinate(input[3 * k + 1]),
                 coordinate(input[3 * k + 2])};
  std::vector<std::int32_t> z;
  for (int h = 0; h < net.hidden; ++h) {
    const std::int16_t* row = net.hidden_weight + h * kLegacyInputs;
    const int bits = net.hidden_shift[h];
    z.push_back(net.hidden_bias[h] + urad::legacy_half_q23(row, bits, vertex) +
                urad::legacy_half_q23(row + kLegacyInputs / 2, bits, vertex + 4));
  }
  return urad::legacy_output_uq15(net, z.data());
}

double LegacyFixed::run(const LegacyInput& input) const {
  return legacy_output_uq15(pod(), input) / 32768.0;
}

double LegacyFixed::form_factor(const LegacyInput& input) const {
  return urad::legacy_form_factor_uq32(pod(), legacy_output_uq15(pod(), input)) / 4294967296.0;
}

LegacyRounding legacy_rounding(const LegacyNet& net, const LegacyFixed& fixed,
                               const std::vector<LegacyInput>& inputs) {
  LegacyRounding worst;
  for (const LegacyInput& input : inputs) {
    const double y = net.run(input);
    worst.output = std::max(worst.output, std::fabs(fixed.run(input) - y));
    // The engine's factors end at 0 and 1; what the float net says beyond is not rounding.
    const double f = std::clamp(legacy_unscaled(net.scaling, y), 0.0, 1.0);
    worst.factor = std::max(worst.factor, std::fabs(fixed.form_factor(input) - f));
  }
  return worst;
}

}  // namespace host
