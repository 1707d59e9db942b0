#include "network/net_rounding.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "network/engine_range.hpp"

namespace host {

namespace {

constexpr double kFullScale = 32768;

// factor = unit * units_per_weight is what the accumulator is multiplied by.
WeightScale scale_for(double least_unit, double units_per_weight) {
  const double factor = std::clamp(least_unit * units_per_weight, 0x1p-31, kFactorMax);
  const urad_rescale rescale = rescale_of(factor * (1 + 0x1p-15));  // never finer than least_unit
  return {rescale, value_of(rescale) / units_per_weight};
}

std::int16_t round16(double x) { return static_cast<std::int16_t>(std::lround(x)); }

std::int32_t round_bias(double bias, double unit) {
  const double b = std::round(bias / unit * kFullScale);
  if (!(std::fabs(b) < 0x1p31))
    throw Error(fmt::format("a bias of {} does not fit beside weights in units of {}", bias, unit));
  return static_cast<std::int32_t>(b);
}

}  // namespace

double value_of(const urad_rescale& rescale) {
  return std::ldexp(double(rescale.multiplier), -int{rescale.shift});
}

urad_rescale rescale_of(double factor) {
  if (!(factor >= 0x1p-32 && factor < 0x1p15))
    throw Error(fmt::format("a scale of {} is outside 2^-32 .. 2^15", factor));
  int exponent = 0;
  double multiplier = std::round(std::ldexp(std::frexp(factor, &exponent), 16));
  if (multiplier > 65535) multiplier /= 2, ++exponent;
  return {static_cast<std::uint16_t>(multiplier), static_cast<std::uint16_t>(16 - exponent)};
}

int greatest_weight(int bits) { return bits == 8 ? 127 : 32767; }

WeightScale hidden_scale(const FloatNet& net, int h, int bits) {
  const WeightReach reach = hidden_reach(net, h);
  return scale_for(std::max(reach.largest / greatest_weight(bits), reach.sum / kWeightSumMax),
                   kHiddenUnits);
}

std::uint16_t threshold_uq16(double rho, const char* which) {
  if (!(rho >= 0 && rho < 1))
    throw Error(fmt::format("the {} threshold is 0 or more and below 1, not {}", which, rho));
  return static_cast<std::uint16_t>(std::min(65535.0, std::round(rho * 65536)));
}

NetTables empty_tables(const FloatNet& net, int bits, double far_rho) {
  if (bits != 8 && bits != 16) throw Error(fmt::format("weights have 8 or 16 bits, not {}", bits));
  NetTables tables;
  tables.inputs = net.inputs();
  tables.hidden = net.hidden();
  tables.weight_bits = bits;
  tables.far_rho_uq16 = threshold_uq16(far_rho, "far");
  tables.hidden_weight.assign(std::size_t(net.inputs() * net.hidden()), 0);
  return tables;
}

void round_rest(const FloatNet& net, const std::vector<WeightScale>& scales, NetTables* tables) {
  if (!engine_can_hold(net))
    throw Error("weights of many thousands do not fit the engine's 16 bits");
  const WeightReach reach = output_reach(net);
  const WeightScale output = scale_for(
      std::max(reach.largest / greatest_weight(16), reach.sum / kOutputSumMax), kOutputUnits);
  tables->output_rescale = output.rescale;
  tables->output_bias = round_bias(net.output_bias(), output.unit);
  tables->hidden_bias.clear(), tables->hidden_rescale.clear();
  tables->output_weight.clear(), tables->skip_weight.clear();
  for (int h = 0; h < net.hidden(); ++h) {
    const WeightScale& scale = scales[std::size_t(h)];
    tables->hidden_bias.push_back(round_bias(net.hidden_bias(h), scale.unit));
    tables->hidden_rescale.push_back(scale.rescale);
    tables->output_weight.push_back(round16(net.output_weight(h) / output.unit));
  }
  for (int n = 0; n < net.inputs(); ++n)
    tables->skip_weight.push_back(round16(net.skip_weight(n) / output.unit));
}

NetTables round_net(const FloatNet& net, int weight_bits, double far_rho) {
  NetTables tables = empty_tables(net, weight_bits, far_rho);
  const double greatest = greatest_weight(weight_bits);
  std::vector<WeightScale> scales;
  for (int h = 0; h < net.hidden(); ++h) {
    scales.push_back(hidden_scale(net, h, weight_bits));
    for (int n = 0; n < net.inputs(); ++n)
      tables.hidden_weight[std::size_t(h * net.inputs() + n)] =
          round16(std::clamp(net.hidden_weight(h, n) / scales.back().unit, -greatest, greatest));
  }
  round_rest(net, scales, &tables);
  return tables;
}

}  // namespace host
