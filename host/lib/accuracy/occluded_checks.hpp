// The engine's visibility against printed factors of plates with something between them.
#pragma once
#include <string>
#include <vector>

#include "accuracy/known_values.hpp"

namespace host {

struct OccludedCheck {
  std::string name;
  double f = 0;         ///< printed
  double hybrid = 0;    ///< hybrid:64, the first polygon cut into 4 x 4 pieces
  double rays = 0;      ///< rays:256, uncut
  double rays_cut = 0;  ///< rays:256, 4 x 4 pieces
};

/// The same path as `urad formfactor --scene`. Throws Error when a method gives no factor.
std::vector<OccludedCheck> check_occluded(const std::vector<KnownValue>& values, int threads);

}  // namespace host
