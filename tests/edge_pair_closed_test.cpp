#include "form_factor/edge_pair_closed.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pair_families.hpp"
#include "slow_contour.hpp"

using host::Vec3;

namespace {

template <class Real>
host::ClosedEdge<Real> edge(const Vec3& a, const Vec3& b) {
  using Vector = glm::vec<3, Real>;
  const Vector r = Vector(b) - Vector(a);
  return {{Vector(a), Vector(b)}, r / glm::length(r), glm::length(r)};
}

/// By bisected Gauss rules in long double, cut where the integrand bends: under the ends of the
/// inner edge, and where the lines come closest.
double by_quadrature(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  using slow::Real;
  using slow::Vector;
  const Vector start(a), inner(c), along = glm::normalize(Vector(b) - start);
  const Vector across = glm::cross(along, glm::normalize(Vector(d) - inner));
  const Real length = glm::length(Vector(b) - start);
  const auto integrand = [&](Real t) {
    return slow::log_integral(start + t * along, inner, Vector(d));
  };
  std::vector<Real> cuts = {0, glm::dot(inner - start, along), glm::dot(Vector(d) - start, along),
                            length};
  if (const Real sine2 = glm::dot(across, across); sine2 > 0)
    cuts.push_back(glm::dot(glm::cross(inner - start, glm::normalize(Vector(d) - inner)), across) /
                   sine2);
  for (Real& cut : cuts) cut = std::clamp<Real>(cut, 0, length);
  std::sort(cuts.begin(), cuts.end());
  Real sum = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    if (cuts[k] < cuts[k + 1])
      sum += slow::bisected(integrand, cuts[k], cuts[k + 1], Real(1e9), Real(1e-17), 32);
  return static_cast<double>(sum);
}

}  // namespace

TEST_CASE("edges at every angle, apart, crossing and touching, against quadrature") {
  families::Random random(97);
  double worst_share = 0, worst_long = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    const glm::dmat3 axes = random.rotation();
    const double angle = draw % 10 ? random.log_uniform(1e-12, 1.5) : 0;
    const Vec3 along = std::cos(angle) * axes[0] + std::sin(angle) * axes[1];
    const Vec3 a(random.uniform(), random.uniform(), random.uniform());
    const Vec3 b = a + random.uniform(0.1, 1) * axes[0];
    Vec3 c = a;                                                                // a common end
    if (draw % 4 == 1) c = a + random.uniform(-1, 1) * axes[0] - 0.3 * along;  // of one plane
    if (draw % 4 == 2) c = a + 0.4 * random.direction();
    if (draw % 4 == 3) c = a + random.uniform(-1, 1) * axes[0] + 0.01 * axes[2];
    const Vec3 d = c + random.uniform(0.1, 1) * along;
    const double expected = by_quadrature(a, b, c, d);
    const auto in_double = closed_log_integral(edge<double>(a, b), edge<double>(c, d));
    const auto in_long = closed_log_integral(edge<long double>(a, b), edge<long double>(c, d));
    worst_share =
        std::max(worst_share, std::abs(in_double.value - expected) / (in_double.error + 1e-15));
    worst_long = std::max(worst_long, std::abs(double(in_long.value) - expected));
    CHECK(double(in_long.error) < 1e-11);
  }
  CHECK(worst_share <= 1);
  CHECK(worst_long < 1e-12);
}

TEST_CASE("edges at a fair angle keep their digits") {
  families::Random random(98);
  for (int draw = 0; draw < 2000; ++draw) {
    const auto point = [&] { return Vec3(random.uniform(), random.uniform(), random.uniform()); };
    const Vec3 a = point(), b = point(), c = point(), d = point();
    if (glm::dot(b - a, d - c) < 0) continue;
    const auto e = edge<double>(a, b), f = edge<double>(c, d);
    const double sine = glm::length(glm::cross(e.direction, f.direction));
    const auto result = closed_log_integral(e, f);
    CHECK(result.error * sine < 1e-13);
    CHECK(std::abs(result.value - by_quadrature(a, b, c, d)) <= result.error);
  }
}

TEST_CASE("edges in line but for a hair, apart, overlapping and end to end") {
  families::Random random(99);
  double worst = 0;
  for (int draw = 0; draw < 1200; ++draw) {
    const double angle = std::ldexp(1, -static_cast<int>(random.uniform(20, 52)));
    const Vec3 along = draw % 2 ? Vec3(1, 0, angle) : Vec3(std::cos(angle), 0, std::sin(angle));
    const double places[] = {-2, -1, -0.5, 0, 0.5, 1};
    const Vec3 c = Vec3(1, 0, 0) + places[draw % 6] * along;
    const Vec3 a(0), b(1, 0, 0), d = c + random.uniform(0.1, 2) * along;
    const auto result = closed_log_integral(edge<double>(a, b), edge<double>(c, d));
    worst = std::max(worst, std::abs(result.value - by_quadrature(a, b, c, d)) / result.error);
  }
  CHECK(worst <= 1);
}
