#include "solve/repair.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"

namespace host {

std::vector<double> symmetric_scale(const Scene& scene, const Eigen::MatrixXd& form_factors) {
  constexpr int kMaxRounds = 10000;
  constexpr double kExact = 1e-13, kGood = 1e-6;
  const Eigen::Index n = form_factors.rows();
  Eigen::ArrayXd d = Eigen::ArrayXd::Ones(n);
  double worst = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    const Eigen::ArrayXd row = d * (form_factors * d.matrix()).array();
    Eigen::Index smallest = 0;
    if (!(row.minCoeff(&smallest) > 0))
      throw Error(fmt::format(
          "{}: patch {} sees nothing, so that no repair can make its row of form factors sum to 1",
          scene.name, smallest));
    worst = (row - 1).abs().maxCoeff();
    if (worst <= kExact) break;
    // The square root: both ends of an exchange are corrected at once.
    d /= row.sqrt();
  }
  if (!(worst <= kGood))
    throw Error(fmt::format(
        "{}: rows of form factors cannot be repaired: the worst still sums to 1 +- {:.2g}; is the "
        "scene closed?",
        scene.name, worst));
  return {d.begin(), d.end()};
}

Eigen::MatrixXd repaired(const Eigen::MatrixXd& form_factors, const std::vector<double>& scale) {
  const Eigen::Map<const Eigen::VectorXd> d(scale.data(), Eigen::Index(scale.size()));
  return d.asDiagonal() * form_factors * d.asDiagonal();
}

}  // namespace host
