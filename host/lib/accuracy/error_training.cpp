#include "accuracy/error_training.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "base/error.hpp"
#include "network/random.hpp"

namespace host {

namespace {

using urad::kErrorHidden;

constexpr int kBatch = 512;
constexpr double kRate = 0.02, kLeastRate = 2e-4;
constexpr double kMomentum = 0.9, kSquares = 0.999, kTiny = 1e-8;
constexpr double kDecay = 1e-5;
constexpr double kSoft = 0.25;  // bits: the loss is round where it would have its corner
constexpr double kStart = 0.5;
constexpr double kLeastSpread = 0.25;  // bits: a trait that hardly varies is not blown up

/// weights of the hidden layer (with bias), of the output, and past the hidden layer (with bias).
struct Layers {
  Eigen::MatrixXd hidden;  // (n + 1) x hidden neurons
  Eigen::VectorXd out, skip;

  Eigen::VectorXd flat() const {
    Eigen::VectorXd all(hidden.size() + out.size() + skip.size());
    all << hidden.reshaped(), out, skip;
    return all;
  }
  void set(const Eigen::VectorXd& all) {
    hidden.reshaped() = all.head(hidden.size());
    out = all.segment(hidden.size(), out.size());
    skip = all.tail(skip.size());
  }
};

/// The gradient of the mean loss over a batch of rows, the last column of which is 1.
Layers gradient(const Layers& net, const Eigen::MatrixXd& rows, const Eigen::VectorXd& errors,
                double quantile) {
  const Eigen::MatrixXd sigma = (1 + (-(rows * net.hidden).array()).exp()).inverse();
  const Eigen::VectorXd off = errors - sigma * net.out - rows * net.skip;
  const Eigen::VectorXd slope = off.unaryExpr([&](double x) {
    return (x > 0 ? -quantile : 1 - quantile) * std::min(1.0, std::fabs(x) / kSoft);
  }) / double(rows.rows());
  const Eigen::MatrixXd back =
      (slope * net.out.transpose()).array() * sigma.array() * (1 - sigma.array());
  return {rows.transpose() * back, sigma.transpose() * slope, rows.transpose() * slope};
}

struct Scaling {
  Eigen::VectorXd mean, spread;
};

Scaling scaling_of(const Eigen::MatrixXd& traits) {
  const auto count = double(traits.rows());
  Scaling scaling{Eigen::VectorXd::Zero(traits.cols()), Eigen::VectorXd::Zero(traits.cols())};
  for (Eigen::Index k = 0; k < traits.cols(); ++k) {
    for (const double x : traits.col(k)) scaling.mean[k] += x;
    scaling.mean[k] /= count;
    for (const double x : traits.col(k)) scaling.spread[k] += std::pow(x - scaling.mean[k], 2);
  }
  scaling.spread = (scaling.spread / count).cwiseSqrt().cwiseMax(kLeastSpread);
  return scaling;
}

/// Integers for traits as they are.
urad::ErrorModel rounded(const Layers& net, const Scaling& scaling, int traits) {
  urad::ErrorModel model{};
  model.traits = std::uint8_t(traits);
  const auto q10 = [](double x) {
    constexpr double most = urad::kErrorWeightLimit_q10;
    return std::int16_t(std::lround(std::clamp(x * 1024, -most, most)));
  };
  const auto q8 = [](double x) {
    return std::int16_t(std::lround(std::clamp(x * 256, -32767., 32767.)));
  };
  double bias = net.skip[traits];
  for (int k = 0; k < traits; ++k) {
    const double weight = net.skip[k] / scaling.spread[k];
    model.skip_q10[k] = q10(weight);
    bias -= weight * scaling.mean[k];
  }
  model.bias_q8 = q8(bias);
  std::array<int, kErrorHidden> order;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::abs(q8(net.out[a])) > std::abs(q8(net.out[b]));
  });
  for (int h = 0; h < kErrorHidden; ++h) {
    const int from = order[std::size_t(h)];
    double hidden_bias = net.hidden(traits, from);
    for (int k = 0; k < traits; ++k) {
      const double weight = net.hidden(k, from) / scaling.spread[k];
      model.weight_q10[h][k] = q10(weight);
      hidden_bias -= weight * scaling.mean[k];
    }
    model.hidden_bias_q18[h] =
        std::int32_t(std::lround(std::clamp(hidden_bias, -300., 300.) * 0x1p18));
    model.out_q8[h] = q8(net.out[from]);
  }
  return model;
}

/// Adam on the quantile loss.
Layers trained(const Eigen::MatrixXd& traits, const Eigen::VectorXd& all_errors, int hidden,
               double quantile, std::uint64_t seed, int steps, const Scaling& scaling) {
  const auto count = int(traits.cols());
  Random random(seed);
  Layers net{Eigen::MatrixXd(count + 1, hidden), Eigen::VectorXd::Zero(hidden),
             Eigen::VectorXd::Zero(count + 1)};
  for (double& x : net.hidden.reshaped()) x = kStart * random.normal();
  Eigen::VectorXd all = net.flat();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(all.size()), square = mean;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Ones(kBatch, count + 1);
  Eigen::VectorXd errors(kBatch);
  double forgotten_mean = 1, forgotten_square = 1;
  for (int step = 0; step < steps; ++step) {
    for (int r = 0; r < kBatch; ++r) {
      const Eigen::Index sample = random.below(int(traits.rows()));
      for (int k = 0; k < count; ++k)
        rows(r, k) = (traits(sample, k) - scaling.mean[k]) / scaling.spread[k];
      errors[r] = all_errors[sample];
    }
    const Eigen::VectorXd slope = gradient(net, rows, errors, quantile).flat() + kDecay * all;
    mean = kMomentum * mean + (1 - kMomentum) * slope;
    square = kSquares * square + (1 - kSquares) * slope.cwiseAbs2();
    forgotten_mean *= kMomentum, forgotten_square *= kSquares;
    const double rate = kLeastRate + (kRate - kLeastRate) * (1 - double(step) / steps);
    all.array() -= rate * (mean.array() / (1 - forgotten_mean)) /
                   ((square.array() / (1 - forgotten_square)).sqrt() + kTiny);
    net.set(all);
  }
  return net;
}

}  // namespace

urad::ErrorModel train_error_model(const std::vector<ErrorSample>& samples, int traits,
                                   double quantile, std::uint64_t seed, int steps) {
  if (samples.empty()) throw Error("no pairs to fit the error of a way to; ask for more pairs");
  Eigen::MatrixXd rows(Eigen::Index(samples.size()), traits);
  Eigen::VectorXd errors(Eigen::Index(samples.size()));
  for (std::size_t n = 0; n < samples.size(); ++n) {
    for (int k = 0; k < traits; ++k)
      rows(Eigen::Index(n), k) = double(samples[n].trait[std::size_t(k)]);
    errors[Eigen::Index(n)] = double(samples[n].error);
  }
  const Scaling scaling = scaling_of(rows);
  return rounded(trained(rows, errors, kErrorHidden, quantile, seed, steps, scaling), scaling,
                 traits);
}

Eigen::VectorXd guess_errors(const Eigen::MatrixXd& traits, const Eigen::VectorXd& errors,
                             const Eigen::MatrixXd& others, const GuessSettings& settings) {
  const Scaling scaling = scaling_of(traits);
  const Layers net = trained(traits, errors, settings.hidden, settings.quantile, settings.seed,
                             settings.steps, scaling);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Ones(others.rows(), others.cols() + 1);
  rows.leftCols(others.cols()) = (others.rowwise() - scaling.mean.transpose()).array().rowwise() /
                                 scaling.spread.transpose().array();
  const Eigen::MatrixXd sigma = (1 + (-(rows * net.hidden).array()).exp()).inverse();
  return sigma * net.out + rows * net.skip;
}

}  // namespace host
