// One scene, its exact solution, and any method's solution beside it.
#pragma once
#include <Eigen/Core>
#include <optional>

#include "pose/pose_table.hpp"
#include "solve/exported_visibility.hpp"
#include "solve/fixed_solve.hpp"

namespace host {

/// Form factors and radiosity in double: reference factors times visible fractions by rays, dense
/// solve.
struct ExactSolution {
  Eigen::MatrixXd form_factors;
  std::vector<Vec3> radiosity;
  double seconds = 0;
};

/// Errors of a method's factors against the exact ones, before repair.
struct FactorErrors {
  double std = 0, max = 0, bias = 0;   ///< over pairs of patches on different planes
  double row_mean = 0, row_worst = 0;  ///< |sum of a row - exact sum|
  std::size_t pairs = 0;
};

struct MethodRun {
  EngineRows rows;            ///< before repair
  EngineRows repaired;        ///< what the engine solved with
  std::vector<double> scale;  ///< repair; empty when the scene is open
  FixedSolution solution;
  // Not numbers where SolveGoal::against_exact is false.
  FactorErrors factors;
  double rms = 0, max = 0;  ///< of B against the exact solution
};

class SceneSolver {
 public:
  /// rays: pairs of points per pair of patches for the exact visibility.
  SceneSolver(const Scene& scene, int threads, bool quiet, int rays = 1024);

  /// How methods of the engine are to run from now on.
  void use(const EngineOptions& options) { options_ = options; }
  /// The engine's pairs take exported visible parts from now on, instead of rays.
  const VisibilityTables& use_visibility(VisibilityCode code);

  const Scene& scene() const { return scene_; }
  const FixedScene& fixed() const { return fixed_; }
  /// Computed once, at the first call.
  const ExactSolution& exact();
  /// The pose table of `table`, made at the first call.
  const PoseTable& poses();
  /// A method of the engine, or a pair method in double whose factors (times the exact visible
  /// fractions) the engine solves with. Throws Error for an unknown method.
  MethodRun run(const MethodSpec& spec, const NetChoice& nets, const SolveGoal& goal);

 private:
  EngineRows rows_of(const MethodSpec& spec, const NetChoice& nets);

  const Scene& scene_;
  FixedScene fixed_;
  int threads_;
  bool quiet_;
  int rays_;
  EngineOptions options_;
  VisibilityTables visibility_;
  std::optional<ExactSolution> exact_;
  std::optional<PoseTable> poses_;
};

}  // namespace host
