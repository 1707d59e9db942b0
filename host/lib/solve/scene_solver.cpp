#include "solve/scene_solver.hpp"

#include <chrono>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/progress.hpp"
#include "method/pair_method.hpp"
#include "solve/embree_visibility.hpp"
#include "solve/exact.hpp"
#include "solve/repair.hpp"

namespace host {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Eigen::MatrixXd matrix(const EngineRows& rows) {
  const auto n = Eigen::Index(rows.patches);
  Eigen::MatrixXd f(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) f(i, j) = rows(std::size_t(i), std::size_t(j));
  }
  return f;
}

/// Whether the engine divides a row by its sum: one above 1 in an open scene, one off by little in a
/// closed one (radiosity.cpp, judge_row()).
bool is_divided(const Scene& scene, double row_sum) {
  return scene.closed ? std::fabs(row_sum - 1) <= 1.0 / 256 : row_sum > 1;
}

/// What shooting with these rows converges to: j gains A_i F_ij / A_j of i's radiosity, whether the
/// rows are reciprocal or not (those of a hemicube are not).
Eigen::MatrixXd gathered(const Scene& scene, const EngineRows& rows) {
  Eigen::MatrixXd f = matrix(rows).transpose();
  for (Eigen::Index i = 0; i < f.cols(); ++i) {
    const double sum = f.col(i).sum();
    if (is_divided(scene, sum)) f.col(i) /= sum;
    for (Eigen::Index j = 0; j < f.rows(); ++j)
      f(j, i) *=
          scene.patches[std::size_t(i)].moments.area / scene.patches[std::size_t(j)].moments.area;
  }
  return f;
}

std::uint32_t uq32(double f) {
  return std::uint32_t(std::min(std::max(std::llround(f * 4294967296.0), 0LL), 4294967295LL));
}

bool on_one_plane(const Scene& scene, std::size_t i, std::size_t j) {
  return scene.patches[i].surface == scene.patches[j].surface &&
         scene.surfaces[std::size_t(scene.patches[i].surface)].planar;
}

FactorErrors factor_errors(const Scene& scene, const Eigen::MatrixXd& f,
                           const Eigen::MatrixXd& exact) {
  FactorErrors errors;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    double row = 0;
    for (std::size_t j = 0; j < scene.patches.size(); ++j) {
      const double off =
          f(Eigen::Index(i), Eigen::Index(j)) - exact(Eigen::Index(i), Eigen::Index(j));
      row += off;
      if (i == j || on_one_plane(scene, i, j)) continue;
      ++errors.pairs;
      sum += off;
      squares += off * off;
      errors.max = std::max(errors.max, std::fabs(off));
    }
    errors.row_mean += std::fabs(row) / double(scene.patches.size());
    errors.row_worst = std::max(errors.row_worst, std::fabs(row));
  }
  const double n = double(std::max<std::size_t>(errors.pairs, 1));
  errors.bias = sum / n;
  errors.std = std::sqrt(std::max(0.0, squares / n - errors.bias * errors.bias));
  return errors;
}

/// Rows after repair, for methods in double; the engine repairs in its own arithmetic.
EngineRows scaled(const EngineRows& rows, const std::vector<double>& scale) {
  EngineRows result = rows;
  for (std::size_t i = 0; i < rows.patches; ++i) {
    for (std::size_t j = 0; j < rows.patches; ++j) {
      result.f_uq32[i * rows.patches + j] = uq32(rows(i, j) * scale[i] * scale[j]);
    }
  }
  return result;
}

}  // namespace

SceneSolver::SceneSolver(const Scene& scene, int threads, bool quiet, int rays)
    : scene_(scene), fixed_(scene), threads_(threads), quiet_(quiet), rays_(rays) {}

const ExactSolution& SceneSolver::exact() {
  if (!exact_) {
    const auto start = std::chrono::steady_clock::now();
    ExactSolution exact;
    exact.form_factors = exact_form_factors(scene_, threads_, rays_);
    exact.radiosity = exact_radiosity(scene_, exact.form_factors);
    exact.seconds = seconds_since(start);
    exact_ = std::move(exact);
  }
  return *exact_;
}

const VisibilityTables& SceneSolver::use_visibility(VisibilityCode code) {
  visibility_ = make_visibility(scene_, fixed_, code, rays_, threads_);
  fixed_.set_visibility(visibility_);
  return visibility_;
}

const PoseTable& SceneSolver::poses() {
  if (!poses_) poses_.emplace(make_pose_table(scene_, fixed_, threads_, rays_));
  return *poses_;
}

EngineRows SceneSolver::rows_of(const MethodSpec& spec, const NetChoice& nets) {
  if (spec.name == "table") {
    EngineOptions options = options_;
    options.poses = &poses().pod();
    return engine_rows(fixed_, spec, nets, options, threads_);
  }
  if (is_engine_method(spec)) return engine_rows(fixed_, spec, nets, options_, threads_);
  if (!is_pair_method(spec)) {
    std::vector<std::string> known = pair_method_names();
    known.insert(known.end(), {"exact", "table", "hybrid[:R]"});
    throw unknown_method(spec, known);
  }
  const FreePairMethod method = pair_method(spec, nets);
  const EmbreeVisibility visibility(scene_, rays_);
  Progress progress(spec.text(), scene_.patches.size() * scene_.patches.size() / 2, quiet_);
  const auto start = std::chrono::steady_clock::now();
  const Eigen::MatrixXd f = dense_form_factors(scene_, threads_, [&](std::size_t i, std::size_t j) {
    progress.add();
    const double seen = scene_.convex ? 1 : visibility.fraction(i, j);
    if (seen == 0) return 0.0;
    return seen * scene_.patches[i].moments.area *
           method.run(scene_.patches[i].polygon, scene_.patches[j].polygon).estimate.f;
  });
  EngineRows rows;
  rows.patches = scene_.patches.size();
  rows.seconds = seconds_since(start);
  rows.f_uq32.reserve(rows.patches * rows.patches);
  for (Eigen::Index i = 0; i < f.rows(); ++i) {
    for (Eigen::Index j = 0; j < f.cols(); ++j) {
      rows.f_uq32.push_back(uq32(f(i, j)));
      ++rows.counters.evaluated;
    }
  }
  return rows;
}

MethodRun SceneSolver::run(const MethodSpec& spec, const NetChoice& nets, const SolveGoal& goal) {
  MethodRun run;
  fixed_.set_scale({});
  run.rows = rows_of(spec, nets);
  const Eigen::MatrixXd f = matrix(run.rows);
  EngineRows repaired_rows = run.rows;
  // A hemicube's rows sum to 1 by themselves, and so do those of exact factors; the report's networks
  // are shown as they are.
  if (scene_.closed && spec.name != "hemicube" && spec.name != "table" && spec.name != "legacy") {
    run.scale = symmetric_scale(scene_, f);
    fixed_.set_scale(run.scale);
    repaired_rows = is_engine_method(spec) ? engine_rows(fixed_, spec, nets, options_, threads_)
                                           : scaled(run.rows, run.scale);
  }
  const std::vector<Vec3> converged = exact_radiosity(scene_, gathered(scene_, repaired_rows));
  run.repaired = repaired_rows;
  run.solution = fixed_solve(scene_, fixed_, repaired_rows, converged, goal);
  if (!goal.against_exact) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    run.factors = {none, none, none, none, none, 0};
    run.rms = run.max = none;
    return run;
  }
  run.factors = factor_errors(scene_, f, exact().form_factors);
  run.rms = relative_rms(scene_, run.solution.radiosity, exact().radiosity);
  run.max = relative_max(scene_, run.solution.radiosity, exact().radiosity);
  return run;
}

}  // namespace host
