// Makes rows of form factors sum to 1 without breaking reciprocity.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "scene/scene.hpp"

namespace host {

/// One factor d per patch such that G' = d_i G_ij d_j has rows sum_j G'_ij = A_i: the symmetric
/// form of Sinkhorn's scaling [Knight 2008], iterated until the worst row is off by 1e-13 or stops
/// improving. For closed scenes. Throws Error when a row is empty or the rows stay further than
/// 1e-6 off (no such scaling exists).
std::vector<double> symmetric_scale(const Scene& scene, const Eigen::MatrixXd& form_factors);

/// d_i F_ij d_j.
Eigen::MatrixXd repaired(const Eigen::MatrixXd& form_factors, const std::vector<double>& scale);

}  // namespace host
