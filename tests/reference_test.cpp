#include "form_factor/reference.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "form_factor/monte_carlo.hpp"
#include "geometry/parse.hpp"
#include "pair_families.hpp"

using families::flipped;
using families::hinge;
using families::Pair;
using families::rectangle;
using host::Polygon;
using host::reference_exchange;
using host::reference_form_factor;
using host::Vec3;

namespace {

constexpr double kPi = std::numbers::pi;

// In more digits than they are compared with: their terms cancel.
constexpr long double kLongPi = std::numbers::pi_v<long double>;

/// Equal parallel rectangles a x b at distance c [Howell, C-11].
double parallel_rectangles(long double a, long double b, long double c) {
  const long double x = a / c;
  const long double y = b / c;
  const long double x1 = std::sqrt(1 + x * x);
  const long double y1 = std::sqrt(1 + y * y);
  return double(2 / (kLongPi * x * y) *
                (std::log(x1 * y1 / std::sqrt(1 + x * x + y * y)) + x * y1 * std::atan(x / y1) +
                 y * x1 * std::atan(y / x1) - x * std::atan(x) - y * std::atan(y)));
}

/// Perpendicular rectangles with a common edge l, widths w (from) and h [Howell, C-14].
double perpendicular_rectangles(long double w, long double h, long double l) {
  const long double x = w / l;
  const long double y = h / l;
  const long double x2 = x * x;
  const long double y2 = y * y;
  const long double r2 = x2 + y2;
  const long double logs = std::log((1 + x2) * (1 + y2) / (1 + r2)) +
                           x2 * std::log(x2 * (1 + r2) / ((1 + x2) * r2)) +
                           y2 * std::log(y2 * (1 + r2) / ((1 + y2) * r2));
  return double((x * std::atan(1 / x) + y * std::atan(1 / y) -
                 std::sqrt(r2) * std::atan(1 / std::sqrt(r2)) + logs / 4) /
                (kLongPi * x));
}

/// Regular polygon inscribed in a circle, lit side up.
Polygon disc(int n, double radius, double z) {
  Polygon polygon;
  for (int k = 0; k < n; ++k)
    polygon.outer.push_back(
        {radius * std::cos(2 * kPi * k / n), radius * std::sin(2 * kPi * k / n), z});
  return polygon;
}

std::vector<Polygon> cube(int n) {
  std::vector<Polygon> patches;
  for (int axis = 0; axis < 3; ++axis)
    for (int wall = 0; wall < 2; ++wall)
      for (int i = 0; i < n * n; ++i) {
        const int row = i / n, column = i % n;
        const auto corner = [&](int a, int b) {
          Vec3 x;
          x[axis] = wall;
          x[(axis + 1) % 3] = static_cast<double>(row + a) / n;
          x[(axis + 2) % 3] = static_cast<double>(column + b) / n;
          return x;
        };
        const Polygon patch{{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, {}};
        patches.push_back(wall ? flipped(patch) : patch);
      }
  return patches;
}

}  // namespace

TEST_CASE("every value and status of the table of pairs") {
  const host::CsvTable table =
      host::read_csv(std::string(URAD_SOURCE_DIR) + "/tests/vectors/pairs.csv");
  for (const host::CsvRow& row : table.rows) {
    INFO(row.cells[table.column("id")]);
    const std::string& expected = row.cells[table.column("expected")];
    const host::ParsedPolygon p = host::parse_polygon(row.cells[table.column("p")]);
    const host::ParsedPolygon q = host::parse_polygon(row.cells[table.column("q")]);
    if (p.status != host::PolygonStatus::ok || q.status != host::PolygonStatus::ok) {
      CHECK(host::name(p.status == host::PolygonStatus::ok ? q.status : p.status) == expected);
      continue;
    }
    const auto point = expected.find('.');
    const double last_digit = std::pow(10.0, -static_cast<double>(expected.size() - point - 1));
    CHECK(std::abs(reference_form_factor(p.polygon, q.polygon) - std::stod(expected)) <=
          std::max(1e-14, last_digit));
  }
}

TEST_CASE("closed forms: parallel and perpendicular rectangles of any size") {
  families::Random random(41);
  for (int draw = 0; draw < 500; ++draw) {
    const double a = random.log_uniform(0.05, 20);
    const double b = random.log_uniform(0.05, 20);
    const double c = random.log_uniform(0.05, 5);
    CHECK(std::abs(reference_form_factor(rectangle(a, b), flipped(rectangle(a, b, c))) -
                   parallel_rectangles(a, b, c)) < 2e-13);
    const Pair pair = hinge(kPi / 2, a, b, c);
    CHECK(std::abs(reference_form_factor(pair.p, pair.q) - perpendicular_rectangles(a, b, c)) <
          2e-13);
  }
}

TEST_CASE("hinged unit squares at every angle") {
  const double table[][2] = {
      {1, 0.982997178574649},     {5, 0.920261908111222},      {30, 0.619028323090803},
      {45, 0.483347695478878},    {60, 0.370905321150051},     {90, 0.200043776075403},
      {120, 0.0866150011182761},  {135, 0.048309447801818},    {150, 0.0213453254126894},
      {170, 0.00236205667876908}, {175, 0.000590290917433052}, {179, 2.36087831149832e-5}};
  for (const auto& [degrees, expected] : table) {
    const Pair pair = hinge(degrees * kPi / 180);
    CHECK(std::abs(reference_form_factor(pair.p, pair.q) - expected) < 2e-15);
  }
}

TEST_CASE("polygons with many corners: inscribed discs") {
  CHECK(std::abs(reference_form_factor(disc(8, 1, 0), flipped(disc(8, 1, 1))) - 0.363710714422825) <
        1e-14);
  CHECK(std::abs(reference_form_factor(disc(64, 1, 0), flipped(disc(64, 1, 1))) -
                 0.381691438558507) < 1e-14);
  // Coaxial discs [Howell, C-41]; a polygon of n corners with the disc's area misses it by O(n^-2).
  const double cases[][4] = {{1, 1, 1, 0.381966011250105},
                             {1, 1, 3, 0.0916730868040156},
                             {1, 1, 0.1, 0.904875078027497},
                             {0.5, 1, 1, 0.468871125850725},
                             {1, 2, 10, 0.0381090695350537}};
  const int n = 128;
  const double grow = std::sqrt(2 * kPi / n / std::sin(2 * kPi / n));
  for (const auto& [r1, r2, h, expected] : cases)
    CHECK(reference_form_factor(disc(n, grow * r1, 0), flipped(disc(n, grow * r2, h))) ==
          doctest::Approx(expected).epsilon(1e-4));
}

TEST_CASE("the rows of a closed room sum to one") {
  for (const int n : {1, 3, 7}) {
    const std::vector<Polygon> patches = cube(n);
    double largest = 0;
    double smallest = 1;
    for (std::size_t i = 0; i < patches.size(); i += n == 7 ? 13 : 1) {
      double sum = 0;
      for (const Polygon& other : patches) {
        const double f = reference_form_factor(patches[i], other);
        sum += f;
        largest = std::max(largest, f);
        if (f > 0) smallest = std::min(smallest, f);
      }
      CHECK(std::abs(sum - 1) < 1e-13);
    }
    CHECK(largest <= 0.200043776075404);
    if (n == 7) CHECK(smallest == doctest::Approx(6.08e-5).epsilon(1e-3));
  }
}

TEST_CASE("a hole takes away what its filling would have given") {
  families::Random random(42);
  for (int draw = 0; draw < 100; ++draw) {
    Polygon plate = rectangle(3, 3);
    const Polygon filling = rectangle(1, 1.5, 0, 1, 0.5);
    const Polygon other = families::rotated({flipped(rectangle(2, 1, 1)), {}}, &random).p;
    const double whole = reference_exchange(plate, other);
    plate.holes = {draw % 2 ? filling.outer : flipped(filling).outer};
    const double part = reference_exchange(filling, other);
    CHECK(std::abs(reference_exchange(plate, other) + part - whole) < 1e-14);
  }
}

TEST_CASE(
    "slivers that share an edge: two rules at the limit of what can be exchanged are no "
    "agreement") {
  // The area rules both ended at min(A), which looked like a result without error: 1 for 0.21.
  const Polygon p{{{0.24237981683765497, 0.15795479427829018, 0.6723812879214818},
                   {0.24238050552231913, 0.15794959185829013, 0.6723649507289993},
                   {0.4238983980002649, -0.16970878861680483, 0.7843563533245436},
                   {0.4238977093156008, -0.16970358619680476, 0.7843726905170261}},
                  {}};
  const Polygon q{{{0.24237981683765497, 0.15795479427829018, 0.6723812879214818},
                   {0.4238977093156008, -0.16970358619680476, 0.7843726905170261},
                   {0.4238828331177263, -0.16970982970876897, 0.7843785352252127},
                   {0.2423649406397805, 0.15794855076632594, 0.6723871326296684}},
                  {}};
  const host::Estimate reference = host::reference_estimate(p, q);
  const host::Estimate sampled = host::monte_carlo(p, q, 1 << 16);
  CHECK(std::abs(reference.f - sampled.f) < 5 * sampled.relative_error * sampled.f);
  CHECK(reference.relative_error < 1e-3);
}

TEST_CASE(
    "from a huge to a tiny polygon that grazes it: sums over the edges of the huge one cancel") {
  const Polygon tiny{{{0.2715128059699292, 1.0287228409813378, 0.7570909632462918},
                      {0.27151280714766757, 1.0287228390429108, 0.7570909633271315},
                      {0.2715128014433523, 1.028722836121632, 0.7570909763839105},
                      {0.271512800265614, 1.0287228380600588, 0.7570909763030709}},
                     {}};
  const Polygon huge{{{0.9790874248911342, 0.3746390252148649, 0.07979238670973499},
                      {0.36644496134167037, 0.08308898905971768, 1.457840864621345},
                      {4.790023177179335, -8.709959439854488, 1.5641203394280543},
                      {5.402665640728799, -8.418409403699341, 0.18607186151644434}},
                     {}};
  const host::Estimate reference = host::reference_estimate(tiny, huge);
  const host::Estimate sampled = host::monte_carlo(tiny, huge, 1 << 16);
  CHECK(reference.f == doctest::Approx(2.26e-9).epsilon(1e-3));
  CHECK(std::abs(reference.f - sampled.f) < 5 * sampled.relative_error * sampled.f);
}

TEST_CASE("slivers along two axes keep the tiny cosines of their edges") {
  // Every pair of edges was skipped as perpendicular. Truth: both integrals to 30 digits.
  const Polygon p{{{2, 0, 0x1.91bc27eba94d5p-26}, {2, 2, 0x1.283865bc73876p-28}, {2, 1, 0}}, {}};
  const Polygon q{
      {{1, 0, 0x1.949441c9f4896p-26}, {1, 0, 0x1.c0cbcd36ea38fp-25}, {2, 0, 0x1.31099582530dbp-25}},
      {}};
  CHECK(std::abs(reference_form_factor(p, q) - 1.70689203376e-9) <= 1e-14);
}

TEST_CASE("planes that almost agree are cut where they meet") {
  // Triangles 1e-9 apart, turned by 1e-8: a normal's last digit moved the cut by 1e-7. Truth as
  // above.
  const Polygon p{{{0x1.fffffffc4314fp+0, 0x1.4b1e33cb9434p-28, 0x1.ffffffead7e88p+0},
                   {0x1.000000137f85cp+0, 0x1.00000007899bcp+1, 0x1.00000010ce26bp+0},
                   {0x1.90ccbe0fd5d8p-29, 0x1.0000001482124p+0, -0x1.1acb914dc659ap-28}},
                  {}};
  const Polygon q{{{0x1.4bf463fe7c32fp-28, 0x1.459a73e58533cp-30, -0x1.4d23cf9521cb4p-28},
                   {0x1.000000098c2e7p+0, 0x1.0000000d938a7p+1, 0x1.fffffff0531fp-1},
                   {0x1.0000000621817p+0, 0x1.0000001c94f82p+0, 0x1.fffffff41c56ap-1}},
                  {}};
  CHECK(std::abs(reference_form_factor(p, q) - 0.0590207786596866592) <= 1e-10);
}
