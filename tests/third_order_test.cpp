// The third term of the series of which the moment kernel has two: against moments and factors
// found another way.
#include "form_factor/third_order.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "accuracy/pair_families.hpp"
#include "accuracy/third_order_trials.hpp"
#include "form_factor/area_rule.hpp"
#include "form_factor/kernel.hpp"
#include "form_factor/reference.hpp"
#include "network/random_direction.hpp"

namespace {

constexpr std::uint64_t kSeed = 7;

host::Polygon with_hole() {
  host::Polygon polygon = host::rectangle(3, 2);
  polygon.holes.push_back({{0.2, 0.2, 0}, {0.2, 0.9, 0}, {1.1, 0.3, 0}});
  return polygon;
}

/// By 180 degrees in its plane about its centroid: terms of odd order change their sign.
host::Polygon turned(const host::Polygon& polygon) {
  const host::Moments m = host::moments(polygon);
  host::Polygon result = polygon;
  for (host::Vec3& x : result.outer) x = 2.0 * m.centroid - x;
  return result;
}

}  // namespace

TEST_CASE("third moments are those of many points, with holes and concave") {
  MESSAGE("seed ", kSeed);
  host::Random random(kSeed);
  for (int k = 0; k < 40; ++k) {
    const host::Polygon polygon = k == 0 ? with_hole() : host::random_quad(random);
    const host::Moments m = host::moments(polygon);
    const host::ThirdMoments third = host::third_moments(polygon, m);
    std::array<double, 4> by_points{};
    for (const host::AreaPoint& point : host::area_points(polygon, 4)) {
      const double x = glm::dot(third.axis[0], point.x - m.centroid);
      const double y = glm::dot(third.axis[1], point.x - m.centroid);
      const double cubes[] = {x * x * x, x * x * y, x * y * y, y * y * y};
      for (std::size_t c = 0; c < 4; ++c) by_points[c] += point.area / m.area * cubes[c];
    }
    const double size = std::pow(m.second[0][0] + m.second[1][1] + m.second[2][2], 1.5);
    for (std::size_t c = 0; c < 4; ++c)
      CHECK(std::fabs(third.value[c] - by_points[c]) <= 1e-12 * size);
  }
}

TEST_CASE(
    "T3 is what turning both patches by 180 degrees changes, and what is left is two orders less") {
  const host::Polygon p{{{0, 0, 0}, {1.2, 0.1, 0}, {0.2, 0.7, 0}}, {}};
  const host::Polygon q = host::Polygon{{{0, 0, 0}, {0.1, 0.9, 0.4}, {0.8, 0.2, -0.3}}, {}};
  double before = 0;
  for (const double distance : {10.0, 20.0, 40.0}) {
    host::Polygon moved = q;
    for (host::Vec3& x : moved.outer) x += distance * glm::normalize(host::Vec3(1, 2, 2));
    if (glm::dot(host::moments(moved).normal, host::Vec3(1, 2, 2)) > 0)
      moved = host::flipped(moved);
    const host::Moments i = host::moments(p), j = host::moments(moved);
    const double t3 =
        host::third_order(i, host::third_moments(p, i), j, host::third_moments(moved, j));
    const double odd =
        (host::reference_exchange(p, moved) - host::reference_exchange(turned(p), turned(moved))) /
        (2 * host::centre_kernel(i, j));
    const double off = std::fabs(odd / t3 - 1);
    CAPTURE(distance);
    CHECK(off < 8 / (distance * distance));
    if (before > 0) CHECK(off < 0.3 * before);
    before = off;
  }
}

TEST_CASE("parallelograms have no third moments, and swapping the two changes nothing") {
  MESSAGE("seed ", kSeed);
  host::Random random(kSeed);
  const host::Polygon square = host::rectangle(0.7, 2);
  const host::ThirdMoments none = host::third_moments(square, host::moments(square));
  for (const double value : none.value) CHECK(std::fabs(value) < 1e-15);
  for (int k = 0; k < 50; ++k) {
    const host::PolygonPair pair = host::random_facing_quads(random);
    const host::Moments i = host::moments(pair.p), j = host::moments(pair.q);
    const host::ThirdMoments third_i = host::third_moments(pair.p, i);
    const host::ThirdMoments third_j = host::third_moments(pair.q, j);
    CHECK(host::third_order(i, third_i, j, third_j) ==
          doctest::Approx(host::third_order(j, third_j, i, third_i)).epsilon(1e-9));
  }
}

TEST_CASE("third moments change nothing for parallelograms and help far triangles") {
  for (const host::ThirdOrderRow& row : host::try_third_moments(kSeed, 200, 2)) {
    CAPTURE(row.kind);
    CAPTURE(row.least_rho);
    if (row.kind == "parallelograms")
      CHECK(row.median3 == doctest::Approx(row.median2).epsilon(1e-3));
    else if (row.most_rho <= 0.01)
      CHECK(row.median3 < row.median2 / 2);
  }
}
