// Contour against contour: right from afar, useless where edges touch, as its header says.
#include "form_factor/contour_rule.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "accuracy/pair_families.hpp"
#include "form_factor/reference.hpp"

TEST_CASE("contour rule: plates at a distance, more points bring more digits") {
  const host::Polygon floor = host::rectangle(1, 1),
                      ceiling = host::flipped(host::rectangle(1, 1, 2));
  const double exact = host::reference_form_factor(floor, ceiling);
  double last = 1;
  for (const int n : {1, 2, 4}) {
    const double error = std::fabs(host::contour_estimate(floor, ceiling, n).f / exact - 1);
    CHECK(error < last / 10);
    last = error;
  }
  CHECK(last < 1e-6);
}

TEST_CASE("contour rule: what lies behind is cut off, both directions agree") {
  const host::Polygon floor = host::rectangle(1, 1);
  const host::Polygon wall{{{2, 0, -1}, {2, 0, 1}, {2, 1, 1}, {2, 1, -1}}, {}};
  const double exact = host::reference_form_factor(floor, wall);
  REQUIRE(exact > 0);
  CHECK(host::contour_estimate(floor, wall, 8).f == doctest::Approx(exact).epsilon(1e-6));
  CHECK(2 * host::contour_estimate(wall, floor, 8).f ==
        doctest::Approx(host::contour_estimate(floor, wall, 8).f).epsilon(1e-9));
  CHECK(host::contour_estimate(floor, host::rectangle(1, 1, -1), 2).f == 0);
}

TEST_CASE("contour rule: a hole may be written in either direction") {
  host::Polygon floor = host::rectangle(4, 4);
  floor.holes = {{{1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}}};
  const host::Polygon ceiling = host::flipped(host::rectangle(4, 4, 2));
  const double exact = host::reference_form_factor(floor, ceiling);
  CHECK(host::contour_estimate(floor, ceiling, 8).f == doctest::Approx(exact).epsilon(1e-6));
  std::reverse(floor.holes[0].begin(), floor.holes[0].end());
  CHECK(host::contour_estimate(floor, ceiling, 8).f == doctest::Approx(exact).epsilon(1e-6));
}

TEST_CASE("contour rule: walls that share an edge defeat it") {
  const host::PolygonPair pair = host::hinge(90);
  CHECK_FALSE(std::isfinite(host::contour_estimate(pair.p, pair.q, 2).f));
}
