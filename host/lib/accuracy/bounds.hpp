// The numbers that were promised, beside those that were measured.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "accuracy/accuracy_run.hpp"

namespace host {

struct Bound {
  std::string what, bound, measured;
  std::optional<bool> met;  ///< nothing: not decided by this run
};

/// One row for each promise; the worst seed where seeds are involved.
std::vector<Bound> bounds(const AccuracyResults& results);

/// The largest of function(item).
template <class Items, class Function>
double worst_of(const Items& items, const Function& function) {
  double worst = 0;
  for (const auto& item : items) worst = std::max(worst, double(function(item)));
  return worst;
}

/// The row of `table` with this label. Throws std::out_of_range when there is none.
const SceneMethodRow& row_of(const std::vector<SceneMethodRow>& table, const std::string& label);

}  // namespace host
