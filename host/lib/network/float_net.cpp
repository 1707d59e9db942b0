#include "network/float_net.hpp"

#include <fmt/core.h>

#include <cmath>

#include "base/error.hpp"
#include "urad/net.h"

namespace host {

double sigmoid(double z) { return 1 / (1 + std::exp(-z)); }

FloatNet::FloatNet(int inputs, int hidden) : inputs_(inputs), hidden_(hidden) {
  if (inputs < 1 || inputs > URAD_NET_MAX_INPUTS)
    throw Error(fmt::format("a network has 1 to {} inputs, not {}", URAD_NET_MAX_INPUTS, inputs));
  if (hidden < 1 || hidden > URAD_NET_MAX_HIDDEN)
    throw Error(
        fmt::format("a network has 1 to {} hidden neurons, not {}", URAD_NET_MAX_HIDDEN, hidden));
  parameters = Eigen::VectorXd::Zero(count(inputs, hidden));
}

double FloatNet::run(const std::int16_t* input_q15) const {
  double y = output_bias();
  for (int n = 0; n < inputs_; ++n) y += skip_weight(n) * (input_q15[n] / 32768.0);
  for (int h = 0; h < hidden_; ++h) {
    double z = hidden_bias(h);
    for (int n = 0; n < inputs_; ++n) z += hidden_weight(h, n) * (input_q15[n] / 32768.0);
    y += output_weight(h) * sigmoid(z);
  }
  return y;
}

FloatNet fold_normalisation(const FloatNet& net, const Eigen::VectorXd& mean,
                            const Eigen::VectorXd& deviation) {
  FloatNet folded = net;
  for (int n = 0; n < net.inputs(); ++n) {
    for (int h = 0; h < net.hidden(); ++h) {
      double& weight = folded.parameters[h * net.inputs() + n];
      weight /= deviation[n];
      folded.parameters[net.hidden_bias_at() + h] -= weight * mean[n];
    }
    double& skip = folded.parameters[net.skip_at() + n];
    skip /= deviation[n];
    folded.parameters[net.bias_at()] -= skip * mean[n];
  }
  return folded;
}

FloatNet unfold_normalisation(const FloatNet& net, const Eigen::VectorXd& mean,
                              const Eigen::VectorXd& deviation) {
  // x = deviation * u + mean, that is u = (x - (-mean / deviation)) / (1 / deviation).
  return fold_normalisation(net, (-mean.array() / deviation.array()).matrix(),
                            deviation.cwiseInverse());
}

}  // namespace host
