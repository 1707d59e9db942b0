// The report's random quads: what they are, and that its sets are its own size.
#include <doctest/doctest.h>

#include <numeric>

#include "form_factor/reference.hpp"
#include "geometry/validate.hpp"
#include "legacy/random_quads.hpp"

TEST_CASE("the fifteen sets hold the report's 14,463 samples") {
  const auto& sets = host::report_sets();
  REQUIRE(sets.size() == 15);
  int sum = 0;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    CHECK(sets[k].name == char('A' + int(k)));
    sum += sets[k].samples;
  }
  CHECK(sum == 14463);
}

TEST_CASE("every pair is two plane quads in the unit cube that face each other") {
  for (const host::QuadSet& set : host::report_sets()) {
    CAPTURE(set.name);
    const auto pairs = host::draw(set, 7, 30);
    REQUIRE(pairs.size() == 30);
    double low = 1, high = 0;
    for (const host::QuadPair& pair : pairs) {
      CHECK(host::validate(pair.p, pair.q) == host::PolygonStatus::ok);
      const host::Moments p = host::moments(pair.p), q = host::moments(pair.q);
      for (int k = 0; k < 4; ++k) {
        const host::Vec3 &a = pair.p.outer[std::size_t(k)], &b = pair.q.outer[std::size_t(k)];
        for (int c = 0; c < 3; ++c) CHECK((a[c] >= 0 && a[c] <= 1 && b[c] >= 0 && b[c] <= 1));
        CHECK(glm::dot(q.normal, a - q.centroid) > 0);
        CHECK(glm::dot(p.normal, b - p.centroid) > 0);
      }
      CHECK(pair.exact == host::reference_form_factor(pair.p, pair.q));
      low = std::min(low, pair.exact), high = std::max(high, pair.exact);
    }
    const double least = set.ranges[0].f_low;
    CHECK(low >= least);
    CHECK(low > 0);
    CHECK(high <= 1);
  }
}

TEST_CASE("evened-out sets keep their bins, and a seed gives the same pairs again") {
  const host::QuadSet& set = host::report_sets()[9];
  REQUIRE(set.bin_limit > 0);
  const int samples = 75;
  const auto pairs = host::draw(set, 3, samples), again = host::draw(set, 3, samples);
  int bins[10] = {};
  for (const host::QuadPair& pair : pairs) ++bins[int(10 * pair.exact)];
  for (const int bin : bins) CHECK(bin <= set.bin_limit * samples / set.samples + 1);
  CHECK(bins[5] > 0);
  for (std::size_t k = 0; k < pairs.size(); ++k) CHECK(pairs[k].p.outer == again[k].p.outer);
  CHECK(host::draw(set, 4, 1)[0].p.outer != pairs[0].p.outer);
}
