// The network of urad/net.h in double: what the trainer fits and the quantiser rounds.
#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace host {

/// y = b + sum_h v_h sigma(z_h) + sum_n s_n x_n,  z_h = b_h + sum_n w_hn x_n.  Inputs are the
/// engine's Q0.15 integers as reals, x = input / 2^15, with no other normalisation; y is the
/// correction in units of log2.
class FloatNet {
 public:
  FloatNet() = default;
  /// All parameters 0. 1 <= inputs <= URAD_NET_MAX_INPUTS, 1 <= hidden <= URAD_NET_MAX_HIDDEN, else
  /// Error.
  FloatNet(int inputs, int hidden);

  int inputs() const { return inputs_; }
  int hidden() const { return hidden_; }

  /// Number of parameters of such a net.
  static int count(int inputs, int hidden) { return hidden * (inputs + 2) + inputs + 1; }

  /// Everything in one vector: hidden weights row by row, hidden biases, output weights, skip
  /// weights, output bias.
  Eigen::VectorXd parameters;

  int hidden_bias_at() const { return hidden_ * inputs_; }
  int output_at() const { return hidden_bias_at() + hidden_; }
  int skip_at() const { return output_at() + hidden_; }
  int bias_at() const { return skip_at() + inputs_; }

  double hidden_weight(int h, int n) const { return parameters[h * inputs_ + n]; }
  double hidden_bias(int h) const { return parameters[hidden_bias_at() + h]; }
  double output_weight(int h) const { return parameters[output_at() + h]; }
  double skip_weight(int n) const { return parameters[skip_at() + n]; }
  double output_bias() const { return parameters[bias_at()]; }

  /// y for inputs() integers in Q0.15.
  double run(const std::int16_t* input_q15) const;

 private:
  int inputs_ = 0, hidden_ = 0;
};

/// The same function of x, for a net whose inputs were (x - mean) / deviation: the normalisation
/// moves into the weights.
FloatNet fold_normalisation(const FloatNet& net, const Eigen::VectorXd& mean,
                            const Eigen::VectorXd& deviation);

/// The inverse of fold_normalisation().
FloatNet unfold_normalisation(const FloatNet& net, const Eigen::VectorXd& mean,
                              const Eigen::VectorXd& deviation);

/// 1 / (1 + e^-z).
double sigmoid(double z);

}  // namespace host
