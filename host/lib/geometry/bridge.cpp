#include "geometry/bridge.hpp"

#include <algorithm>

#include "geometry/planar.hpp"

namespace host {
namespace {

/// Whether the direction to `x` lies inside the corner before-at-after of a counter-clockwise loop.
/// It chooses between the copies of a vertex that an earlier bridge has doubled.
bool inside_corner(const Vec2& before, const Vec2& at, const Vec2& after, const Vec2& x) {
  if (orientation(before, at, after) > 0)
    return orientation(before, at, x) >= 0 && orientation(at, after, x) >= 0;
  return orientation(before, at, x) >= 0 || orientation(at, after, x) >= 0;
}

bool inside_corner(const Loop2& loop, std::size_t k, const Vec2& x) {
  const std::size_t n = loop.size();
  return inside_corner(loop[(k + n - 1) % n], loop[k], loop[(k + 1) % n], x);
}

/// Whether the open segment a b meets an edge of `loop`; edges that end in a or b do not count
/// unless they lie on it.
bool blocked(const Vec2& a, const Vec2& b, const Loop2& loop, double tolerance) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2& c = loop[k];
    const Vec2& d = loop[(k + 1) % loop.size()];
    if (cross_properly(a, b, c, d, 0)) return true;
    if (c != a && c != b && distance_to_segment(c, a, b) <= tolerance) return true;
  }
  return false;
}

struct Candidate {
  double length;
  std::size_t hole, from, to;  // vertex `from` of the merged loop, vertex `to` of the hole
};

struct Merger {
  Loop loop;
  Loop2 flat;
  std::vector<Loop> holes;
  std::vector<Loop2> flat_holes;
  double tolerance;

  bool visible(const Candidate& c) const {
    const Vec2& a = flat[c.from];
    const Vec2& b = flat_holes[c.hole][c.to];
    if (!inside_corner(flat, c.from, b) || !inside_corner(flat_holes[c.hole], c.to, a))
      return false;
    if (blocked(a, b, flat, tolerance)) return false;
    return std::none_of(flat_holes.begin(), flat_holes.end(),
                        [&](const Loop2& hole) { return blocked(a, b, hole, tolerance); });
  }

  /// The shortest bridge from the merged loop to any hole that nothing blocks. Where rounding
  /// blocks all of them (touching loops), the shortest of all: areas and integrals stay right,
  /// whatever it crosses.
  Candidate shortest() const {
    std::vector<Candidate> all;
    for (std::size_t h = 0; h < holes.size(); ++h)
      for (std::size_t i = 0; i < flat.size(); ++i)
        for (std::size_t j = 0; j < flat_holes[h].size(); ++j)
          all.push_back({glm::length(flat[i] - flat_holes[h][j]), h, i, j});
    std::stable_sort(all.begin(), all.end(),
                     [](const Candidate& x, const Candidate& y) { return x.length < y.length; });
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Candidate& c) { return visible(c); });
    return found == all.end() ? all.front() : *found;
  }

  template <class L>
  static void insert(L* loop, const L& hole, const Candidate& c) {
    L walk(hole.begin() + static_cast<std::ptrdiff_t>(c.to), hole.end());
    walk.insert(walk.end(), hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(c.to) + 1);
    walk.push_back((*loop)[c.from]);
    loop->insert(loop->begin() + static_cast<std::ptrdiff_t>(c.from) + 1, walk.begin(), walk.end());
  }

  void merge_one() {
    const Candidate c = shortest();
    insert(&loop, holes[c.hole], c);
    insert(&flat, flat_holes[c.hole], c);
    holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(c.hole));
    flat_holes.erase(flat_holes.begin() + static_cast<std::ptrdiff_t>(c.hole));
  }
};

double doubled_area(const Loop2& loop) {
  double sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k)
    sum += orientation(loop[0], loop[k], loop[(k + 1) % loop.size()]);
  return sum;
}

}  // namespace

Loop bridge_holes(const Polygon& polygon) {
  if (polygon.holes.empty()) return polygon.outer;
  const Projection flatten(moments(polygon).normal);
  Merger merger{polygon.outer, flatten(polygon.outer), {}, {}, coordinate_rounding(polygon)};
  for (Loop hole : polygon.holes) {
    if (hole.empty()) continue;
    if (doubled_area(flatten(hole)) > 0) std::reverse(hole.begin(), hole.end());
    merger.flat_holes.push_back(flatten(hole));
    merger.holes.push_back(std::move(hole));
  }
  while (!merger.holes.empty()) merger.merge_one();
  return merger.loop;
}

}  // namespace host
