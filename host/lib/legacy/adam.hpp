// A modern optimiser for the report's architecture: Adam on small batches [Kingma and Ba 2015], the
// step falling to zero along a cosine.
#pragma once
#include <vector>

#include "legacy/backprop.hpp"

namespace host {

/// What is minimised, per sample, for the scaled output y and target t.
enum class LegacyLoss {
  squared,   ///< (y - t)^2
  relative,  ///< (F(y) - F)^2 / (F + floor)^2, linear scaling only
};

struct AdamSettings {
  int hidden = 50;
  LegacyScaling scaling = LegacyScaling::linear;
  LegacyLoss loss = LegacyLoss::squared;
  double floor = 1e-3;  ///< of the relative loss
  int epochs = 60, batch = 64;
  float rate = 5e-3F;
  std::uint64_t seed = 1;
};

/// The state with the least validation loss.
LegacyNet train_adam(const LegacySplit& data, const AdamSettings& settings);

}  // namespace host
