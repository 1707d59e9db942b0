#include <fmt/format.h>

#include <cmath>

#include "legacy/experiments.hpp"
#include "network/random.hpp"
#include "report/picture.hpp"
#include "report/text.hpp"
#include "solve/exact.hpp"
#include "solve/fixed_solve.hpp"

namespace host {

namespace {

constexpr int kPicture = 160;

/// Neighbours within a wall of the cube.
template <class Visit>
void for_each_edge(const Scene& scene, Visit&& visit) {
  for (const Surface& surface : scene.surfaces) {
    const int w = surface.grid->count_u, h = surface.grid->count_v;
    for (int v = 0; v < h; ++v)
      for (int u = 0; u < w; ++u) {
        const auto at = [&](int x, int y) {
          const int patch = surface.first_patch + y * w + x;
          return std::size_t(patch);
        };
        if (u + 1 < w) visit(at(u, v), at(u + 1, v));
        if (v + 1 < h) visit(at(u, v), at(u, v + 1));
      }
  }
}

/// rms over neighbours of the error of their difference, relative to the rms of B: false edges.
double edge_error(const Scene& scene, const std::vector<Vec3>& b, const std::vector<Vec3>& exact) {
  double off = 0, level = 0;
  int edges = 0, patches = 0;
  for_each_edge(scene, [&](std::size_t i, std::size_t j) {
    if (scene.material_of(i).reflectance == Vec3(0)) return;
    const Vec3 d = (b[i] - exact[i]) - (b[j] - exact[j]);
    off += glm::dot(d, d), ++edges;
  });
  for (std::size_t k = 0; k < exact.size(); ++k) {
    if (scene.material_of(k).reflectance == Vec3(0)) continue;
    level += glm::dot(exact[k], exact[k]), ++patches;
  }
  return std::sqrt(off / edges) / std::sqrt(level / patches);
}

double picture_rms(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.pixels.size(); ++k)
    sum += std::pow(double(a.pixels[k]) - double(b.pixels[k]), 2);
  return std::sqrt(sum / double(a.pixels.size()));
}

}  // namespace

ResultTable experiment_spread(const ExperimentRequest& request, const CubeExperiment& cube) {
  const std::vector<Vec3> exact = exact_radiosity(cube.scene, cube.exact);
  PictureOptions options;
  options.width = options.height = kPicture;
  options.threads = request.base.threads;
  const View view(cube.scene, options);
  const double white = white_level(cube.scene, exact);
  const Image truth = view.picture(exact, Shading::kFlat, white);
  ResultTable table{"experiment_spread",
                    "Is the standard deviation visually more telling than the mean error? Bias and "
                    "noise of one size added to the cube's factors",
                    {"added to F", "row error", "rms of B", "false edges", "picture rms of 255"},
                    {},
                    {}};
  const auto add = [&](const std::string& name, auto&& error) {
    Eigen::MatrixXd f = cube.exact;
    for (Eigen::Index i = 0; i < f.rows(); ++i)
      for (Eigen::Index j = 0; j < f.cols(); ++j)
        if (cube.exact(i, j) > 0) f(i, j) += error(i, j);
    const std::vector<Vec3> b = exact_radiosity(cube.scene, f);
    const double rows = (f - cube.exact).rowwise().sum().cwiseAbs().mean();
    table.rows.push_back(
        {name, percent(rows), percent(relative_rms(cube.scene, b, exact)),
         percent(edge_error(cube.scene, b, exact)),
         fmt::format("{:.2f}", picture_rms(view.picture(b, Shading::kFlat, white), truth))});
  };
  for (const double size : {4.1e-5, 4.1e-4, 1e-3, 4.3e-3}) {
    Random random(request.base.seed, 9);
    Eigen::MatrixXd noise = cube.exact;
    for (double& x : noise.reshaped()) x = random.normal();
    const Eigen::MatrixXd both = (noise + noise.transpose()) / std::sqrt(2.0);
    add(fmt::format("bias {:.1e}", size), [&](Eigen::Index, Eigen::Index) { return size; });
    add(fmt::format("noise {:.1e}, reciprocal", size),
        [&](Eigen::Index i, Eigen::Index j) { return size * both(i, j); });
    add(fmt::format("noise {:.1e}", size),
        [&](Eigen::Index i, Eigen::Index j) { return size * noise(i, j); });
  }
  for (const double size : {0.01, 0.1}) {
    Random random(request.base.seed, 10);
    add(fmt::format("bias {:.0f} % of F", 100 * size),
        [&](Eigen::Index i, Eigen::Index j) { return size * cube.exact(i, j); });
    add(fmt::format("noise {:.0f} % of F", 100 * size),
        [&](Eigen::Index i, Eigen::Index j) { return size * cube.exact(i, j) * random.normal(); });
  }
  table.notes = {fmt::format(
      "Every facing pair of the cube gets the error; noise is Gaussian, seed {}. Row error: mean "
      "size of sum - 1. False edges: rms error of the difference of neighbouring patches over the "
      "rms of B. Picture: Figure 4.3's view, {} pixels a side, rms over 8-bit sRGB values.",
      request.base.seed, kPicture)};
  return table;
}

}  // namespace host
