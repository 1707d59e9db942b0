// The engine's progressive refinement on the host, with every number a report wants.
#pragma once
#include <optional>
#include <vector>

#include "method/engine_source.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/radiosity.h"

namespace host {

/// When to stop: after `shots`, or once the relative rms error of B against the converged solution
/// of the same factors is at most `error`, whichever is given.
struct SolveGoal {
  std::optional<int> shots;
  double error = 0.01;
  bool overshoot = true;
  bool against_exact = true;  ///< compare with the exact solution: the dearest part of large scenes
};

struct FixedSolution {
  std::vector<Vec3> radiosity;    ///< B per patch, in the file's unit
  std::vector<std::int32_t> raw;  ///< the engine's integers, [patch][channel]
  int shots = 0;
  double error = 0;  ///< reached, against the converged solution of the same factors
  urad_ledger ledger{};
  bool ledger_exact = false;
  urad_radiosity_counters counters{};
  std::size_t ram_bytes = 0;  ///< of the solver
  urad_status status = URAD_OK;
  double seconds = 0;
};

/// Solves with the factors of `rows` (after repair). `converged`: B of the same factors, solved
/// densely.
FixedSolution fixed_solve(const Scene& scene, const FixedScene& fixed, const EngineRows& rows,
                          const std::vector<Vec3>& converged, const SolveGoal& goal);

/// Relative rms over all channels of patches that reflect: sqrt(sum |B - truth|^2 / sum |truth|^2);
/// lamps' own exitance is left out of both.
double relative_rms(const Scene& scene, const std::vector<Vec3>& radiosity,
                    const std::vector<Vec3>& truth);

/// Largest |B - truth| of a patch and channel over the largest truth, emission left out.
double relative_max(const Scene& scene, const std::vector<Vec3>& radiosity,
                    const std::vector<Vec3>& truth);

}  // namespace host
