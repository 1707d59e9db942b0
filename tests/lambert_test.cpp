#include "form_factor/lambert.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.hpp"
#include "form_factor/kernel.hpp"
#include "form_factor/reference.hpp"
#include "pair_families.hpp"

using families::flipped;
using families::rectangle;
using host::lambert_estimate;
using host::point_form_factor;
using host::Polygon;
using host::Vec3;

TEST_CASE("a point under a square") {
  const Polygon square = flipped(rectangle(1, 1, 1));
  const Vec3 up(0, 0, 1);
  CHECK(std::abs(point_form_factor({0, 0, 0}, up, square) - 0.138531605994893) < 1e-15);
  CHECK(std::abs(point_form_factor({0.5, 0.5, 0}, up, square) - 0.239456470460774) < 1e-15);
  CHECK(point_form_factor({0.5, 0.5, 0}, -up, square) == 0);
  CHECK(point_form_factor({0.5, 0.5, 2}, -up, square) == 0);             // the unlit side
  CHECK(point_form_factor({0.5, 0.5, 0}, up, rectangle(1, 1, 1)) == 0);  // looks away
}

TEST_CASE("the horizon cuts, holes take away, and touching is survived") {
  const Polygon wall{{{1, -50, -50}, {1, -50, 50}, {1, 50, 50}, {1, 50, -50}}, {}};
  CHECK(point_form_factor({0, 0, 0}, {0, 0, 1}, wall) == doctest::Approx(0.5).epsilon(0.03));
  CHECK(point_form_factor({0.999999, 0, 0}, {1, 0, 0}, wall) == doctest::Approx(1).epsilon(1e-9));
  Polygon plate = flipped(rectangle(3, 3, 1));
  const double whole = point_form_factor({1, 1, 0}, {0, 0, 1}, plate);
  const double part = point_form_factor({1, 1, 0}, {0, 0, 1}, flipped(rectangle(1, 1, 1, 1, 1)));
  for (const Polygon& hole : {rectangle(1, 1, 1, 1, 1), flipped(rectangle(1, 1, 1, 1, 1))}) {
    plate.holes = {hole.outer};
    CHECK(point_form_factor({1, 1, 0}, {0, 0, 1}, plate) ==
          doctest::Approx(whole - part).epsilon(1e-14));
  }
  for (const double y : {-0.5, 0.0, 0.5, 1.0, 1.5}) {
    const double f = point_form_factor({0, y, 0}, {0, 0, 1}, families::hinge(1.0).q);
    CHECK((f >= 0 && f <= 1));
  }
}

TEST_CASE("N x N points converge to the reference; N out of range is refused") {
  families::Random random(51);
  for (int draw = 0; draw < 100; ++draw) {
    const families::Pair pair = families::random_pair(&random);
    const double exact = host::reference_form_factor(pair.p, pair.q);
    const double one = std::abs(lambert_estimate(pair.p, pair.q, 1).f - exact);
    const double many = std::abs(lambert_estimate(pair.p, pair.q, 16).f - exact);
    CHECK(many <= 0.1 * one + 1e-12);
  }
  const families::Pair room = families::hinge(std::acos(0.0));
  CHECK(std::abs(lambert_estimate(room.p, room.q, 4).f - 0.200043776075403) < 1e-6);
  CHECK(std::isnan(lambert_estimate(room.p, room.q, 4).relative_error));
  for (const int n : {0, -1, 33}) CHECK_THROWS_AS(lambert_estimate(room.p, room.q, n), host::Error);
}

TEST_CASE("the centre kernel is the far limit, and second moments are worth two orders") {
  families::Random random(52);
  double centre = 0;
  double moment = 0;
  for (int draw = 0; draw < 200; ++draw) {
    families::Pair pair{rectangle(1, 1), {}};
    const glm::dmat3 turn = random.rotation();
    pair.q = families::transformed(rectangle(1, 0.5),
                                   [&](const Vec3& x) { return turn * x + Vec3(2, 3, 12); });
    if (!families::wholly_in_front(pair.q, pair.p)) pair.q = flipped(pair.q);
    if (!families::wholly_in_front(pair.q, pair.p)) continue;
    const double exact = host::reference_form_factor(pair.p, pair.q);
    const host::Moments q = host::moments(pair.q);
    if (-glm::dot(q.normal, q.centroid) < 3) continue;  // grazing: the third order is felt
    centre = std::max(centre, std::abs(host::centre_kernel_estimate(pair.p, pair.q).f / exact - 1));
    moment = std::max(moment, std::abs(host::moment_kernel_estimate(pair.p, pair.q).f / exact - 1));
    CHECK(host::moment_kernel_exchange(pair.p, pair.q) ==
          doctest::Approx(host::moment_kernel_exchange(pair.q, pair.p)).epsilon(1e-14));
  }
  CHECK(centre > 1e-3);
  CHECK(centre < 2e-2);
  CHECK(moment < 0.02 * centre);
  CHECK(host::moment_kernel_estimate(rectangle(1, 1), flipped(rectangle(1, 1, 1e-3))).f <= 1);
  CHECK(host::centre_kernel_estimate(rectangle(1, 1), rectangle(1, 1, 1)).f == 0);
}
