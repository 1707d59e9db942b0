// From double to the integers of urad/net.h.
#pragma once
#include "network/narrow_weights.hpp"
#include "network/quantised_net.hpp"
#include "network/training_set.hpp"

namespace host {

/// The set with the net's own word as target, for a net that has to do on pairs that nobody trained
/// on: with the truth as target, rounding trades many small errors for a few great ones
/// [distillation: Hinton, Vinyals and Dean 2015].
TrainingSet with_word_of(const FloatNet& net, TrainingSet set);

/// 16 bits, or 8 without a training set: round_net(). 8 bits: narrow_net().
QuantisedNet quantise(const FloatNet& net, int weight_bits, double far_rho,
                      const Compensation& compensation);

/// The same integers with the threshold above which, and for clipped pairs, the engine takes the
/// exact sum. near_rho: 0 (never) or more, below 1, else Error.
QuantisedNet with_near_rho(const QuantisedNet& net, double near_rho);

}  // namespace host
