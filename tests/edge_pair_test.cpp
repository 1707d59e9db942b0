// The edge integral of the reference against the closed form: neither knows the other.
#include "form_factor/edge_pair.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "form_factor/edge_pair_closed.hpp"
#include "pair_families.hpp"

using host::Edge;
using host::Vec3;

namespace {

host::ClosedEdge<long double> closed_edge(const Edge& edge, bool turned) {
  using Vector = glm::vec<3, long double>;
  const long double length = edge.length;
  const Vector direction = glm::normalize(Vector(edge.direction));
  const Vector start(edge.start), end = start + length * direction;
  if (turned) return {{end, start}, -direction, length};
  return {{start, end}, direction, length};
}

/// |difference| of both integrals over what double can promise.
double share(const Edge& e, const Edge& f) {
  const bool turned = glm::dot(e.direction, f.direction) < 0;
  const auto exact = closed_log_integral(closed_edge(e, false), closed_edge(f, turned));
  const double value = host::log_distance_integral(e, f, 1);
  return std::abs(value - double(exact.value)) /
         (double(exact.error) + 1e-14 * (e.length * f.length + std::abs(value)));
}

}  // namespace

TEST_CASE("edges of any two lengths, near each other and far") {
  families::Random random(101);
  double worst = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    const Edge e{random.direction(), random.direction(), 1};
    Edge f{{}, random.direction(), random.log_uniform(1e-10, 1)};
    const double along = random.uniform(-1, 2), away = random.log_uniform(1e-8, 3);
    f.start = e.start + along * e.direction + away * random.direction();
    worst = std::max({worst, share(e, f), share(f, e)});
  }
  CHECK(worst <= 1);
}

TEST_CASE("a speck of an edge just past the end of a long one") {
  families::Random random(102);
  double worst = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    const Edge e{random.direction(), random.direction(), 1};
    const Edge f{e.start - random.log_uniform(1e-3, 0.1) * e.direction, random.direction(),
                 random.log_uniform(1e-9, 1e-5)};
    worst = std::max(worst, share(e, f));
  }
  CHECK(worst <= 1);
}
