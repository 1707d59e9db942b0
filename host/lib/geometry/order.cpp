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
  const std::size_t n = loop.size();
  std::size_t first = 0;
  for (std::size_t start = 1; start < n; ++start) {
    std::size_t k = 0;  // repeated vertices are told apart by what follows them
    while (k < n && loop[(start + k) % n] == loop[(first + k) % n]) ++k;
    if (k < n && before(loop[(start + k) % n], loop[(first + k) % n])) first = start;
  }
  Loop turned = loop;
  std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(first), turned.end());
  return turned;
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

bool written_before(const Polygon& p, const Polygon& q) {
  if (p.outer != q.outer) return loop_before(p.outer, q.outer);
  return std::lexicographical_compare(p.holes.begin(), p.holes.end(), q.holes.begin(),
                                      q.holes.end(), loop_before);
}

}  // namespace host
