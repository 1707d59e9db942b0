#include "solve/exact.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <optional>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "form_factor/reference.hpp"
#include "solve/embree_visibility.hpp"

namespace host {
namespace {

// By more than rounding: the two sides of a sheet do not face each other.
bool reaches_front(const Polygon& polygon, const Moments& plane) {
  return std::any_of(polygon.outer.begin(), polygon.outer.end(), [&](const Vec3& x) {
    const Vec3 d = x - plane.centroid;
    const double rounding =
        1e-12 * glm::length(d) + 16 * std::numeric_limits<double>::epsilon() * glm::length(x);
    return glm::dot(plane.normal, d) > rounding;
  });
}

Eigen::VectorXd channel_of(const Scene& scene, int channel, Vec3 Material::*value) {
  Eigen::VectorXd x(Eigen::Index(scene.patches.size()));
  for (Eigen::Index k = 0; k < x.size(); ++k)
    x[k] = (scene.material_of(std::size_t(k)).*value)[channel];
  return x;
}

}  // namespace

bool can_face(const ScenePatch& a, const ScenePatch& b) {
  return reaches_front(a.polygon, b.moments) && reaches_front(b.polygon, a.moments);
}

Eigen::MatrixXd dense_form_factors(const Scene& scene, int threads,
                                   const ExchangeFunction& exchange) {
  const auto& patches = scene.patches;
  const auto n = Eigen::Index(patches.size());
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(n, n);
  parallel_for(patches.size(), threads, [&](std::size_t i) {
    for (std::size_t j = i + 1; j < patches.size(); ++j) {
      const bool same = patches[i].surface == patches[j].surface &&
                        scene.surfaces[std::size_t(patches[i].surface)].planar;
      if (same || !can_face(patches[i], patches[j])) continue;
      const double g = exchange(i, j);
      f(Eigen::Index(i), Eigen::Index(j)) = g / patches[i].moments.area;
      f(Eigen::Index(j), Eigen::Index(i)) = g / patches[j].moments.area;
    }
  });
  return f;
}

Eigen::MatrixXd exact_form_factors(const Scene& scene, int threads, int rays) {
  const EmbreeVisibility visibility(scene, rays);
  return dense_form_factors(scene, threads, [&](std::size_t i, std::size_t j) {
    const double visible = visibility.fraction(i, j);
    if (visible == 0) return 0.0;
    return visible * reference_exchange(scene.patches[i].polygon, scene.patches[j].polygon);
  });
}

std::vector<Vec3> exact_radiosity(const Scene& scene, const Eigen::MatrixXd& form_factors) {
  const auto n = Eigen::Index(scene.patches.size());
  if (form_factors.rows() != n || form_factors.cols() != n)
    throw Error(fmt::format("{}: {} x {} form factors for {} patches", scene.name,
                            form_factors.rows(), form_factors.cols(), n));
  std::vector<Vec3> radiosity(scene.patches.size(), Vec3(0));
  Eigen::VectorXd factored_for;
  std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> lu;
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::VectorXd exitance = channel_of(scene, channel, &Material::exitance);
    if (exitance.isZero(0)) continue;
    const Eigen::VectorXd reflectance = channel_of(scene, channel, &Material::reflectance);
    if (!lu || reflectance != factored_for) {
      lu.emplace(Eigen::MatrixXd::Identity(n, n) - reflectance.asDiagonal() * form_factors);
      factored_for = reflectance;
    }
    const Eigen::VectorXd solution = lu->solve(exitance);
    // rcond of a scene whose light loses the part 1 - rho at each bounce is of that order.
    if (!solution.allFinite() || !(lu->rcond() > 1e-14))
      throw Error(
          scene.name +
          ": the light never dies down: a closed scene needs a reflectance below 1 somewhere");
    for (Eigen::Index k = 0; k < n; ++k) radiosity[std::size_t(k)][channel] = solution[k];
  }
  return radiosity;
}

}  // namespace host
