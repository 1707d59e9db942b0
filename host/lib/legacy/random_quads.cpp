#include "legacy/random_quads.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "form_factor/reference.hpp"
#include "geometry/validate.hpp"
#include "network/random_direction.hpp"

namespace host {

namespace {

bool in_unit_cube(const Vec3& x) {
  return glm::all(glm::greaterThanEqual(x, Vec3(0))) && glm::all(glm::lessThanEqual(x, Vec3(1)));
}

/// 1 in front of the plane, -1 behind it, 0 across or on it.
int side(const Polygon& quad, const Moments& plane) {
  int front = 0, behind = 0;
  for (const Vec3& x : quad.outer) {
    const double height = glm::dot(plane.normal, x - plane.centroid);
    ++(height > 0 ? front : behind);
  }
  return behind == 0 ? 1 : front == 0 ? -1 : 0;
}

std::optional<QuadPair> draw_pair(Random& random, const QuadRange& range) {
  const Vec3 start(random.uniform(), random.uniform(), random.uniform());
  const double step = random.log_uniform(range.step_low, range.step_high);
  std::optional<Polygon> p = random_quad(random, start, step);
  if (!p) return {};
  const double distance = random.log_uniform(range.distance_low, range.distance_high);
  const Vec3 other = start + distance * random_direction(random);
  std::optional<Polygon> q =
      random_quad(random, other, step * random.log_uniform(range.ratio_low, range.ratio_high));
  if (!q || !turn_to_face(&*p, &*q)) return {};
  QuadPair pair{*p, *q, reference_form_factor(*p, *q)};
  if (!(pair.exact > 0) || pair.exact < range.f_low || pair.exact > range.f_high) return {};
  return pair;
}

}  // namespace

std::optional<Polygon> random_quad(Random& random, const Vec3& start, double step) {
  if (!in_unit_cube(start)) return {};
  // Two directions span the plane; their cross product is its normal, as random as they are.
  const Vec3 u = random_direction(random), w = random_direction(random);
  const Vec3 v = glm::normalize(w - glm::dot(w, u) * u);
  Polygon quad;
  quad.outer = {start};
  while (quad.outer.size() < 4) {
    const Vec3 next =
        quad.outer.back() + step * (random.uniform(-1, 1) * u + random.uniform(-1, 1) * v);
    if (!in_unit_cube(next)) return {};
    quad.outer.push_back(next);
  }
  if (validate(quad) != PolygonStatus::ok) return {};
  return quad;
}

bool turn_to_face(Polygon* p, Polygon* q) {
  const int q_side = side(*q, moments(*p)), p_side = side(*p, moments(*q));
  if (p_side == 0 || q_side == 0) return false;
  if (q_side < 0) std::reverse(p->outer.begin(), p->outer.end());
  if (p_side < 0) std::reverse(q->outer.begin(), q->outer.end());
  return true;
}

std::vector<QuadPair> draw(const QuadSet& set, std::uint64_t seed, int samples) {
  Random random(seed, std::uint64_t(set.name));
  const int wanted = std::min(samples, set.samples);
  const int limit = (set.bin_limit * wanted + set.samples - 1) / set.samples;
  std::vector<QuadPair> pairs;
  std::array<int, 10> bins{};
  while (int(pairs.size()) < wanted) {
    const std::size_t range = pairs.size() * set.ranges.size() / std::size_t(wanted);
    auto pair = draw_pair(random, set.ranges[range]);
    if (!pair) continue;
    int& bin = bins[std::size_t(std::min(9.0, 10 * pair->exact))];
    if (limit > 0 && bin >= limit) continue;
    ++bin;
    pairs.push_back(std::move(*pair));
  }
  return pairs;
}

}  // namespace host
