// Which networks the integers of urad/net.h can hold.
#pragma once
#include "network/float_net.hpp"

namespace host {

/// Bound of sum |w_q| + |b_q| / 2^15 for an accumulator below 2^31, with room for the rounding of up
/// to 33 weights by half a unit each.
inline constexpr double kWeightSumMax = 65535 - 33 / 2.0;
/// Of the output: y itself and 31 more units beside it.
inline constexpr double kOutputSumMax = kWeightSumMax - 32;

/// Largest scale from an accumulator to z or y: the engine's shifts begin at 17.
inline constexpr double kFactorMax = 0.5 - 0x1p-14;
/// z_q11 = accumulator * unit * 2^11 / 2^15, y_q16 = accumulator * unit * 2^16 / 2^15.
inline constexpr double kHiddenUnits = 0x1p-4, kOutputUnits = 2;

/// Real weights of one accumulator.
struct WeightReach {
  double sum = 0, largest = 0;  ///< of |w|; the bias is in the sum only
};
WeightReach hidden_reach(const FloatNet& net, int h);
WeightReach output_reach(const FloatNet& net);

/// Whether weights of 16 bits can hold the net. Where they cannot, inputs that hardly differ have been
/// set off against each other by weights of many thousands.
bool engine_can_hold(const FloatNet& net);

}  // namespace host
