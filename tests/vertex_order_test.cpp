// Points on a polygon are chosen by its corners; which corner was written first must not matter.
#include <doctest/doctest.h>

#include <algorithm>

#include "form_factor/gauss.hpp"
#include "form_factor/lambert.hpp"
#include "form_factor/monte_carlo.hpp"
#include "geometry/order.hpp"
#include "pair_families.hpp"

namespace {

using host::Loop;
using host::Polygon;

Loop turned(Loop loop, std::size_t by) {
  std::rotate(loop.begin(), loop.begin() + std::ptrdiff_t(by % loop.size()), loop.end());
  return loop;
}

}  // namespace

TEST_CASE("lambert, gauss and monte-carlo give the same bits from whatever vertex a loop starts") {
  families::Random random(81);
  for (const families::Family& family : families::degenerate_families()) {
    CAPTURE(family.name);
    for (int draw = 0; draw < 10; ++draw) {
      const families::Pair pair = family.draw(&random);
      const double lambert = host::lambert_exchange(pair.p, pair.q, 2);
      const double gauss = host::gauss_exchange(pair.p, pair.q, 3);
      const double rays = host::monte_carlo(pair.p, pair.q, 64).f;
      for (std::size_t k = 1; k < 4; ++k) {
        const Polygon p{turned(pair.p.outer, k), {}}, q{turned(pair.q.outer, 2 * k + 1), {}};
        CHECK(host::lambert_exchange(p, q, 2) == lambert);
        CHECK(host::gauss_exchange(p, q, 3) == gauss);
        CHECK(host::monte_carlo(p, q, 64).f == rays);
      }
    }
  }
}

TEST_CASE("a polygon has one standard order, whichever way its holes run and stand") {
  Polygon plate = families::rectangle(5, 5);
  plate.holes = {families::rectangle(1, 1, 0, 1, 1).outer,
                 families::rectangle(1, 1, 0, 3, 3).outer};
  Polygon other{turned(plate.outer, 3), {turned(plate.holes[1], 1), turned(plate.holes[0], 2)}};
  std::reverse(other.holes[0].begin(), other.holes[0].end());
  const Polygon a = host::standard_order(plate), b = host::standard_order(other);
  CHECK(a.outer == b.outer);
  CHECK(a.holes == b.holes);
  CHECK(a.outer == plate.outer);
  CHECK(host::standard_order({turned(a.outer, 1), {}}).outer == a.outer);
  const Loop repeated{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK(host::standard_order({turned(repeated, 1), {}}).outer == repeated);
}
