#include "scene/bounds.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

namespace host {
namespace {

constexpr std::size_t kFewest = 3;

struct Box {
  urad_point low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};

  void add(const urad_blocker& b) {
    low = {std::min(low.x, b.low.x), std::min(low.y, b.low.y), std::min(low.z, b.low.z)};
    high = {std::max(high.x, b.high.x), std::max(high.y, b.high.y), std::max(high.z, b.high.z)};
  }
  double surface() const {
    const double x = double(high.x) - low.x, y = double(high.y) - low.y, z = double(high.z) - low.z;
    return x * y + y * z + z * x;
  }
};

double middle(const urad_blocker& b, int axis) {
  if (axis == 0) return 0.5 * (double(b.low.x) + b.high.x);
  if (axis == 1) return 0.5 * (double(b.low.y) + b.high.y);
  return 0.5 * (double(b.low.z) + b.high.z);
}

void sort_along(std::span<urad_blocker> part, int axis) {
  std::stable_sort(part.begin(), part.end(), [axis](const urad_blocker& a, const urad_blocker& b) {
    return middle(a, axis) < middle(b, axis);
  });
}

/// Surface times count of what lies before each place.
std::vector<double> costs(std::span<const urad_blocker> part, bool from_behind) {
  std::vector<double> cost(part.size() + 1, 0);
  Box box;
  for (std::size_t k = 1; k <= part.size(); ++k) {
    box.add(from_behind ? part[part.size() - k] : part[k - 1]);
    cost[k] = box.surface() * double(k);
  }
  return cost;
}

/// Sorts the part along the best axis and returns the number of blockers in its first half.
std::size_t split(std::span<urad_blocker> part) {
  double least = std::numeric_limits<double>::infinity();
  int best_axis = 0;
  std::size_t best = part.size() / 2;
  for (int axis = 0; axis < 3; ++axis) {
    sort_along(part, axis);
    const std::vector<double> before = costs(part, false), behind = costs(part, true);
    for (std::size_t k = 1; k < part.size(); ++k) {
      const double cost = before[k] + behind[part.size() - k];
      if (cost < least) least = cost, best_axis = axis, best = k;
    }
  }
  sort_along(part, best_axis);
  return best;
}

void build(std::span<urad_blocker> all, std::size_t first, std::size_t end,
           std::vector<urad_bounds>* bounds) {
  if (end - first < kFewest) return;
  Box box;
  for (std::size_t k = first; k < end; ++k) box.add(all[k]);
  const std::size_t at = bounds->size();
  bounds->push_back({box.low, box.high, std::uint16_t(first), std::uint16_t(end), 0, 0});
  const std::size_t half = first + split(all.subspan(first, end - first));
  build(all, first, half, bounds);
  build(all, half, end, bounds);
  (*bounds)[at].next = std::uint16_t(bounds->size());
}

}  // namespace

std::vector<urad_bounds> make_bounds(std::vector<urad_blocker>* blockers) {
  std::vector<urad_bounds> bounds;
  build(*blockers, 0, blockers->size(), &bounds);
  return bounds;
}

}  // namespace host
