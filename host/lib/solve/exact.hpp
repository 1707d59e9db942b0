// Radiosity in double: a dense matrix of form factors and a direct solve. The truth for everything
// the engine does.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "scene/scene.hpp"

namespace host {

/// Exchange A_i F_ij of two patches of a scene, i < j, unoccluded or not: the caller's choice.
using ExchangeFunction = std::function<double(std::size_t i, std::size_t j)>;

/// F(i, j) of all patches of the scene on `threads` threads (0: all cores). `exchange` is asked
/// once per unordered pair whose patches have parts in front of each other; all other entries are
/// 0.
Eigen::MatrixXd dense_form_factors(const Scene& scene, int threads,
                                   const ExchangeFunction& exchange);

/// The same with the reference form factor, times the visible fraction when the scene has blockers
/// (embree_visibility.hpp). rays: ray pairs per pair of patches, at least 1.
Eigen::MatrixXd exact_form_factors(const Scene& scene, int threads = 0, int rays = 1024);

/// Solves B = E + rho F B for each channel by LU with partial pivoting. Channels with the same
/// reflectances share the factorisation; a channel without emission is 0. `form_factors` has a row
/// per patch. Throws Error when the system has no solution (light that nothing absorbs).
std::vector<Vec3> exact_radiosity(const Scene& scene, const Eigen::MatrixXd& form_factors);

/// Whether a part of a lies in front of b's plane and a part of b in front of a's.
bool can_face(const ScenePatch& a, const ScenePatch& b);

}  // namespace host
