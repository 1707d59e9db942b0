#include "form_factor/gauss.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.hpp"
#include "form_factor/area_rule.hpp"
#include "form_factor/reference.hpp"
#include "pair_families.hpp"

using families::flipped;
using families::rectangle;

TEST_CASE("every Gauss rule integrates polynomials of degree 2n - 1 and no more") {
  for (int n = 1; n <= host::kMaxGaussPoints; ++n) {
    const auto integral = [&](int power) {
      double sum = 0;
      for (const host::GaussPoint& g : host::gauss_rule(n)) sum += g.weight * std::pow(g.x, power);
      return sum;
    };
    for (int power = 0; power < 2 * n; ++power)
      CHECK(std::abs(integral(power) - (power % 2 ? 0.0 : 2.0 / (power + 1))) < 1e-15);
    if (n < 10) CHECK(std::abs(integral(2 * n) - 2.0 / (2 * n + 1)) > 1e-7);
  }
  for (const int n : {0, 33}) CHECK_THROWS_AS(host::gauss_rule(n), host::Error);
}

TEST_CASE("area points carry the area and the moments of any polygon") {
  families::Random random(61);
  for (int draw = 0; draw < 200; ++draw) {
    const host::Polygon polygon = families::random_quad(&random);
    const host::Moments m = host::moments(polygon);
    double area = 0;
    host::Vec3 first(0);
    for (const host::AreaPoint& x : host::area_points(polygon, 3)) {
      area += x.area;
      first += x.area * x.x;
      CHECK(std::abs(glm::dot(m.normal, x.x - m.centroid)) < 1e-14);
    }
    CHECK(area == doctest::Approx(m.area).epsilon(1e-12));
    CHECK(glm::length(first / area - m.centroid) < 1e-12);
  }
  host::Polygon plate = rectangle(3, 3);
  plate.holes = {rectangle(1, 1, 0, 1, 1).outer};
  double area = 0;
  for (const host::AreaPoint& x : host::area_points(plate, 2, {0, 1.5, 0}, {0, 1, 0}))
    area += x.area;
  CHECK(area == doctest::Approx(4).epsilon(1e-14));
}

TEST_CASE(
    "the product rule converges fast from afar, and stays within bounds where patches touch") {
  const host::Polygon floor = rectangle(1, 1);
  const host::Polygon ceiling = flipped(rectangle(1, 2, 2));
  const double exact = host::reference_form_factor(floor, ceiling);
  double before = 1;
  for (const int n : {1, 2, 4, 8}) {
    const double error = std::abs(host::gauss_estimate(floor, ceiling, n).f - exact);
    CHECK(error < 0.1 * before);
    before = error;
  }
  CHECK(before < 1e-11);
  families::Random random(62);
  for (int draw = 0; draw < 100; ++draw) {
    const families::Pair pair =
        families::rotated(families::hinge(random.uniform(0.01, 3.14)), &random);
    const double f = host::gauss_estimate(pair.p, pair.q, 3).f;
    CHECK((f >= 0 && f <= 1));
  }
}
