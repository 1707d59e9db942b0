// The pairs of one scene as a training set: equal configurations once, with what they mean for the
// row sums.
#pragma once
#include <vector>

#include "network/pair_kind.hpp"
#include "network/training_set.hpp"
#include "scene/fixed_scene.hpp"

namespace host {

/// An unordered pair that exchanges light, i < j.
struct ScenePair {
  std::uint32_t i = 0, j = 0;
  double f_ij = 0, f_ji = 0;  ///< exact, unoccluded
  std::uint32_t configuration = 0;
  PairKind kind = PairKind::middle;
  double rho = 0;
  bool clipped = false;
};

struct SceneDataset {
  std::vector<ScenePair> pairs;  ///< ordered by (i, j)
  std::vector<Sample>
      configurations;  ///< distinct bits of inputs and gate; weight 0; ordered by these bits
  std::size_t patches = 0;
  double far_rho = 0;
};

/// All pairs of patches of different planar surfaces that both the reference and the engine let
/// exchange light, or, when there are more than `limit`, a random `limit` of them drawn from
/// `seed`. threads: 0 for all cores.
SceneDataset scene_dataset(const Scene& scene, const FixedScene& fixed, double far_rho,
                           std::uint64_t seed = 1, std::size_t limit = 400000, int threads = 0);

/// What a scene's training minimises: mean (F_ij e)^2 over ordered pairs, normalised, + a share of
/// mean F e^2, so that small factors count too, + the squared error of row sums. Configurations
/// with use[k] == 0 get weight 0, and row sums count only when all are used. Pairs that a net with
/// this near_rho hands over to the exact sum are left out of all of it.
TrainingSet scene_training_set(const SceneDataset& dataset, const std::vector<char>& use,
                               double near_rho = 0);

/// True when a net with this threshold leaves the pair to the exact sum.
inline bool handed_over(const ScenePair& pair, double near_rho) {
  return near_rho > 0 && (pair.clipped || pair.rho > near_rho);
}

/// Marks about `share` of the configurations, drawn from `seed`, as held out (0 in the result).
std::vector<char> hold_out(const SceneDataset& dataset, double share, std::uint64_t seed);

}  // namespace host
