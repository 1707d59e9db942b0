// From double to the integers of urad/net.h.
#pragma once
#include "network/float_net.hpp"
#include "network/quantised_net.hpp"
#include "network/training_set.hpp"

namespace host {

/// The multiplier (>= 2^15: 16 significant bits) and shift closest to `factor`. 2^-32 <= factor <
/// 2^15, else Error.
urad_rescale rescale_of(double factor);
double value_of(const urad_rescale& rescale);

/// Each weight rounded on its own; per neuron the finest scale that neither a weight nor the
/// accumulator can overflow. far_rho: 0 .. 1, pairs below it take the kernel alone.
NetTables round_net(const FloatNet& net, int weight_bits, double far_rho);

/// The set with the net's own word as target, for a net that has to do on pairs that nobody trained
/// on: with the truth as target, rounding trades many small errors for a few great ones
/// [distillation: Hinton, Vinyals and Dean 2015].
TrainingSet with_word_of(const FloatNet& net, TrainingSet set);

/// How to make up for rounding: what the integers are to say, and how to train them to.
struct Compensation {
  const TrainingSet* training = nullptr;
  double robust = 0, decay = 1e-7;
  int threads = 0;
};

/// 16 bits: round_net(). 8 bits: hidden weights are rounded in turn, and what is not yet rounded
/// takes up the error through the Gauss-Newton Hessian [Hassibi and Stork 1993, "optimal brain
/// surgeon"], then by training steps. The neurons are taken in several orders, and the best is kept.
QuantisedNet quantise(const FloatNet& net, int weight_bits, double far_rho,
                      const Compensation& compensation);

/// The same integers with the threshold above which, and for clipped pairs, the engine takes the
/// exact sum. near_rho: 0 (never) or more, below 1, else Error.
QuantisedNet with_near_rho(const QuantisedNet& net, double near_rho);

}  // namespace host
