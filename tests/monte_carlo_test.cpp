#include "form_factor/monte_carlo.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.hpp"
#include "form_factor/reference.hpp"
#include "pair_families.hpp"

using families::flipped;
using families::rectangle;
using host::Estimate;
using host::monte_carlo;
using host::Polygon;
using host::segment_hits;
using host::Vec3;

TEST_CASE("the reference lies within the scatter, on free and on touching pairs") {
  families::Random random(71);
  int outside = 0;
  int pairs = 0;
  for (const families::Family& family : families::degenerate_families())
    for (int draw = 0; draw < 20; ++draw, ++pairs) {
      const families::Pair pair = family.draw(&random);
      const Estimate e = monte_carlo(pair.p, pair.q, 4096);
      const double exact = host::reference_form_factor(pair.p, pair.q);
      outside += std::abs(e.f - exact) > 3 * e.relative_error * e.f + 1e-14;
      CHECK((e.f >= 0 && e.f <= 1));
      if (exact > 1e-9) CHECK(e.relative_error < 0.1);
    }
  INFO(pairs << " pairs");
  CHECK(outside <= pairs / 25);  // three standard errors of 16 replicates: 1 % of draws
}

TEST_CASE("blockers: exact shadows, blockers in the planes of the patches, and holes") {
  const Polygon floor = rectangle(1, 1);
  const Polygon ceiling = flipped(rectangle(1, 1, 1));
  const auto visible = [&](const Polygon& blocker) {
    return monte_carlo(floor, ceiling, 100'000, {blocker});
  };
  const Estimate corner = visible(rectangle(0.5, 0.5, 0.5));
  CHECK(std::abs(corner.f - 0.149868671773791) < 4 * corner.relative_error * corner.f);
  CHECK(corner.relative_error < 2e-3);
  const Estimate centre = visible(rectangle(0.5, 0.5, 0.5, 0.25, 0.25));
  CHECK(std::abs(centre.f - 0.0995062945989848) < 4 * centre.relative_error * centre.f);
  CHECK(visible(flipped(rectangle(0.5, 0.5, 0.5))).f == corner.f);  // opaque from both sides
  CHECK(visible(rectangle(3, 3, 0.5, -1, -1)).f == 0);
  const double open = monte_carlo(floor, ceiling, 100'000).f;
  CHECK(visible(rectangle(3, 3, 0, -1, -1)).f == open);
  CHECK(visible(rectangle(3, 3, 1, -1, -1)).f == open);
  Polygon frame = rectangle(3, 3, 0.5, -1, -1);
  frame.holes = {rectangle(0.5, 0.5, 0.5).outer};
  CHECK(visible(frame).f + corner.f == doctest::Approx(open).epsilon(1e-12));
}

TEST_CASE("the same bits for the same seed, other bits for another, and no samples are an error") {
  const Polygon floor = rectangle(1, 1);
  const Polygon ceiling = flipped(rectangle(1, 1, 1));
  CHECK(monte_carlo(floor, ceiling, 1000).f == monte_carlo(floor, ceiling, 1000).f);
  CHECK(monte_carlo(floor, ceiling, 1000, {}, 2).f != monte_carlo(floor, ceiling, 1000).f);
  CHECK(monte_carlo(floor, ceiling, 1).f > 0);
  CHECK(monte_carlo(floor, rectangle(1, 1, 1), 1000).f == 0);
  CHECK_THROWS_AS(monte_carlo(floor, ceiling, 0), host::Error);
}

TEST_CASE("from a huge to a tiny polygon: most rays of the huge one start where nothing is seen") {
  const Polygon ground = rectangle(1000, 1000, 0, -500, -500);
  for (const double size : {1.0, 1e-3, 1e-6}) {
    CAPTURE(size);
    const Polygon tile = flipped(rectangle(size, size, size, 3, 4));
    const double exact = host::reference_form_factor(ground, tile);
    const Estimate e = monte_carlo(ground, tile, 1024);
    CHECK(std::abs(e.f - exact) <= 0.01 * exact);
    CHECK(e.relative_error < 0.01);
    CHECK(monte_carlo(tile, ground, 1024).f * size * size ==
          doctest::Approx(e.f * 1e6).epsilon(1e-12));
  }
}

TEST_CASE("a speck that leans through a wall: what it sees of the wall ends a hair beside it") {
  // Ends of that edge lie in opposite directions: they do not say where between them it passes.
  const Polygon wall = flipped(rectangle(3, 2));
  for (const double size : {1e-3, 1e-6, 1e-8}) {
    for (const double lean : {0.4, 1.2, 2.0}) {
      const Vec3 along = size * Vec3(std::cos(lean), 0, std::sin(lean)), across(0, size, 0),
                 middle(1.3, 0.7, 0);
      const Polygon speck{
          {middle - along, middle - along + across, middle + along + across, middle + along}, {}};
      CAPTURE(size);
      CAPTURE(lean);
      const double exact = host::reference_form_factor(speck, wall);
      const Estimate e = monte_carlo(speck, wall, 1 << 16);
      CHECK(exact > 0.01);
      CHECK(std::abs(e.f - exact) <= 5 * e.relative_error * e.f + 1e-5 * exact);
    }
  }
}

TEST_CASE("segments hit inside, and not beside, behind or at their ends") {
  const Polygon square = rectangle(1, 1);
  CHECK(segment_hits({0.5, 0.5, 1}, {0.5, 0.5, -1}, square));
  CHECK(segment_hits({0.5, 0.5, -1}, {0.5, 0.5, 1}, square));
  CHECK_FALSE(segment_hits({1.5, 0.5, 1}, {1.5, 0.5, -1}, square));
  CHECK_FALSE(segment_hits({0.5, 0.5, 1}, {0.5, 0.5, 0.1}, square));
  CHECK_FALSE(segment_hits({0.5, 0.5, 1}, {0.5, 0.5, 0}, square));
}
