// The report's training: online backpropagation of the squared error, one step a sample, the state
// with the least validation error kept (sections 2.8 and 4.2.3).
#pragma once
#include <functional>
#include <vector>

#include "legacy/legacy_net.hpp"

namespace host {

struct LegacySample {
  LegacyInput input{};
  float target = 0;  ///< scaled, in (0, 1)
};

/// 80 % to train on, 10 % that choose the state, 10 % that nothing looks at before the end.
struct LegacySplit {
  std::vector<LegacySample> training, validation, test;
};

/// Deals `samples` out at random, by `seed`.
LegacySplit legacy_split(std::vector<LegacySample> samples, std::uint64_t seed);

struct BackpropSettings {
  int hidden = 50;
  LegacyScaling scaling = LegacyScaling::linear;
  int epochs = 4000;
  float hidden_rate = 1.0F, output_rate = 0.1F;
  std::uint64_t seed = 1;  ///< start weights and the order of the samples in every epoch
};

/// Everything that a run needs to go on where it stopped; the result is then the same, bit for bit.
struct BackpropState {
  int epoch = 0;  ///< epochs done
  LegacyNet net;  ///< after them
  LegacyNet best;
  double best_error = 0;  ///< mean squared validation error of `best`, scaled
  int best_epoch = 0;
};

/// Weights uniform in +-0.5: the report does not say.
BackpropState backprop_start(const BackpropSettings& settings);

/// Trains until settings.epochs are done or `after_epoch` returns false. Samples come in a new
/// random order in every epoch. Sums run in the same order on every processor: the same bits with
/// vectors of any width. Needs training and validation samples, else Error.
void backprop(const LegacySplit& data, const BackpropSettings& settings, BackpropState* state,
              const std::function<bool(const BackpropState&)>& after_epoch = {});

/// Mean squared error of the scaled output.
double legacy_error(const LegacyNet& net, const std::vector<LegacySample>& samples);

}  // namespace host
