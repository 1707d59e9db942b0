#include "accuracy/scene_trials.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "method/engine_source.hpp"
#include "urad/hemicube_table.hpp"
#include "urad/hybrid.hpp"
#include "urad/radiosity.hpp"
#include "urad/urad.h"

namespace host {

namespace {

constexpr int kShotsPerPatch = 64;  // far beyond what reflectances below 0.99 need
constexpr double kPercent = 0.01;
constexpr std::uint64_t kWholeRow = std::uint64_t(1) << 32;

double std_of(const NetFile& net, const char* part) {
  const ErrorRow* row = net.error(part);
  return row ? row->std : 0;
}

/// A turned hemicube over a convex scene with all its memory, and a hybrid on top.
class NearHybrid {
 public:
  NearHybrid(const urad_scene& scene, const urad_net& net, int resolution) {
    const std::size_t quarter = std::size_t(resolution / 2) * std::size_t(resolution / 2);
    std::vector<double> scratch(2 * quarter);
    top_.resize(quarter), side_.resize(quarter);
    urad::fill_hemicube_cells(resolution, scratch.data(), top_.data(), side_.data());
    memory_.resize(
        urad::hemicube_bytes(std::uint16_t(resolution), 0, scene.patch_count, false) / 4 + 1);
    const urad::HemicubeTable table{std::uint16_t(resolution), top_.data(), side_.data()};
    if (urad::hemicube_init(&hemicube_, &scene, table, 0, urad::hemicube_turned, memory_.data(),
                            4 * memory_.size(), &counters_) != urad::Status::ok ||
        urad::hybrid_init(&hybrid_, &hemicube_, urad::Kernel::moment, &net, 1,
                          urad::kThreePatches_uq16) != urad::Status::ok)
      throw Error("a hemicube without item buffer needs a convex scene");
  }
  urad_source source() { return {urad::hybrid_fill, &hybrid_}; }

 private:
  std::vector<std::uint32_t> top_, side_, memory_;
  urad_counters counters_{};
  urad::HemicubeSource hemicube_{};
  urad::HybridSource hybrid_{};
};

EngineRows rows_of(const urad_scene& scene, const urad_source& source) {
  EngineRows rows;
  rows.patches = scene.patch_count;
  rows.f_uq32.resize(rows.patches * rows.patches);
  for (std::uint16_t i = 0; i < scene.patch_count; ++i) {
    for (std::uint16_t s = 0; s < scene.surface_count; ++s) {
      const urad_surface& to = scene.surface[s];
      if (source.fill(source.context, i, s, to.first_patch, to.patch_count,
                      &rows.f_uq32[i * rows.patches + to.first_patch]) != URAD_OK)
        throw Error("the engine refused a row of its own scene");
    }
  }
  return rows;
}

}  // namespace

SolveGoal converged(const Scene& scene) {
  SolveGoal goal;
  goal.shots = kShotsPerPatch * int(scene.patches.size());
  return goal;
}

SceneNetTrial try_scene_net(SceneSolver& solver, NetFile net) {
  SceneNetTrial trial{net.seed, std::move(net), {}, 0, 0, 0};
  const NetChoice choice{{}, &trial.net.quantised16.pod()};
  const MethodRun run = solver.run({"net", ""}, choice, converged(solver.scene()));
  trial.factors = run.factors;
  trial.light = run.rms;
  trial.held_out_std = std_of(trial.net, "held_out");
  trial.train_std = std_of(trial.net, "train");
  return trial;
}

ChipSolve solve_like_a_chip(SceneSolver& solver, const QuantisedNet& net) {
  const Scene& scene = solver.scene();
  const NetChoice choice{{}, &net.pod()};
  FixedScene fixed(scene);
  fixed.set_scale(solver.run({"net", ""}, choice, converged(scene)).scale);
  const EngineSource source(fixed, {"net", ""}, choice, {});

  const std::uint16_t run = urad::longest_run(fixed.pod());
  const std::size_t bytes = urad::radiosity_bytes(fixed.pod().patch_count, run);
  std::vector<std::uint32_t> memory(bytes / 4);
  urad::Radiosity state;
  urad::Status status = urad::radiosity_init(&state, &fixed.pod(), source.source(), URAD_OVERSHOOT,
                                             run, memory.data(), bytes);
  const auto light_error = [&] {
    std::vector<Vec3> light(scene.patches.size());
    for (std::size_t k = 0; k < light.size(); ++k)
      for (int c = 0; c < 3; ++c)
        light[k][c] = urad::radiosity_get(state, std::uint16_t(k), c) * fixed.exitance_unit();
    return relative_rms(scene, light, solver.exact().radiosity);
  };
  ChipSolve solve;
  bool stopped = false;
  for (int shot = 0; status == urad::Status::ok; ++shot) {
    if (!solve.shots_to_percent && light_error() <= kPercent) solve.shots_to_percent = shot;
    if (!stopped && urad::radiosity_done(state, URAD_PERCENT)) {
      stopped = true;
      solve.shots = shot;
      solve.light = light_error();
    }
    if ((stopped && solve.shots_to_percent) || shot == *converged(scene).shots) break;
    status = urad::radiosity_step(&state);
  }
  if (status != urad::Status::ok || !stopped)
    throw Error(scene.name + ": the engine could not solve it by network");
  solve.ram_bytes = bytes + sizeof state + source.ram_bytes();
  solve.net_bytes = net.flash_bytes();
  return solve;
}

HemicubeTrial try_hemicube(SceneSolver& solver, int resolution, int threads) {
  const Scene& scene = solver.scene();
  const MethodSpec spec{"hemicube", std::to_string(resolution)};
  HemicubeTrial trial;
  trial.factors = solver.run(spec, {}, converged(scene)).factors;
  const EngineRows rows = engine_rows(FixedScene(scene), spec, {}, {}, threads);
  trial.rows = rows.patches;
  for (std::size_t i = 0; i < rows.patches; ++i) {
    const auto first = rows.f_uq32.begin() + std::ptrdiff_t(i * rows.patches);
    const std::uint64_t sum =
        std::accumulate(first, first + std::ptrdiff_t(rows.patches), std::uint64_t(0));
    if (sum == kWholeRow) ++trial.exact_rows;
  }
  return trial;
}

double light_by_near_hybrid(SceneSolver& solver, const urad_net& net, int resolution) {
  const Scene& scene = solver.scene();
  const FixedScene fixed(scene);
  NearHybrid hybrid(fixed.pod(), net, resolution);
  const EngineRows rows = rows_of(fixed.pod(), hybrid.source());
  return fixed_solve(scene, fixed, rows, solver.exact().radiosity, converged(scene)).error;
}

}  // namespace host
