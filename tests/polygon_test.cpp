#include "geometry/polygon.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "geometry/bridge.hpp"
#include "geometry/triangulate.hpp"
#include "pair_families.hpp"

using families::rectangle;
using host::Loop;
using host::Moments;
using host::moments;
using host::Polygon;
using host::Vec3;

namespace {

double trace(const glm::dmat3& m) { return m[0][0] + m[1][1] + m[2][2]; }

double distance(const glm::dmat3& a, const glm::dmat3& b) {
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(a[i][j] - b[i][j]));
  return largest;
}

/// A comb with `teeth` teeth and a square hole in its back.
Polygon comb(int teeth) {
  Polygon polygon;
  polygon.outer = {{0, 0, 0}, {2.0 * teeth, 0, 0}};
  for (int k = teeth; k > 0; --k)
    for (const Vec3& x :
         {Vec3(2 * k, 3, 0), Vec3(2 * k - 1, 3, 0), Vec3(2 * k - 1, 1, 0), Vec3(2 * k - 2, 1, 0)})
      polygon.outer.push_back(x);
  polygon.holes = {{{0.25, 0.25, 0}, {0.75, 0.25, 0}, {0.75, 0.75, 0}, {0.25, 0.75, 0}},
                   {{1.25, 0.25, 0}, {1.25, 0.75, 0}, {1.75, 0.75, 0}, {1.75, 0.25, 0}}};
  return polygon;
}

double doubled_area(const host::Triangle& t) { return glm::cross(t[1] - t[0], t[2] - t[0]).z; }

}  // namespace

TEST_CASE("moments of a rectangle are the textbook's") {
  const Moments m = moments(rectangle(2, 3, 5, 1, 1));
  CHECK(m.area == doctest::Approx(6).epsilon(1e-15));
  CHECK(glm::length(m.centroid - Vec3(2, 2.5, 5)) < 1e-15);
  CHECK(glm::length(m.normal - Vec3(0, 0, 1)) < 1e-15);
  CHECK(m.second[0][0] == doctest::Approx(4.0 / 12).epsilon(1e-14));
  CHECK(m.second[1][1] == doctest::Approx(9.0 / 12).epsilon(1e-14));
  CHECK(std::abs(m.second[2][2]) < 1e-15);
  CHECK(trace(moments(rectangle(1, 1)).second) == doctest::Approx(1.0 / 6).epsilon(1e-14));
}

TEST_CASE("holes are subtracted in either direction") {
  Polygon plate = rectangle(4, 4);
  const Loop hole = rectangle(1, 2, 0, 1, 1).outer;
  plate.holes = {hole};
  Polygon reversed = rectangle(4, 4);
  reversed.holes = {Loop(hole.rbegin(), hole.rend())};
  const Moments m = moments(plate);
  CHECK(m.area == doctest::Approx(14).epsilon(1e-15));
  CHECK(m.centroid.x == doctest::Approx((16 * 2 - 2 * 1.5) / 14).epsilon(1e-14));
  CHECK(glm::length(moments(reversed).centroid - m.centroid) < 1e-14);
  CHECK(distance(moments(reversed).second, m.second) < 1e-13);
}

TEST_CASE("moments follow scale and place, and add up over parts") {
  families::Random random(11);
  for (int draw = 0; draw < 200; ++draw) {
    const Polygon polygon = families::random_quad(&random);
    const Moments m = moments(polygon);
    for (const double scale : {0x1p-40, 0x1p40}) {
      const Moments s =
          moments(families::transformed(polygon, [&](const Vec3& x) { return scale * x; }));
      CHECK(s.area == scale * scale * m.area);
      CHECK(s.centroid == scale * m.centroid);
      CHECK(s.normal == m.normal);
    }
    const Vec3 cut(0.3, -0.5, 0.8);
    const Moments a = moments(host::clip(polygon, m.centroid, cut));
    const Moments b = moments(host::clip(polygon, m.centroid, -cut));
    CHECK(a.area + b.area == doctest::Approx(m.area).epsilon(1e-12));
    CHECK(glm::length(a.area * a.centroid + b.area * b.centroid - m.area * m.centroid) < 1e-13);
  }
}

TEST_CASE("a polygon without area has none, at any scale") {
  for (const double scale : {1e-12, 1.0, 1e12}) {
    for (const Polygon& flat : {Polygon{{Vec3(0), Vec3(scale), Vec3(3 * scale)}, {}},
                                Polygon{{Vec3(scale), Vec3(scale), Vec3(scale)}, {}},
                                Polygon{{Vec3(scale, 0, 0), Vec3(0, scale, 0)}, {}}, Polygon{}}) {
      CHECK(moments(flat).area == 0);
      CHECK(moments(flat).normal == Vec3(0));
    }
  }
}

TEST_CASE("bridged holes keep the moments, and the triangles of every polygon fill it") {
  families::Random random(12);
  for (int teeth = 1; teeth <= 6; ++teeth) {
    const Polygon polygon = comb(teeth);
    if (teeth == 1) CHECK(host::bridge_holes(rectangle(1, 1)) == rectangle(1, 1).outer);
    const Loop loop = host::bridge_holes(polygon);
    CHECK(loop.size() == polygon.outer.size() + 2 * (4 + 2));
    const Moments m = moments(polygon);
    const Moments bridged = moments({loop, {}});
    CHECK(bridged.area == doctest::Approx(m.area).epsilon(1e-14));
    CHECK(glm::length(bridged.centroid - m.centroid) < 1e-13);
    double area = 0;
    for (const host::Triangle& t : host::triangulate(polygon)) {
      CHECK(doubled_area(t) > 0);
      area += 0.5 * doubled_area(t);
      const Vec3 c = (t[0] + t[1] + t[2]) / 3.0;
      const bool in_hole =
          c.y > 0.25 && c.y < 0.75 && std::abs(std::fmod(c.x, 1) - 0.5) < 0.25 && c.x < 2;
      CHECK_FALSE(in_hole);
    }
    CHECK(area == doctest::Approx(m.area).epsilon(1e-13));
    const glm::dmat3 turn = random.rotation();
    double turned = 0;
    for (const host::Triangle& t : host::triangulate(
             families::transformed(polygon, [&](const Vec3& x) { return turn * x + 7.0; })))
      turned += 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
    CHECK(turned == doctest::Approx(m.area).epsilon(1e-12));
  }
}

TEST_CASE("random quadrilaterals, many of them concave, fall into triangles that fill them") {
  families::Random random(13);
  int concave = 0;
  for (int draw = 0; draw < 500; ++draw) {
    const Polygon polygon = families::random_quad(&random);
    concave += !host::is_convex_quad(polygon);
    const Moments m = moments(polygon);
    double area = 0;
    for (const host::Triangle& t : host::triangulate(polygon))
      area += 0.5 * glm::dot(m.normal, glm::cross(t[1] - t[0], t[2] - t[0]));
    CHECK(area == doctest::Approx(m.area).epsilon(1e-12));
  }
  CHECK(concave > 100);
}
