#include "accuracy/error_training.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

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
  Eigen::MatrixXd hidden;  // (n + 1) x kErrorHidden
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

Scaling scaling_of(const std::vector<ErrorSample>& samples, int traits) {
  Scaling scaling{Eigen::VectorXd::Zero(traits), Eigen::VectorXd::Zero(traits)};
  for (const ErrorSample& sample : samples)
    for (int k = 0; k < traits; ++k) scaling.mean[k] += double(sample.trait[std::size_t(k)]);
  scaling.mean /= double(samples.size());
  for (const ErrorSample& sample : samples)
    for (int k = 0; k < traits; ++k)
      scaling.spread[k] += std::pow(double(sample.trait[std::size_t(k)]) - scaling.mean[k], 2);
  scaling.spread = (scaling.spread / double(samples.size())).cwiseSqrt().cwiseMax(kLeastSpread);
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
  for (int h = 0; h < kErrorHidden; ++h) {
    double hidden_bias = net.hidden(traits, h);
    for (int k = 0; k < traits; ++k) {
      const double weight = net.hidden(k, h) / scaling.spread[k];
      model.weight_q10[h][k] = q10(weight);
      hidden_bias -= weight * scaling.mean[k];
    }
    model.hidden_bias_q18[h] =
        std::int32_t(std::lround(std::clamp(hidden_bias, -300., 300.) * 0x1p18));
    model.out_q8[h] = q8(net.out[h]);
  }
  return model;
}

}  // namespace

urad::ErrorModel train_error_model(const std::vector<ErrorSample>& samples, int traits,
                                   double quantile, std::uint64_t seed, int steps) {
  if (samples.empty()) throw Error("no pairs to fit the error of a way to; ask for more pairs");
  const Scaling scaling = scaling_of(samples, traits);
  Random random(seed);
  Layers net{Eigen::MatrixXd(traits + 1, kErrorHidden), Eigen::VectorXd::Zero(kErrorHidden),
             Eigen::VectorXd::Zero(traits + 1)};
  for (double& x : net.hidden.reshaped()) x = kStart * random.normal();
  Eigen::VectorXd all = net.flat();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(all.size()), square = mean;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Ones(kBatch, traits + 1);
  Eigen::VectorXd errors(kBatch);
  double forgotten_mean = 1, forgotten_square = 1;
  for (int step = 0; step < steps; ++step) {
    for (int r = 0; r < kBatch; ++r) {
      const ErrorSample& sample = samples[std::size_t(random.below(int(samples.size())))];
      for (int k = 0; k < traits; ++k)
        rows(r, k) = (double(sample.trait[std::size_t(k)]) - scaling.mean[k]) / scaling.spread[k];
      errors[r] = double(sample.error);
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
  return rounded(net, scaling, traits);
}

}  // namespace host
