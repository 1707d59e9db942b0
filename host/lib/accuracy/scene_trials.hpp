// What networks and hemicubes make of a scene, seed by seed: factors, rows and light.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "accuracy/method_table.hpp"
#include "network/net_json.hpp"
#include "solve/scene_solver.hpp"

namespace host {

/// A network trained for the scene, and what came of it. All by the engine's integers.
struct SceneNetTrial {
  std::uint64_t seed = 0;
  NetFile net;
  FactorErrors factors;  ///< before repair
  double light = 0;      ///< relative rms of the converged B against the exact solution
  double held_out_std = 0, train_std = 0;
};

/// Shoots until nothing is left.
SolveGoal converged(const Scene& scene);

/// Factors and light of a network in a scene, repaired as the scene asks.
SceneNetTrial try_scene_net(SceneSolver& solver, NetFile net);

/// What a chip does: shoots until the engine's own estimate says 1 %.
struct ChipSolve {
  int shots = 0;
  int shots_to_percent = 0;   ///< to 1 % indeed
  double light = 0;           ///< relative rms of B against the exact solution
  std::size_t ram_bytes = 0;  ///< of solver and source
  int net_bytes = 0;
};
ChipSolve solve_like_a_chip(SceneSolver& solver, const QuantisedNet& net);

/// Rows of a turned hemicube.
struct HemicubeTrial {
  FactorErrors factors;
  std::size_t rows = 0, exact_rows = 0;  ///< that sum to 2^32 units, not one more or less
};
HemicubeTrial try_hemicube(SceneSolver& solver, int resolution, int threads);

/// Light by a hemicube whose factors of pairs closer than three patches are the network's: relative
/// rms of the converged B. For convex scenes.
double light_by_near_hybrid(SceneSolver& solver, const urad_net& net, int resolution);

}  // namespace host
