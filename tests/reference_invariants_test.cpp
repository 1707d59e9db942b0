// What holds for every pair: bounds, symmetry, additivity, invariance, survival.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "form_factor/lambert.hpp"
#include "form_factor/reference.hpp"
#include "pair_families.hpp"
#include "slow_contour.hpp"

using families::flipped;
using families::hinge;
using families::Pair;
using families::rectangle;
using families::transformed;
using host::Estimate;
using host::moments;
using host::Polygon;
using host::reference_estimate;
using host::reference_exchange;
using host::reference_form_factor;
using host::Vec3;

TEST_CASE(
    "degenerate families: within bounds, symmetric, and equal to a slow rule in more digits") {
  for (const families::Family& family : families::degenerate_families()) {
    const std::uint64_t seed = 43;
    INFO(family.name << ", seed " << seed);
    families::Random random(seed);
    int outside = 0;
    int asymmetric = 0;
    int beyond_estimate = 0;
    double worst = 0;
    for (int draw = 0; draw < 1000; ++draw) {
      const Pair pair = family.draw(&random);
      const Estimate e = reference_estimate(pair.p, pair.q);
      outside += !(e.f >= 0 && e.f <= 1);
      asymmetric += reference_exchange(pair.p, pair.q) != reference_exchange(pair.q, pair.p);
      if (draw % 20) continue;
      const double error = std::abs(e.f - slow::exchange(pair.p, pair.q) / moments(pair.p).area);
      worst = std::max(worst, error);
      beyond_estimate += error > std::max(e.relative_error * e.f, 1e-16);
    }
    CHECK(outside == 0);
    CHECK(asymmetric == 0);
    CHECK(beyond_estimate == 0);
    CHECK(worst <
          (family.name == "repeated vertex" ? 1e-13 : 1e-14));  // small areas magnify rounding
  }
}

TEST_CASE("edges that nearly touch, at every distance from rounding to size") {
  families::Random random(47);
  for (int draw = 0; draw < 100; ++draw) {
    const double gap = random.log_uniform(1e-16, 0.1);
    Pair pair = hinge(random.uniform(0.2, 2.9), random.uniform(0.3, 2), random.uniform(0.3, 2));
    const Vec3 aside(-gap * (draw % 2), gap * (draw % 3) + 0.3 * (draw % 5), gap);
    pair.q = transformed(pair.q, [&](const Vec3& x) { return x + aside; });
    if (!families::faces(pair.p, pair.q) || !families::faces(pair.q, pair.p)) continue;
    pair = families::rotated(pair, &random);
    INFO("gap ", gap);
    const double g = reference_exchange(pair.p, pair.q);
    CHECK(std::abs(g - slow::exchange(pair.p, pair.q)) < 1e-14);
  }
}

TEST_CASE("free pairs: the point rule, split additivity and the error estimate") {
  families::Random random(44);
  int converged = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Pair pair = families::random_pair(&random);
    const Estimate whole = reference_estimate(pair.p, pair.q);
    const double fine = host::lambert_estimate(pair.p, pair.q, 24).f;
    const double unsure = std::abs(fine - host::lambert_estimate(pair.p, pair.q, 16).f);
    converged += unsure < 1e-10;
    CHECK(std::abs(whole.f - fine) <= 20 * unsure + 1e-13);

    const host::Moments m = moments(pair.p);
    const Vec3 normal = random.direction();
    const double front = reference_exchange(host::clip(pair.p, m.centroid, normal), pair.q);
    const double back = reference_exchange(host::clip(pair.p, m.centroid, -normal), pair.q);
    CHECK(std::abs((front + back) / m.area - whole.f) < 1e-12);
    CHECK(whole.relative_error < 1e-6);
  }
  CHECK(converged > 200);
}

TEST_CASE("a plane that cuts the other polygon: only what is in front counts") {
  families::Random random(45);
  int cut = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Pair pair{families::random_quad(&random), families::random_quad(&random)};
    const host::Moments p = moments(pair.p);
    const host::Moments q = moments(pair.q);
    const Polygon p_front = host::clip(pair.p, q.centroid, q.normal);
    const Polygon q_front = host::clip(pair.q, p.centroid, p.normal);
    const double g = reference_exchange(pair.p, pair.q);
    const double clipped =
        p_front.outer.empty() || q_front.outer.empty() ? 0 : reference_exchange(p_front, q_front);
    CHECK(std::abs(g - clipped) < 1e-14);
    const double by_points = host::lambert_exchange(pair.p, pair.q, 24);
    double unsure = 1e-14;
    for (const int n : {14, 16, 20})
      unsure += 20 * std::abs(by_points - host::lambert_exchange(pair.p, pair.q, n));
    CHECK(std::abs(g - by_points) <= unsure);
    cut += g > 0 && (moments(p_front).area < p.area || moments(q_front).area < q.area);
  }
  CHECK(cut > 50);
}

TEST_CASE(
    "the same factor for every first vertex, turn, place and scale; the same bits for every power "
    "of two") {
  families::Random random(46);
  for (int draw = 0; draw < 100; ++draw) {
    const Pair pair = families::random_pair(&random);
    const double f = reference_form_factor(pair.p, pair.q);
    const double unsure = 1e-14 / moments(pair.p).area;
    for (int first = 0; first < 16; ++first) {
      Pair turned = pair;
      std::rotate(turned.p.outer.begin(), turned.p.outer.begin() + first % 4, turned.p.outer.end());
      std::rotate(turned.q.outer.begin(), turned.q.outer.begin() + first / 4, turned.q.outer.end());
      CHECK(std::abs(reference_form_factor(turned.p, turned.q) - f) < unsure);
    }
    const Pair moved = families::rotated(pair, &random);
    CHECK(std::abs(reference_form_factor(moved.p, moved.q) - f) < unsure);
    const Pair far = transformed(pair, [](const Vec3& x) { return x + Vec3(1e6, -1e6, 1e6); });
    CHECK(std::abs(reference_form_factor(far.p, far.q) - f) < 1e6 * unsure);
    for (const double scale : {1e-12, 1e-7, 1e3, 1e12}) {
      const Pair scaled = transformed(pair, [&](const Vec3& x) { return scale * x; });
      CHECK(std::abs(reference_form_factor(scaled.p, scaled.q) - f) < unsure);
    }
    for (const double scale : {0x1p-40, 0x1p-3, 0x1p40}) {
      const Pair scaled = transformed(pair, [&](const Vec3& x) { return scale * x; });
      CHECK(reference_exchange(scaled.p, scaled.q) ==
            scale * scale * reference_exchange(pair.p, pair.q));
    }
  }
}

TEST_CASE("slivers and far pairs keep their digits") {
  for (const double width : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    const Polygon sliver = rectangle(1, width);
    const Polygon above = flipped(rectangle(1, 1, 0.5));
    const Estimate e = reference_estimate(sliver, above);
    CHECK(e.f == doctest::Approx(host::lambert_estimate(sliver, above, 24).f).epsilon(1e-9));
    CHECK(e.relative_error < 1e-9);
    // Two crossed slivers are two lines at a distance: F / width tends to a constant, the error
    // being of second order.
    const Estimate crossed = reference_estimate(sliver, flipped(rectangle(width, 1, 0.5)));
    const Polygon turned_back = flipped(rectangle(width, 1, 0.5));
    CHECK(crossed.f == doctest::Approx(reference_estimate(turned_back, sliver).f).epsilon(1e-15));
    if (width < 1e-5)
      CHECK(crossed.f / width == doctest::Approx(0.20775712505).epsilon(3 * width + 1e-6));
  }
  // Opposed unit squares: F = 1 / (pi d^2) (1 - 2 / (3 d^2) + O(d^-4)).
  for (const double d : {1e3, 1e5, 1e7})
    CHECK(reference_form_factor(rectangle(1, 1), flipped(rectangle(1, 1, d))) * std::numbers::pi *
              d * d ==
          doctest::Approx(1 - 2 / (3 * d * d)).epsilon(std::max(1e-13, 4 / (d * d * d * d))));
}

TEST_CASE("polygons without area, and with vertices on one another, are survived") {
  const Polygon square = rectangle(1, 1);
  for (const Polygon& nothing :
       {Polygon{}, Polygon{{Vec3(0), Vec3(1)}, {}}, Polygon{{Vec3(2), Vec3(2), Vec3(2)}, {}},
        Polygon{{Vec3(0), Vec3(1), Vec3(2)}, {}}}) {
    CHECK(reference_form_factor(nothing, square) == 0);
    CHECK(reference_form_factor(square, nothing) == 0);
    CHECK(reference_exchange(square, nothing) == 0);
  }
  Polygon repeated = flipped(rectangle(1, 1, 1));
  for (int k = 0; k < 3; ++k)
    repeated.outer.insert(repeated.outer.begin() + k, repeated.outer[static_cast<std::size_t>(k)]);
  CHECK(std::abs(reference_form_factor(square, repeated) - 0.199824895698387) < 1e-14);
}
