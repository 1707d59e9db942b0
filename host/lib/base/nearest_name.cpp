#include "base/nearest_name.hpp"

#include <algorithm>

namespace host {

namespace {

/// Letters to change, leave out or put in [Levenshtein 1966].
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::size_t> nearest_name(const std::string& typed,
                                        const std::vector<std::string>& known) {
  const auto away = [&](const std::string& name) { return distance(typed, name); };
  const auto nearest = std::min_element(
      known.begin(), known.end(), [&](const auto& a, const auto& b) { return away(a) < away(b); });
  if (nearest == known.end() || 3 * away(*nearest) > nearest->size()) return std::nullopt;
  return std::size_t(nearest - known.begin());
}

}  // namespace host
