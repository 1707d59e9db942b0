#include "network/pair_kind.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace host {

namespace {

struct Segment {
  Vec3 from, to;
};

std::vector<Segment> edges(const Polygon& polygon) {
  std::vector<Segment> result;
  const auto add = [&](const Loop& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k)
      result.push_back({loop[k], loop[(k + 1) % loop.size()]});
  };
  add(polygon.outer);
  for (const Loop& hole : polygon.holes) add(hole);
  return result;
}

double size(const Polygon& polygon) {
  Vec3 low = polygon.outer.front(), high = low;
  for (const Vec3& v : polygon.outer) low = glm::min(low, v), high = glm::max(high, v);
  return glm::distance(low, high);
}

// Nearest point of the segment to x, as a fraction of the segment.
double place_on(const Segment& s, const Vec3& x) {
  const Vec3 d = s.to - s.from;
  const double length2 = glm::dot(d, d);
  return length2 > 0 ? std::clamp(glm::dot(x - s.from, d) / length2, 0.0, 1.0) : 0;
}

double distance(const Segment& s, const Vec3& x) {
  return glm::distance(x, s.from + place_on(s, x) * (s.to - s.from));
}

Contact contact(const Segment& s, const Segment& t, double tolerance) {
  // Ends of one that lie on the other: two different places of contact make a common piece of edge.
  std::vector<Vec3> touching;
  for (const Vec3& end : {t.from, t.to})
    if (distance(s, end) <= tolerance) touching.push_back(end);
  for (const Vec3& end : {s.from, s.to})
    if (distance(t, end) <= tolerance) touching.push_back(end);
  for (const Vec3& x : touching)
    if (glm::distance(x, touching.front()) > 4 * tolerance) return Contact::edge;
  if (!touching.empty()) return Contact::corner;

  // Two edges that cross in their interiors.
  const Vec3 d = s.to - s.from, e = t.to - t.from, normal = glm::cross(d, e);
  const double square = glm::dot(normal, normal);
  if (!(square > 0)) return Contact::none;
  const double u = glm::dot(glm::cross(t.from - s.from, e), normal) / square;
  const double v = glm::dot(glm::cross(t.from - s.from, d), normal) / square;
  if (u < 0 || u > 1 || v < 0 || v > 1) return Contact::none;
  return glm::distance(s.from + u * d, t.from + v * e) <= tolerance ? Contact::corner
                                                                    : Contact::none;
}

}  // namespace

std::string_view name(PairKind kind) {
  constexpr std::string_view names[] = {"edge", "corner", "clipped", "near", "middle", "far"};
  return names[int(kind)];
}

Contact contact(const Polygon& p, const Polygon& q) {
  const double tolerance = 1e-9 * std::min(size(p), size(q));
  const std::vector<Segment> edges_p = edges(p), edges_q = edges(q);
  Contact closest = Contact::none;
  for (const Segment& s : edges_p)
    for (const Segment& t : edges_q) closest = std::max(closest, contact(s, t, tolerance));
  return closest;
}

PairKind kind_of(Contact contact, bool clipped, double rho, double far_rho) {
  if (contact == Contact::edge) return PairKind::edge;
  if (contact == Contact::corner) return PairKind::corner;
  if (clipped) return PairKind::clipped;
  if (rho < far_rho) return PairKind::far;
  return rho > 0.3 ? PairKind::near : PairKind::middle;
}

}  // namespace host
