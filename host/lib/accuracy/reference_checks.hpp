// How good the truth is: the reference form factor against printed values and on hostile input.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/known_values.hpp"
#include "solve/exact.hpp"

namespace host {

struct KnownCheck {
  std::size_t cases = 0;
  double worst = 0;     ///< largest |error|
  double of_bound = 0;  ///< largest |error| / tolerance: at most 1 means all are met
  std::string worst_name;
};
KnownCheck check_known_values(const std::vector<KnownValue>& values);

struct HostileCheck {
  std::string name;
  std::size_t draws = 0, not_finite = 0, negative = 0, above_one = 0;
  double asymmetry = 0;  ///< largest |A_p F_pq - A_q F_qp| / min(A_p, A_q)
};
/// `draws` pairs of every degenerate family.
std::vector<HostileCheck> check_degenerate(std::uint64_t seed, std::size_t draws, int threads);

struct ScaleCheck {
  HostileCheck counts;
  double worst_change = 0;  ///< of F against scale 1
};
/// Free random quads and all degenerate families at 1e-12, 1e-9 ... 1e12 times their size.
ScaleCheck check_scales(std::uint64_t seed, std::size_t draws, int threads);

struct RowCheck {
  double worst = 0;                  ///< |row sum - 1|
  double largest = 0, smallest = 1;  ///< F above 0
};
/// Rows of a closed scene.
RowCheck check_rows(const Eigen::MatrixXd& form_factors);

}  // namespace host
