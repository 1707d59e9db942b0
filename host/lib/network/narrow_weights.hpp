// Hidden weights of 8 bits that say what the network in double says.
#pragma once
#include "network/float_net.hpp"
#include "network/quantised_net.hpp"
#include "network/training_set.hpp"

namespace host {

/// How to make up for rounding: what the integers are to say, and how to train them to.
struct Compensation {
  const TrainingSet* training = nullptr;
  double robust = 0, decay = 1e-7;
  int threads = 0;
};

/// Hidden weights are rounded in turn, and what is not yet rounded takes up the error through the
/// Gauss-Newton Hessian [Hassibi and Stork 1993, "optimal brain surgeon"], then by training steps,
/// with the neurons in several orders. From each the whole weights walk to where the loss is least
/// with biases and output weights made up for them (whole_steps.hpp), and the best is kept.
NetTables narrow_net(const FloatNet& net, double far_rho, const Compensation& compensation);

}  // namespace host
