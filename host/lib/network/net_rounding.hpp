// Real weights to whole ones: scales, biases, and each weight rounded on its own.
#pragma once
#include <vector>

#include "network/float_net.hpp"
#include "network/quantised_net.hpp"

namespace host {

/// The multiplier (>= 2^15: 16 significant bits) and shift closest to `factor`. 2^-32 <= factor <
/// 2^15, else Error.
urad_rescale rescale_of(double factor);
double value_of(const urad_rescale& rescale);

/// Scale of one accumulator: real weight per integer. rescale is exact, so the weights can be
/// rounded against it.
struct WeightScale {
  urad_rescale rescale;
  double unit;
};

/// The greatest hidden weight of so many bits, either sign.
int greatest_weight(int bits);

/// The finest scale of neuron h that neither a weight nor the accumulator can overflow.
WeightScale hidden_scale(const FloatNet& net, int h, int bits);

/// Sizes and threshold; hidden weights 0. bits: 8 or 16; far_rho: 0 .. 1, else Error.
NetTables empty_tables(const FloatNet& net, int bits, double far_rho);

/// Everything but the hidden weights, which are already integers in `tables`.
void round_rest(const FloatNet& net, const std::vector<WeightScale>& scales, NetTables* tables);

/// Each weight rounded on its own. far_rho: 0 .. 1, pairs below it take the kernel alone.
NetTables round_net(const FloatNet& net, int weight_bits, double far_rho);

/// A threshold on rho as the tables hold it. 0 or more and below 1, else Error, naming it.
std::uint16_t threshold_uq16(double rho, const char* which);

}  // namespace host
