// Two truths side by side: the closed form against the reference.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "solve/exact.hpp"

namespace host {

struct ClosedFormCheck {
  std::string name;
  bool random = false;  ///< a family in general position, not made to be hard
  std::size_t pairs = 0, refused = 0;
  std::size_t understated = 0;  ///< further from the reference than both together say they are
  double worst = 0;             ///< |F - reference| of those answered; infinite after a NaN
  double largest_bound = 0;     ///< that the closed form gave with an answer
};

/// Free quads in front of each other and cut by each other's planes, `draws` of each; as many of
/// every degenerate family.
std::vector<ClosedFormCheck> check_closed_form(std::uint64_t seed, std::size_t draws, int threads);

/// All pairs of a scene in which nothing is hidden, against its exact factors.
ClosedFormCheck check_closed_form(const Scene& scene, const Eigen::MatrixXd& form_factors,
                                  int threads);

}  // namespace host
