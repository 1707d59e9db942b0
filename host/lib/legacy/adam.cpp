#include "legacy/adam.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "network/random.hpp"

namespace host {

namespace {

using Matrix = Eigen::MatrixXf;
using Vector = Eigen::VectorXf;

/// A parameter with its moments.
struct Moving {
  Matrix value, mean, square;

  explicit Moving(Matrix start)
      : value(std::move(start)), mean(Matrix::Zero(value.rows(), value.cols())), square(mean) {}

  void step(const Matrix& gradient, float rate, float mean_bias, float square_bias) {
    constexpr float kMean = 0.9F, kSquare = 0.999F, kTiny = 1e-8F;
    mean = kMean * mean + (1 - kMean) * gradient;
    square = kSquare * square + (1 - kSquare) * gradient.cwiseAbs2();
    value.array() -=
        rate * (mean.array() / mean_bias) / ((square.array() / square_bias).sqrt() + kTiny);
  }
};

Matrix squashed(const Matrix& z) { return (1 + (-z.array()).exp()).inverse().matrix(); }

struct Set {
  Matrix input;                       // [24][samples]
  Eigen::RowVectorXf target, weight;  // of a squared difference of y
};

Set set_of(const std::vector<LegacySample>& samples, const AdamSettings& settings) {
  Set set{Matrix(kLegacyInputs, Eigen::Index(samples.size())),
          Eigen::RowVectorXf(Eigen::Index(samples.size())),
          Eigen::RowVectorXf::Ones(Eigen::Index(samples.size()))};
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto column = Eigen::Index(k);
    for (int n = 0; n < kLegacyInputs; ++n) set.input(n, column) = samples[k].input[std::size_t(n)];
    set.target[column] = samples[k].target;
    if (settings.loss == LegacyLoss::relative) {
      const double f = legacy_unscaled(settings.scaling, double(samples[k].target));
      set.weight[column] = float(1 / std::pow(f + settings.floor, 2));
    }
  }
  set.weight /= set.weight.mean();
  return set;
}

struct Parameters {
  Moving hidden, hidden_bias, output, output_bias;
};

Eigen::RowVectorXf outputs(const Parameters& p, const Matrix& input, Matrix* hidden) {
  *hidden = squashed((p.hidden.value * input).colwise() + p.hidden_bias.value.col(0));
  const Matrix z = ((p.output.value * *hidden).array() + p.output_bias.value(0, 0)).matrix();
  return squashed(z).row(0);
}

double loss(const Parameters& p, const Set& set) {
  Matrix hidden;
  const Eigen::RowVectorXf off = outputs(p, set.input, &hidden) - set.target;
  return double((off.array().square() * set.weight.array()).mean());
}

LegacyNet net_of(const Parameters& p, const AdamSettings& settings) {
  LegacyNet net;
  net.hidden = settings.hidden;
  net.scaling = settings.scaling;
  for (int h = 0; h < settings.hidden; ++h) {
    for (int n = 0; n < kLegacyInputs; ++n) net.hidden_weight.push_back(p.hidden.value(h, n));
    net.hidden_bias.push_back(p.hidden_bias.value(h, 0));
    net.output_weight.push_back(p.output.value(0, h));
  }
  net.output_bias = p.output_bias.value(0, 0);
  return net;
}

}  // namespace

LegacyNet train_adam(const LegacySplit& data, const AdamSettings& settings) {
  if (data.training.empty() || data.validation.empty())
    throw Error("Adam needs samples to train on and samples to judge by");
  if (settings.loss == LegacyLoss::relative && settings.scaling != LegacyScaling::linear)
    throw Error("the relative loss is for linear scaling");
  const Set training = set_of(data.training, settings),
            validation = set_of(data.validation, settings);
  Random random(settings.seed, 11);
  const auto draw = [&](int rows, int columns, double size) {
    return Matrix(
        Matrix::NullaryExpr(rows, columns, [&]() { return float(size * random.uniform(-1, 1)); }));
  };
  const int hidden = settings.hidden;
  Parameters p{Moving(draw(hidden, kLegacyInputs, 0.5)), Moving(draw(hidden, 1, 0.5)),
               Moving(draw(1, hidden, 0.1)), Moving(draw(1, 1, 0.1))};
  LegacyNet best = net_of(p, settings);
  double least = loss(p, validation), mean_power = 1, square_power = 1;
  std::vector<int> order(data.training.size());
  std::iota(order.begin(), order.end(), 0);
  const int batches = std::max(1, int(order.size()) / settings.batch);
  Matrix input(kLegacyInputs, settings.batch), activity;
  Eigen::RowVectorXf target(settings.batch), weight(settings.batch);
  for (int epoch = 0; epoch < settings.epochs; ++epoch) {
    random.shuffle(order);
    for (int b = 0; b < batches; ++b) {
      for (int k = 0; k < settings.batch; ++k) {
        const int from = order[std::size_t(b * settings.batch + k) % order.size()];
        input.col(k) = training.input.col(from);
        target[k] = training.target[from];
        weight[k] = training.weight[from];
      }
      const Eigen::RowVectorXf y = outputs(p, input, &activity);
      const Eigen::RowVectorXf out =
          ((y - target).array() * weight.array() * y.array() * (1 - y.array())).matrix() /
          float(settings.batch);
      const Matrix delta =
          ((p.output.value.transpose() * out).array() * activity.array() * (1 - activity.array()))
              .matrix();
      mean_power *= 0.9, square_power *= 0.999;
      const double done = (epoch + double(b) / batches) / settings.epochs;
      const float rate = settings.rate * float(0.5 + 0.5 * std::cos(std::numbers::pi * done));
      const auto step = [&](Moving* moving, const Matrix& gradient) {
        moving->step(gradient, rate, float(1 - mean_power), float(1 - square_power));
      };
      step(&p.output, out * activity.transpose());
      step(&p.output_bias, Matrix::Constant(1, 1, out.sum()));
      step(&p.hidden, delta * input.transpose());
      step(&p.hidden_bias, delta.rowwise().sum());
    }
    const double now = loss(p, validation);
    if (now < least) least = now, best = net_of(p, settings);
  }
  return best;
}

}  // namespace host
