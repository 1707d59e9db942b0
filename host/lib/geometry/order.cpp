#include "geometry/order.hpp"

#include <algorithm>

namespace host {
namespace {

bool before(const Vec3& a, const Vec3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

bool loop_before(const Loop& a, const Loop& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before);
}

/// The first in lexicographic order of all turns of a loop.
Loop first_turn(const Loop& loop) {
  Loop first = loop;
  Loop turned = loop;
  for (std::size_t k = 1; k < loop.size(); ++k) {
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    if (loop_before(turned, first)) first = turned;
  }
  return first;
}

}  // namespace

Polygon standard_order(const Polygon& polygon) {
  Polygon ordered{first_turn(polygon.outer), {}};
  for (const Loop& hole : polygon.holes)
    ordered.holes.push_back(
        std::min(first_turn(hole), first_turn({hole.rbegin(), hole.rend()}), loop_before));
  std::sort(ordered.holes.begin(), ordered.holes.end(), loop_before);
  return ordered;
}

}  // namespace host
