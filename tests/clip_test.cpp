#include <doctest/doctest.h>

#include <cmath>

#include "form_factor/facing.hpp"
#include "geometry/polygon.hpp"
#include "pair_families.hpp"

using families::flipped;
using families::rectangle;
using host::clip;
using host::clip_to_front;
using host::moments;
using host::Polygon;
using host::Vec3;

TEST_CASE("clip keeps what is in front of the plane") {
  const Polygon square = rectangle(1, 1);
  CHECK(clip(square, {-1, 0, 0}, {1, 0, 0}).outer == square.outer);
  CHECK(clip(square, {0, 0, 0}, {1, 0, 0}).outer ==
        square.outer);                                      // an edge on the plane is kept whole
  CHECK(clip(square, {1, 0, 0}, {1, 0, 0}).outer.empty());  // an edge alone is nothing
  CHECK(clip(square, {2, 0, 0}, {1, 0, 0}).outer.empty());
  CHECK(moments(clip(square, {0.25, 0, 0}, {1, 0, 0})).area == 0.75);
  CHECK(moments(clip(square, {0.5, 0.5, 0}, {1, 1, 0})).area ==
        doctest::Approx(0.5).epsilon(1e-15));
}

TEST_CASE("a concave polygon that falls in two, and holes, give the right integrals") {
  // A U, legs up: the cut at y = 2 leaves two separate legs.
  const Polygon u{
      {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, {}};
  const host::Moments legs = moments(clip(u, {0, 2, 0}, {0, 1, 0}));
  CHECK(legs.area == doctest::Approx(2).epsilon(1e-15));
  CHECK(glm::length(legs.centroid - Vec3(1.5, 2.5, 0)) < 1e-15);
  CHECK(legs.second[0][0] == doctest::Approx(1 + 1.0 / 12).epsilon(1e-14));

  Polygon plate = rectangle(4, 4);
  plate.holes = {rectangle(2, 2, 0, 1, 1).outer};
  CHECK(moments(clip(plate, {2, 0, 0}, {1, 0, 0})).area == doctest::Approx(6).epsilon(1e-15));
  CHECK(moments(clip(plate, {3.5, 0, 0}, {1, 0, 0})).area == doctest::Approx(2).epsilon(1e-15));
  CHECK(clip(plate, {3.5, 0, 0}, {1, 0, 0}).holes.empty());
}

TEST_CASE("both halves of a cut are bounded by the same points") {
  families::Random random(21);
  for (int draw = 0; draw < 200; ++draw) {
    const Polygon polygon = families::random_quad(&random);
    const Vec3 point = moments(polygon).centroid;
    const Vec3 normal = random.direction();
    const Polygon front = clip(polygon, point, normal);
    const Polygon back = clip(polygon, point, -normal);
    std::size_t shared = 0;
    for (const Vec3& x : front.outer)
      for (const Vec3& y : back.outer) shared += x == y;
    CHECK(shared >= 2);
  }
}

TEST_CASE("what cannot see each other leaves nothing") {
  const Polygon floor = rectangle(1, 1);
  CHECK(clip_to_front(floor, rectangle(1, 1, 1)).empty());            // the ceiling looks away
  CHECK(clip_to_front(floor, flipped(rectangle(1, 1, -1))).empty());  // behind
  CHECK(clip_to_front(floor, rectangle(1, 1, 0, 2, 0)).empty());      // coplanar
  CHECK(clip_to_front(floor, flipped(floor)).empty());                // back to back
  CHECK(clip_to_front(floor, Polygon{{Vec3(0), Vec3(1), Vec3(2)}, {}}).empty());
  CHECK_FALSE(clip_to_front(floor, flipped(rectangle(1, 1, 1))).empty());
}

TEST_CASE(
    "planes that agree within rounding are one plane, wherever they lie and however small they "
    "are") {
  families::Random random(22);
  for (int draw = 0; draw < 1000; ++draw) {
    const families::Pair flat{
        rectangle(random.uniform(0.1, 2), random.uniform(0.1, 2)),
        rectangle(random.uniform(0.1, 2), 1, 0, random.uniform(0, 4), random.uniform(-2, 2))};
    const glm::dmat3 turn = random.rotation();
    const Vec3 shift = random.log_uniform(1e-3, 1e6) * random.direction();
    const double scale = random.log_uniform(1e-12, 1e12);
    const families::Pair moved =
        families::transformed(flat, [&](const Vec3& x) { return scale * (turn * x + shift); });
    CHECK(clip_to_front(moved.p, moved.q).empty());
    CHECK(clip_to_front(moved.p, flipped(moved.q)).empty());
  }
}
