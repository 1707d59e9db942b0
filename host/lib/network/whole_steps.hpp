// The least of a quadratic over whole numbers, nearly.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace host {

/// Whole steps d, |start + d| <= most, for which slope.d + d.curve d / 2 is small: single steps down
/// to where none helps, then kicks of a few random steps and down again, the best kept [iterated
/// local search: Lourenco, Martin and Stutzle 2003]. curve: symmetric, positive semidefinite. The
/// value is never above 0, that of no step. The same steps for the same numbers.
std::vector<int> whole_steps(const Eigen::VectorXd& slope, const Eigen::MatrixXd& curve,
                             const std::vector<int>& start, int most, int kicks);

}  // namespace host
