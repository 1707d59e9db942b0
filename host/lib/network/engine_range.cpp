#include "network/engine_range.hpp"

#include <algorithm>
#include <cmath>

namespace host {

namespace {

constexpr double kLargestWeight = 32767;

/// A scale is rounded up by a part in 2^15 (quantise.cpp); twice that is kept free.
bool fits(const WeightReach& reach, double units, double sum_max) {
  const double unit_max = kFactorMax / units * (1 - 0x1p-14);
  return reach.sum <= sum_max * unit_max && reach.largest <= kLargestWeight * unit_max;
}

}  // namespace

WeightReach hidden_reach(const FloatNet& net, int h) {
  WeightReach reach{std::fabs(net.hidden_bias(h)), 0};
  for (int n = 0; n < net.inputs(); ++n) {
    reach.sum += std::fabs(net.hidden_weight(h, n));
    reach.largest = std::max(reach.largest, std::fabs(net.hidden_weight(h, n)));
  }
  return reach;
}

WeightReach output_reach(const FloatNet& net) {
  WeightReach reach{std::fabs(net.output_bias()), 0};
  for (int p = net.output_at(); p < net.bias_at(); ++p) {
    reach.sum += std::fabs(net.parameters[p]);
    reach.largest = std::max(reach.largest, std::fabs(net.parameters[p]));
  }
  return reach;
}

bool engine_can_hold(const FloatNet& net) {
  for (int h = 0; h < net.hidden(); ++h)
    if (!fits(hidden_reach(net, h), kHiddenUnits, kWeightSumMax)) return false;
  return fits(output_reach(net), kOutputUnits, kOutputSumMax);
}

}  // namespace host
