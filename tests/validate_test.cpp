#include "geometry/validate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "geometry/parse.hpp"
#include "pair_families.hpp"

using host::parse_polygon;
using host::Polygon;
using host::PolygonStatus;
using host::validate;
using host::Vec3;

namespace {

std::string_view status(std::string_view text) { return host::name(parse_polygon(text).status); }

/// The same polygon turned, moved up to 1e6 sizes away, and scaled.
Polygon moved(const Polygon& polygon, families::Random* random) {
  const glm::dmat3 turn = random->rotation();
  const Vec3 shift = random->log_uniform(1, 1e6) * random->direction();
  const double scale = random->log_uniform(1e-12, 1e12);
  return families::transformed(polygon, [&](const Vec3& x) { return scale * (turn * x + shift); });
}

}  // namespace

TEST_CASE("text that is no polygon") {
  CHECK(status("0 0 0;1 0 0;0 1 0") == "ok");
  CHECK(status(" 0  0 0 ; +1 0 0;\t0 1e0 0 ") == "ok");
  CHECK(status("0 0 0;4 0 0;0 4 0|1 1 0;2 1 0;1 2 0") == "ok");
  for (const char* text : {"", "   ", ";", "0 0 0;1 0 0;0 1 0;", "0 0 0;;0 1 0", "0 0;1 0 0;0 1 0",
                           "0 0 0 0;1 0 0;0 1 0", "0 0 zero;1 0 0;0 1 0", "0,0,0;1 0 0;0 1 0",
                           "0 0 0x1;1 0 0;0 1 0", "0 0 1.5.2;1 0 0;0 1 0", "0 0 0;1 0 0;0 1 0|",
                           "0 0 +-1;1 0 0;0 1 0", "0 0 -;1 0 0;0 1 0"}) {
    INFO(std::string(text));
    CHECK(status(text) == "invalid_syntax");
  }
}

TEST_CASE("numbers that are not finite are named, NaN first") {
  CHECK(status("nan 0 0;1 0 0;0 1 0") == "invalid_nan");
  CHECK(status("inf 0 0;nan 0 0") == "invalid_nan");
  CHECK(status("-inf 0 0;1 0 0") == "invalid_infinite");
  CHECK(status("1e999 0 0;1 0 0;0 1 0") == "invalid_infinite");
  CHECK(status("1e-999 0 0;1 0 0;0 1 0") == "ok");
  CHECK(status("0 0 0;4 0 0;0 4 0|1 1 nan;2 1 0;1 2 0") == "invalid_nan");
}

TEST_CASE("the first status that applies, at any scale, turn and place") {
  struct Case {
    const char* text;
    PolygonStatus status;
  };
  const Case cases[] = {
      {"0 0 0;1 0 0;1 1 0;0 1 0", PolygonStatus::ok},
      {"0 0 0;1 0 0;.25 .25 0;0 1 0", PolygonStatus::ok},
      {"0 0 0;.5 0 0;1 0 0;1 1 0;0 1 0", PolygonStatus::ok},  // a straight corner
      {"0 0 0;1 0 0;1 1e-7 0;0 1e-7 0", PolygonStatus::ok},   // a sliver
      {"0 0 0;1 0 0;1 1 1e-8;0 1 0", PolygonStatus::ok},
      {"0 0 0;1 0 0", PolygonStatus::invalid_too_few_vertices},
      {"0 0 0;4 0 0;0 4 0|1 1 0;2 1 0", PolygonStatus::invalid_too_few_vertices},
      {"0 0 0;1 0 0;1 0 0;0 1 0", PolygonStatus::invalid_repeated_vertex},
      {"0 0 0;1 0 0;1 1 0;0 0 0", PolygonStatus::invalid_repeated_vertex},
      {"0 0 0;1 1 1;3 3 3", PolygonStatus::invalid_zero_area},
      {"0 0 0;1 0 0;1 1 0;1 0 0", PolygonStatus::invalid_zero_area},  // out and back
      {"0 0 0;4 0 0;0 4 0|1 1 0;2 1 0;1.5 1 0", PolygonStatus::invalid_zero_area},
      {"0 0 0;1 0 0;1 1 1e-4;0 1 0", PolygonStatus::invalid_non_planar},
      {"0 0 0;1 0 1;1 1 0;0 1 1", PolygonStatus::invalid_non_planar},
      {"0 0 0;1 1 0;1 0 0;0 1 0", PolygonStatus::invalid_self_crossing},  // areas cancel
      {"0 0 0;3 1 0;3 0 0;0 2 0", PolygonStatus::invalid_self_crossing},
      {"0 0 0;2 0 0;2 2 0;1 0 0;0 2 0", PolygonStatus::invalid_self_crossing},  // vertex on an edge
      {"0 0 0;2 0 0;1 1 0;2 2 0;0 2 0;1 1 0",
       PolygonStatus::invalid_self_crossing},  // two corners meet
      {"0 0 0;2 0 0;2 2 0;1 2 0;1 3 0;1 2 0;0 2 0",
       PolygonStatus::invalid_self_crossing},  // a spike
      {"0 0 0;4 0 0;0 4 0|1 1 0;5 1 0;1 2 0", PolygonStatus::invalid_self_crossing},
      {"0 0 0;4 0 0;0 4 0|5 5 0;6 5 0;5 6 0",
       PolygonStatus::invalid_self_crossing},  // a hole outside
      {"0 0 0;4 0 0;0 4 0|0 0 0;4 0 0;0 4 0", PolygonStatus::invalid_self_crossing},  // all hole
      {"0 0 0;9 0 0;0 9 0|1 1 0;4 1 0;1 4 0|2 2 0;5 2 0;2 5 0",
       PolygonStatus::invalid_self_crossing},
      {"0 0 0;4 0 0;0 4 0|0 1 0;1 1 0;1 2 0", PolygonStatus::ok},  // a hole may touch in a point
      {"0 0 0;4 0 0;0 4 0|0 1 0;1 1 0;0 2 0",
       PolygonStatus::invalid_self_crossing},  // not along an edge
  };
  families::Random random(31);
  for (const Case& c : cases) {
    Polygon polygon;
    REQUIRE(host::read_polygon(c.text, &polygon));
    INFO(std::string(c.text));
    CHECK(host::name(validate(polygon)) == host::name(c.status));
    for (int draw = 0; draw < 40; ++draw)
      CHECK(host::name(validate(moved(polygon, &random))) == host::name(c.status));
  }
}

TEST_CASE("a pair has the status of p, unless it is ok") {
  const Polygon good = families::rectangle(1, 1);
  const Polygon nan{{{std::nan(""), 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
  const Polygon few{{{0, 0, 0}, {1, 0, 0}}, {}};
  CHECK(validate(good, good) == PolygonStatus::ok);
  CHECK(validate(good, few) == PolygonStatus::invalid_too_few_vertices);
  CHECK(validate(few, nan) == PolygonStatus::invalid_too_few_vertices);
}

TEST_CASE("text and back gives the same bits") {
  families::Random random(32);
  for (int draw = 0; draw < 200; ++draw) {
    Polygon polygon = families::random_quad(&random);
    polygon.holes = {families::random_quad(&random).outer};
    Polygon read;
    REQUIRE(host::read_polygon(host::write_polygon(polygon), &read));
    CHECK(read.outer == polygon.outer);
    CHECK(read.holes == polygon.holes);
  }
}
