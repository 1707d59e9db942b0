// Small networks that guess the logarithm of an error (urad/error_model.hpp), trained in double and
// rounded to the engine's integers.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "urad/error_model.hpp"

namespace host {

/// One pair on one way.
struct ErrorSample {
  std::array<float, urad::kTraits> trait{};  ///< log2
  float error = 0;                           ///< log2 of the relative error
};

inline constexpr int kErrorSteps = 30000;

/// The network whose guess lies above `quantile` of the errors, all else equal: Adam [Kingma and Ba
/// 2015] on the quantile loss [Koenker and Bassett 1978]. traits: the first so many are inputs.
/// The same for the same samples and seed. No shifts. Throws Error when there are no samples.
urad::ErrorModel train_error_model(const std::vector<ErrorSample>& samples, int traits,
                                   double quantile, std::uint64_t seed, int steps = kErrorSteps);

struct GuessSettings {
  int hidden = 16;
  double quantile = 0.99;
  std::uint64_t seed = 1;
  int steps = kErrorSteps;
};

/// The same in double, of any width and for any traits: fitted to the first, [sample][trait] and
/// [sample], asked about the others.
Eigen::VectorXd guess_errors(const Eigen::MatrixXd& traits, const Eigen::VectorXd& errors,
                             const Eigen::MatrixXd& others, const GuessSettings& settings);

}  // namespace host
