#include "form_factor/closed_form.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "form_factor/reference.hpp"
#include "geometry/parse.hpp"
#include "method/pair_method.hpp"
#include "pair_families.hpp"

using families::Pair;
using host::closed_form;
using host::ClosedForm;
using host::Polygon;
using host::Vec3;

namespace {

/// Pairs, those refused, those that the reference leaves open (its error may be all of F), and
/// those further from it than both say they are.
struct Tally {
  int pairs = 0, refused = 0, open = 0, understated = 0;
  double worst = 0;  ///< |F - reference| of those answered

  void add(const Pair& pair) {
    const ClosedForm result = closed_form(pair.p, pair.q);
    ++pairs;
    if (!(result.f >= 0 && result.f <= 1)) worst = 1;
    if (result.ill_conditioned()) {
      ++refused;
      return;
    }
    const host::Estimate exact = host::reference_estimate(pair.p, pair.q);
    if (exact.relative_error >= 1) {
      ++open;
      return;
    }
    const double error = std::abs(result.f - exact.f);
    worst = std::max(worst, error);
    if (!(error <= result.error + exact.f * exact.relative_error + 1e-15)) ++understated;
  }
  void expect(double error) const {
    CHECK(worst <= error);
    CHECK(understated == 0);
    CHECK(open <= pairs / 1000);
  }
};

Pair scaled(const Pair& pair, double factor) {
  return families::transformed(pair, [=](const Vec3& x) { return factor * x; });
}

}  // namespace

TEST_CASE("closed form: every value of the table of pairs") {
  const host::CsvTable table =
      host::read_csv(std::string(URAD_SOURCE_DIR) + "/tests/vectors/pairs.csv");
  int values = 0;
  for (const host::CsvRow& row : table.rows) {
    const host::ParsedPolygon p = host::parse_polygon(row.cells[table.column("p")]);
    const host::ParsedPolygon q = host::parse_polygon(row.cells[table.column("q")]);
    if (p.status != host::PolygonStatus::ok || q.status != host::PolygonStatus::ok) continue;
    INFO(row.cells[table.column("id")]);
    const std::string& expected = row.cells[table.column("expected")];
    const double last_digit =
        std::pow(10.0, -static_cast<double>(expected.size() - expected.find('.') - 1));
    const ClosedForm result = closed_form(p.polygon, q.polygon);
    CHECK(!result.ill_conditioned());
    CHECK(std::abs(result.f - std::stod(expected)) <= std::max(result.error, last_digit));
    ++values;
  }
  CHECK(values > 20);
}

TEST_CASE("closed form: free quads, wholly in front of each other and cut") {
  families::Random random(94);
  Tally facing, cut;
  for (int draw = 0; draw < 10000; ++draw) facing.add(families::random_pair(&random));
  for (int draw = 0; draw < 4000; ++draw)
    cut.add({families::random_quad(&random), families::random_quad(&random)});
  for (const Tally& tally : {facing, cut}) {
    tally.expect(1e-11);
    CHECK(tally.refused <= tally.pairs / 1000);
  }
}

TEST_CASE("closed form: hostile families") {
  for (const families::Family& family : families::degenerate_families()) {
    INFO(family.name);
    families::Random random(95);
    Tally tally;
    for (int draw = 0; draw < 500; ++draw) tally.add(family.draw(&random));
    tally.expect(1e-9);
    CHECK(tally.refused <= 5);
  }
}

TEST_CASE("two truths on triangles made to be hard: neither promises too much") {
  families::Random random(100);
  const auto on_lattice = [&](int n) {
    Vec3 x;
    for (int c = 0; c < 3; ++c) x[c] = std::floor(n * random.uniform());
    return x;
  };
  const auto add = [](Tally* tally, const auto& corner) {
    Pair pair;
    for (Polygon* polygon : {&pair.p, &pair.q}) polygon->outer = {corner(), corner(), corner()};
    if (host::moments(pair.p).area > 0 && host::moments(pair.q).area > 0) tally->add(pair);
  };
  Tally lattice, turned;
  for (int draw = 0; draw < 5000; ++draw) {
    const int n = 2 + draw % 3;
    add(&lattice, [&] { return on_lattice(n); });
    const glm::dmat3 turn = random.rotation();
    add(&turned, [&] { return turn * on_lattice(n); });
  }
  for (const Tally& tally : {lattice, turned}) {
    CHECK(tally.pairs > 3000);
    CHECK(tally.refused == 0);
    tally.expect(1e-11);
  }
  Tally jittered, flat, slivers;
  for (int draw = 0; draw < 3000; ++draw) {
    const double size = random.log_uniform(1e-12, 1e-1);
    add(&jittered, [&] { return on_lattice(3) + size * random.direction(); });
    add(&flat, [&] {
      const Vec3 x = on_lattice(3);
      return Vec3(x.x, x.y, x.z > 0 ? size * random.uniform() : 0);
    });
    Pair pair;
    for (Polygon* polygon : {&pair.p, &pair.q}) {
      const Vec3 a = random.direction(), b = random.direction();
      polygon->outer = {a, b, a + random.uniform() * (b - a) + size * random.direction()};
    }
    slivers.add(pair);
  }
  for (const Tally& tally : {jittered, flat, slivers}) {
    CHECK(tally.pairs > 2000);
    CHECK(tally.open <= tally.pairs / 5);
    CHECK(tally.understated == 0);
  }
}

TEST_CASE("closed form: all pairs of the cube of 294 patches") {
  std::vector<Polygon> patches;
  for (int axis = 0; axis < 3; ++axis)
    for (int wall = 0; wall < 2; ++wall)
      for (int k = 0; k < 49; ++k) {
        const int row = k / 7, column = k % 7;
        const Polygon patch = families::transformed(
            families::rectangle(1.0 / 7, 1.0 / 7, wall, row / 7.0, column / 7.0),
            [=](const Vec3& x) {
              Vec3 turned;
              for (int c = 0; c < 3; ++c) turned[(axis + 1 + c) % 3] = x[c];
              return turned;
            });
        patches.push_back(wall ? families::flipped(patch) : patch);
      }
  double worst_row = 0, worst = 0;
  int refused = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < patches.size(); ++j) {
      const ClosedForm result = closed_form(patches[i], patches[j]);
      refused += result.ill_conditioned();
      sum += result.f;
      if ((i + j) % 7 == 0)
        worst = std::max(worst,
                         std::abs(result.f - host::reference_form_factor(patches[i], patches[j])));
    }
    worst_row = std::max(worst_row, std::abs(sum - 1));
  }
  CHECK(refused == 0);
  CHECK(worst < 1e-13);
  CHECK(worst_row < 1e-12);
}

TEST_CASE("closed form: any scale, bit for bit by powers of two") {
  families::Random random(96);
  Tally tally;
  for (int draw = 0; draw < 200; ++draw) {
    const Pair pair = families::random_pair(&random);
    const ClosedForm here = closed_form(pair.p, pair.q);
    for (int exponent = -12; exponent <= 12; exponent += 3)
      tally.add(scaled(pair, std::pow(10.0, exponent)));
    const Pair other = scaled(pair, std::ldexp(1, random.uniform() < 0.5 ? -31 : 37));
    const ClosedForm there = closed_form(other.p, other.q);
    CHECK(there.f == here.f);
    CHECK(there.error == here.error);
  }
  tally.expect(1e-11);
  CHECK(tally.refused == 0);
}

TEST_CASE("closed form: holes, many corners, and what cannot be seen") {
  Polygon plate = families::rectangle(3, 3);
  plate.holes = {families::rectangle(1, 1.5, 0, 1, 0.5).outer};
  Polygon disc;
  for (int k = 0; k < 40; ++k)
    disc.outer.push_back({std::cos(k * 0.05 * 3.14159), std::sin(k * 0.05 * 3.14159), 0.7});
  Tally tally;
  tally.add({plate, families::flipped(disc)});
  tally.add({families::flipped(disc), plate});
  tally.expect(1e-12);
  CHECK(tally.refused == 0);
  const ClosedForm behind = closed_form(plate, disc);
  CHECK(behind.f == 0);
  CHECK(behind.error == 0);
  CHECK(closed_form(plate, families::flipped(families::rectangle(1, 1))).f == 0);  // coplanar
}

TEST_CASE("closed form: a patch too small for its distance is refused, not guessed") {
  const host::NetChoice nets;
  const auto run = host::pair_method(host::parse_method("closed-form"), nets);
  CHECK(run.knows_error);
  const auto speck = [](double size) {
    return families::transformed(families::rectangle(size, size), [](const Vec3& x) {
      return Vec3(0.6 * x.x + 0.8 * x.y, 0.48 * x.y - 0.36 * x.x, 0.8 * x.x - 0.6 * x.y);
    });
  };
  const Polygon plate = families::flipped(families::rectangle(1, 1, 1));
  const host::PairResult fair = run.run(speck(1e-3), plate);
  CHECK(fair.status == "ok");
  CHECK(fair.estimate.relative_error < 1e-8);
  CHECK(run.run(speck(1e-7), plate).status == "unsupported_ill_conditioned");
  // Seen from the plate it is nothing, and that is known.
  const host::PairResult back = run.run(plate, speck(1e-7));
  CHECK(back.status == "ok");
  CHECK(back.estimate.f < 1e-14);
}
