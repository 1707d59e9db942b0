// How many shots a solve will take, before any factor of the method that is asked about exists.
#pragma once
#include <cstdint>
#include <vector>

#include "scene/fixed_scene.hpp"

namespace host {

/// The engine's own solver, fed with the centre kernel, two rays a pair and rows brought to 1 in a
/// closed scene: shots and shooters depend on where light goes, hardly on how exactly.
struct Rehearsal {
  double shots = 0;                     ///< until the engine's estimate is `error`
  double updates = 0;                   ///< receivers times channels, over all shots
  std::vector<std::uint16_t> shooters;  ///< in order; fewer than shots if it stopped before
  std::vector<double> light;            ///< B per patch, mean of the channels, in the engine's unit
  bool complete = true;                 ///< false: shots and updates are extrapolated
};

/// Evaluates 3 million pairs at most, 300,000 where blockers stand between them: a quarter of a
/// second or so, and the same answer on every machine.
Rehearsal rehearse(const FixedScene& scene, double error);

}  // namespace host
