// Quantiles by the nearest rank.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace host {

/// The value with a share of the others below it, 0 <= share <= 1; 0 when there is none.
inline double quantile_of_sorted(const std::vector<double>& sorted, double share) {
  return sorted.empty() ? 0 : sorted[std::size_t(std::lround(share * double(sorted.size() - 1)))];
}

inline double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return quantile_of_sorted(values, share);
}

}  // namespace host
