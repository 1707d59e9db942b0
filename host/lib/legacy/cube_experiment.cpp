#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "legacy/reproduce.hpp"
#include "scene/builtin.hpp"
#include "solve/exact.hpp"

namespace host {

namespace {

/// The eye stands before the luminous wall and sees the five others.
Camera from_inside() {
  Camera camera;
  camera.eye = {0.5, 0.5, 0.02};
  camera.target = {0.5, 0.5, 1};
  camera.field_of_view = 90;
  camera.mirrored = true;
  return camera;
}

bool see_each_other(const Scene& scene, std::size_t i, std::size_t j) {
  return scene.patches[i].surface != scene.patches[j].surface &&
         can_face(scene.patches[i], scene.patches[j]);
}

template <class Run>
Eigen::MatrixXd factors_of(const Scene& scene, int threads, Run&& run) {
  const auto n = Eigen::Index(scene.patches.size());
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(n, n);
  parallel_for(scene.patches.size(), threads, [&](std::size_t i) {
    for (std::size_t j = 0; j < scene.patches.size(); ++j) {
      if (!see_each_other(scene, i, j)) continue;
      f(Eigen::Index(i), Eigen::Index(j)) =
          run(legacy_input(scene.patches[i].polygon, scene.patches[j].polygon));
    }
  });
  return f;
}

/// Of a net's integers, over all 86,436 pairs.
LegacyErrors measured(const CubeExperiment& cube, const LegacyFixed& net) {
  const Eigen::MatrixXd f =
      factors_of(cube.scene, 1, [&](const LegacyInput& input) { return net.form_factor(input); });
  const Eigen::MatrixXd off = f - cube.exact;
  std::vector<double> relative;
  for (Eigen::Index k = 0; k < off.size(); ++k)
    if (cube.exact.data()[k] > 0)
      relative.push_back(std::fabs(off.data()[k]) / cube.exact.data()[k]);
  const auto rank = std::ptrdiff_t(0.99 * double(relative.size() - 1));
  std::nth_element(relative.begin(), relative.begin() + rank, relative.end());
  const Eigen::VectorXd rows = off.rowwise().sum().cwiseAbs();
  const double bias = off.mean();
  return {std::sqrt((off.array() - bias).square().mean()), bias, relative[std::size_t(rank)],
          rows.mean(), rows.maxCoeff()};
}

}  // namespace

std::vector<LegacySample> legacy_samples(const CubeExperiment& cube, LegacyScaling scaling) {
  std::vector<LegacySample> samples;
  const auto& patches = cube.scene.patches;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (std::size_t j = 0; j < patches.size(); ++j) {
      if (!see_each_other(cube.scene, i, j)) continue;
      samples.push_back(
          {legacy_input(patches[i].polygon, patches[j].polygon),
           float(legacy_scaled(scaling, cube.exact(Eigen::Index(i), Eigen::Index(j))))});
    }
  }
  return samples;
}

CubeExperiment cube_experiment(const ReproduceRequest& request, int hidden) {
  CubeExperiment cube;
  cube.scene = load_scene("cube7");
  cube.scene.camera = from_inside();
  cube.exact = exact_form_factors(cube.scene, request.threads, 1);
  const LegacySplit linear =
                        legacy_split(legacy_samples(cube, LegacyScaling::linear), request.seed),
                    log = legacy_split(legacy_samples(cube, LegacyScaling::log), request.seed);
  std::vector<LegacyJob> jobs;
  const auto add = [&](LegacyScaling scaling, int units) {
    if (hidden > 0 && (units != hidden || scaling != LegacyScaling::linear)) return;
    LegacyJob job;
    job.file = fmt::format("{}{}", name(scaling), units);
    job.command =
        fmt::format("urad reproduce table4.1 --epochs {} --seed {}", request.epochs, request.seed);
    job.subject = fmt::format(
        "cube7, {} scaling: the 72030 ordered pairs that face each other, 80 % trained on, 10 % "
        "chose the state",
        name(scaling));
    job.settings.hidden = units;
    job.settings.scaling = scaling;
    job.settings.epochs = request.epochs;
    job.settings.seed = request.seed;
    job.data = scaling == LegacyScaling::linear ? &linear : &log;
    job.measure = [&cube](const LegacyFixed& net) { return measured(cube, net); };
    jobs.push_back(std::move(job));
  };
  for (const int units : {50, 30, 15, 5}) add(LegacyScaling::linear, units);
  for (const int units : {30, 15, 5}) add(LegacyScaling::log, units);
  cube.nets = train_legacy(jobs, request.folder + "/nets", request.threads, request.quiet);
  return cube;
}

Eigen::MatrixXd legacy_factors(const Scene& scene, const LegacyNet& net, int threads) {
  return factors_of(scene, threads,
                    [&](const LegacyInput& input) { return net.form_factor(input); });
}

double spectral_radius(const Eigen::MatrixXd& matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace host
