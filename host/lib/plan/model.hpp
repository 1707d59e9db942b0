// The forms whose constants a tool fits (bench/plan): what a solve costs beside its rows, and how far
// a method's light is off.
#pragma once
#include <string_view>

#include "plan/work.hpp"

namespace host {

/// Instructions of the solver itself on a Cortex-M0, -O2.
struct SolverCost {
  double shot = 0, surface = 0, patch = 0,
         update = 0;  ///< of a shot: 1, surfaces, patches, updates
  double init = 0, init_patch = 0;

  double of_shot(double surfaces, double patches, double updates) const {
    return shot + surface * surfaces + patch * patches + update * updates;
  }
};

/// B is off by `factor` times what the sample says of one bounce (sample.hpp), or by `constant` where
/// there is nothing to sample.
struct MethodError {
  std::string_view family;
  double factor = 1, constant = 0;
};

/// Functions of the engine that a program by this method links, bytes of flash, -Os.
struct MethodCode {
  std::string_view family;
  std::size_t bytes = 0;
};

}  // namespace host
