// The engine's exact sum: its root, its angles, the factor of a point, exchanges of touching and
// clipped pairs against the reference, and what a scene's net gains by handing over to it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "form_factor/lambert.hpp"
#include "form_factor/reference.hpp"
#include "method/engine_source.hpp"
#include "network/engine_pair.hpp"
#include "network/train_net.hpp"
#include "random_room.hpp"
#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "scene/obj.hpp"
#include "urad/angle.hpp"
#include "urad/lambert.hpp"
#include "weights/cornell.h"
#include "weights/cube7.h"

namespace {

using host::Polygon;
using host::Vec3;

constexpr unsigned kSeed = 20140117;

class Draw {
 public:
  explicit Draw(unsigned salt) : random_(kSeed + salt) {}
  double uniform(double low, double high) {
    return low + (high - low) * (double(random_()) + 0.5) / 0x1p32;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  Vec3 vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
  Vec3 direction() { return glm::normalize(vector()); }

 private:
  std::mt19937 random_;
};

Polygon parallelogram(Vec3 corner, Vec3 u, Vec3 v) {
  return {{corner, corner + u, corner + u + v, corner + v}, {}};
}

/// Floor 1 x depth, and a wall of this height turned up by `degrees`, its foot from x on.
std::pair<Polygon, Polygon> hinge(double degrees, double depth, double x, double length,
                                  double height) {
  const double t = degrees * std::numbers::pi / 180;
  return {parallelogram({0, 0, 0}, {1, 0, 0}, {0, depth, 0}),
          parallelogram({x, 0, 0}, height * Vec3(0, std::cos(t), std::sin(t)), {length, 0, 0})};
}

std::int32_t exchange(const host::FixedScene& scene, std::uint16_t i, std::uint16_t j, int points) {
  return urad::lambert_exchange_log2_q24(scene.pod(), urad::patch_at(scene.pod(), i),
                                         urad::patch_at(scene.pod(), j), points);
}

/// F from p to q by the engine; checks that the exchange is one integer.
double factor(const Polygon& p, const Polygon& q, int points) {
  const host::FixedScene scene = host::FixedScene::of_polygons({p, q}, {});
  const std::int32_t g = exchange(scene, 0, 1, points);
  CHECK(g == exchange(scene, 1, 0, points));
  const urad::Patch patch = urad::patch_at(scene.pod(), 0);
  return urad::form_factor_uq32(g, patch.shape->log2_area_q24) * 0x1p-32;
}

struct Errors {
  std::vector<double> relative;
  double square = 0;
  void add(double value, double exact) {
    relative.push_back(std::fabs(value - exact) / exact);
    square += (value - exact) * (value - exact);
  }
  double quantile(double share) {
    std::sort(relative.begin(), relative.end());
    return relative[std::size_t(share * double(relative.size() - 1))];
  }
  double rms() const { return std::sqrt(square / double(relative.size())); }
};

}  // namespace

TEST_CASE("inverse roots and angles keep their documented bounds over the whole domain") {
  double worst_root = 0, worst_angle = 0;
  Draw draw(0);
  for (int bit = 0; bit < 64; ++bit)
    for (int k = 0; k < 2000; ++k) {
      const auto x = std::uint64_t(std::exp2(bit + draw.uniform(0, 0.9999999)));
      const urad::InverseRoot root = urad::inverse_root(x);
      const double value = std::ldexp(root.mantissa_uq30, -30 - root.half);
      worst_root = std::max(worst_root, std::fabs(value * std::sqrt(double(x)) - 1));
    }
  for (int k = -400000; k <= 400000; ++k) {
    // Every knot, both sides of every change of knot, both octants of both quadrants.
    const auto t = std::int64_t(k * 2684.35456);
    for (const auto& [x, y] : {std::pair{std::int64_t{1} << 30, std::llabs(t)},
                               {t, std::int64_t{1} << 30},
                               {-(std::int64_t{1} << 30), std::llabs(t)}}) {
      const double exact = std::atan2(double(y), double(x));
      worst_angle = std::max(worst_angle, std::fabs(urad::angle_q29(x, y) * 0x1p-29 - exact));
    }
  }
  for (int k = 0; k < 200000; ++k) {
    const auto x = std::int64_t(std::exp2(draw.uniform(0, 61.5))) * (k & 1 ? 1 : -1);
    const auto y = std::int64_t(std::exp2(draw.uniform(0, 61.5)));
    worst_angle = std::max(
        worst_angle, std::fabs(urad::angle_q29(x, y) * 0x1p-29 - std::atan2(double(y), double(x))));
  }
  MESSAGE("root ", worst_root, " angle ", worst_angle);
  CHECK(worst_root <= 2.0e-9);
  CHECK(worst_angle <= 5.0e-9);
  CHECK(urad::angle_q29(0, 0) == 0);
  CHECK(urad::angle_q29(-1, 0) == urad::kPi_q29);
}

TEST_CASE("the factor of a point: absolute and relative error over random and hostile polygons") {
  Draw draw(1);
  double worst = 0, worst_relative = 0;
  int seen = 0;
  const Polygon far_off = parallelogram({-2, -2, -2}, {4, 0, 0}, {0, 4, 4});  // fixes the scale
  for (int k = 0; k < 20000; ++k) {
    const Polygon p = parallelogram(draw.vector(), draw.log_uniform(1e-3, 2) * draw.direction(),
                                    draw.log_uniform(1e-3, 2) * draw.direction());
    const host::FixedScene fixed = host::FixedScene::of_polygons({p, far_off}, {});
    const urad::Patch patch = urad::patch_at(fixed.pod(), 0);
    // The polygon as the engine has it; the point anywhere, or 1e-4 of the scene off a vertex or an
    // edge: where the horizon cuts an edge, the crossing is a whole scene unit.
    Polygon rounded;
    for (std::uint16_t v = 0; v < 4; ++v) {
      const urad_point w = urad::patch_vertex(fixed.pod(), patch, v);
      rounded.outer.emplace_back(w.x, w.y, w.z);
    }
    Vec3 at = 0x1p28 * draw.vector();
    if (k % 4 == 0) {
      at = glm::mix(rounded.outer[0], rounded.outer[1], k % 8 ? 0 : draw.uniform(0, 1)) +
           draw.log_uniform(0x1p16, 0x1p25) * draw.direction();
    }
    const urad_point x{int(at.x), int(at.y), int(at.z)};
    const Vec3 n = draw.direction() * 0x1p30;
    const urad_point n_q30{int(std::lround(n.x)), int(std::lround(n.y)), int(std::lround(n.z))};
    const double value = urad::point_factor_uq30(fixed.pod(), x, n_q30, patch) * 0x1p-30;
    const double exact = host::point_form_factor(
        Vec3(x.x, x.y, x.z), glm::normalize(Vec3(n_q30.x, n_q30.y, n_q30.z)), rounded);
    worst = std::max(worst, std::fabs(value - exact));
    if (exact < 1e-4) continue;
    ++seen;
    worst_relative = std::max(worst_relative, std::fabs(value / exact - 1));
  }
  MESSAGE("seed ", kSeed, ": absolute ", worst, ", relative ", worst_relative, " of ", seen);
  CHECK(seen > 3000);
  CHECK(worst <= 2e-5);
  CHECK(worst_relative <= 1e-3);
}

TEST_CASE("patches that share an edge, 1 to 179 degrees and 1:20 to 20:1") {
  Errors errors;
  for (int degrees = 1; degrees < 180; degrees += 2)
    for (const double depth : {0.05, 0.2, 1.0, 4.0, 20.0})
      for (const double height : {0.05, 0.2, 1.0, 4.0, 20.0}) {
        const auto [p, q] = hinge(degrees, depth, 0, 1, height);
        errors.add(factor(p, q, 3), host::reference_form_factor(p, q));
      }
  MESSAGE("median ", errors.quantile(0.5), " max ", errors.quantile(1), " rms ", errors.rms());
  CHECK(errors.quantile(1) <= 0.02);
  CHECK(errors.rms() <= 5e-4);
}

TEST_CASE("part of an edge in common, clipped pairs, concave patches, close plates") {
  Draw draw(2);
  Errors part, clipped, concave, plates;
  for (int k = 0; k < 600; ++k) {
    const double length = draw.log_uniform(0.5, 2);
    const auto [p, q] = hinge(90, draw.log_uniform(0.3, 3), draw.uniform(-0.95 * length, 0.95),
                              length, draw.log_uniform(0.3, 3));
    part.add(factor(p, q, 3), host::reference_form_factor(p, q));
  }
  for (int k = 0; k < 1500; ++k) {
    const auto quad = [&] {
      const Vec3 corner = 0.5 * draw.vector(), u = draw.log_uniform(0.1, 1) * draw.direction();
      return parallelogram(corner, u, draw.log_uniform(0.1, 1) * draw.direction());
    };
    const Polygon p = quad(), q = quad();
    const double exact = host::reference_form_factor(p, q);
    if (exact > 1e-4) clipped.add(factor(p, q, 3), exact);
  }
  for (int k = 0; k < 300; ++k) {
    const double z = draw.log_uniform(0.05, 2), dent = draw.uniform(0.05, 0.45);
    const Polygon p{{{0, 0, 0}, {1, 0, 0}, {dent, dent, 0}, {0, 1, 0}}, {}};
    const Polygon q{{{1, 1, z}, {dent, 0.3, z}, {0, 1, z}, {0.4, 0.7, z}}, {}};
    for (const Polygon& other : {q, parallelogram({0, 0, z}, {0, 1, 0}, {1, 0, 0})}) {
      const double exact = host::reference_form_factor(p, other);
      if (exact > 1e-6) concave.add(factor(p, other, 3), exact);
    }
    const Polygon low = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Polygon high =
        parallelogram({draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5), z}, {0, 1, 0}, {1, 0, 0});
    plates.add(factor(low, high, 3), host::reference_form_factor(low, high));
  }
  for (auto& [name, errors] : {std::pair<std::string, Errors*>{"part of an edge", &part},
                               {"clipped", &clipped},
                               {"concave", &concave},
                               {"plates", &plates}})
    MESSAGE(name, " ", errors->relative.size(), ": median ", errors->quantile(0.5), " p99 ",
            errors->quantile(0.99), " max ", errors->quantile(1), " rms ", errors->rms());
  CHECK(part.quantile(1) <= 0.02);
  CHECK(part.rms() <= 2e-4);
  CHECK(clipped.relative.size() > 300);
  CHECK(clipped.quantile(0.99) <= 0.03);
  CHECK(clipped.rms() <= 2e-4);
  CHECK(concave.quantile(1) <= 0.03);
  CHECK(plates.quantile(1) <= 0.01);
}

TEST_CASE("scale leaves the bits of F, and a mirrored pair gives mirrored bits") {
  Draw draw(3);
  for (int k = 0; k < 200; ++k) {
    auto [p, q] = hinge(draw.uniform(5, 175), draw.log_uniform(0.2, 5), draw.uniform(-0.5, 0.5),
                        draw.log_uniform(0.5, 2), draw.log_uniform(0.2, 5));
    const host::FixedScene scene = host::FixedScene::of_polygons({p, q}, {});
    const auto f = [](const host::FixedScene& s) {
      return urad::form_factor_uq32(exchange(s, 0, 1, 3),
                                    urad::patch_at(s.pod(), 0).shape->log2_area_q24);
    };
    Polygon big_p = p, big_q = q;
    for (Polygon* polygon : {&big_p, &big_q})
      for (Vec3& v : polygon->outer) v *= 1024.0;
    CHECK(f(host::FixedScene::of_polygons({big_p, big_q}, {})) == f(scene));
    for (Polygon* polygon : {&p, &q}) {
      for (Vec3& v : polygon->outer) v.x = -v.x;
      std::reverse(polygon->outer.begin(), polygon->outer.end());
    }
    CHECK(f(host::FixedScene::of_polygons({p, q}, {})) == f(scene));
  }
}

TEST_CASE("patches that see nothing of each other exchange nothing") {
  const Polygon floor = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Polygon beside = parallelogram({1, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Polygon behind = parallelogram({0, 0, -1}, {0, 1, 0}, {1, 0, 0});
  const Polygon averted = parallelogram({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  for (const Polygon& other : {beside, behind, averted})
    CHECK(exchange(host::FixedScene::of_polygons({floor, other}, {}), 0, 1, 3) ==
          urad::kNoExchange);
}

TEST_CASE("a net hands over just the pairs that are clipped or above its rho") {
  const host::NetChoice nets{[](const std::string& name) -> const urad_net* {
    return name == "cornell" ? &urad_cornell : &urad_cube7;
  }};
  const host::Scene scene = host::load_scene("cornell");
  const host::FixedScene fixed(scene);
  const host::EngineRows net =
      host::engine_rows(fixed, host::parse_method("net:cornell"), nets, {}, 0);
  const host::EngineRows exact =
      host::engine_rows(fixed, host::parse_method("fixed-lambert:3"), nets, {}, 0);
  REQUIRE(urad_cornell.near_rho_uq16 > 0);
  std::uint32_t handed_over = 0;
  for (std::size_t i = 0; i < net.patches; ++i)
    for (std::size_t j = 0; j < net.patches; ++j) {
      if (i == j || scene.patches[i].surface == scene.patches[j].surface) continue;
      const auto pair = host::engine_pair(fixed.pod(), i, j);
      if (!pair) continue;
      const bool near = pair->clipped || pair->invariants.rho_uq16 > urad_cornell.near_rho_uq16;
      if (!near) continue;
      ++handed_over;
      const std::size_t at = i * net.patches + j;
      REQUIRE(net.f_uq32[at] == exact.f_uq32[at]);
    }
  CHECK(handed_over == net.counters.near_pairs);
  CHECK(handed_over > 100);
  CHECK(exact.counters.near_pairs == exact.counters.evaluated);

  const host::FixedScene cube(host::load_scene("cube7"));
  CHECK(host::engine_rows(cube, host::parse_method("net:cube7"), nets, {}, 0).counters.near_pairs ==
        0);
}

TEST_CASE(
    "a net for a box of walls meshed without regard to each other is accurate by handing over") {
  std::mt19937 random(kSeed + 4);
  for (int k = 0; k < 2; ++k) {
    const test::RandomRoom room = test::random_room(random, 1);
    const host::Scene scene =
        host::parse_obj(room.obj, "room.obj", {}, [&](const std::string&) { return room.mtl; });
    host::TrainRequest request;
    request.hidden = 4;
    request.effort = 0.3;
    const auto file = host::train_scene_net(scene, request);
    REQUIRE(file);
    const host::ErrorRow& error = *file->error("int16");
    MESSAGE("seed ", kSeed, " room ", k, ": ", room.patches, " patches, near rho ",
            file->quantised16.tables().near_rho_uq16 / 65536.0, ", std ", error.std, ", worst row ",
            error.rows->worst);
    CHECK(error.std <= 6e-5);
    CHECK(error.rows->worst <= 0.006);
  }
}

TEST_CASE("a patch so small that its vertices are one point exchanges nothing by the exact sum") {
  const Polygon floor = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (const double size : {1e-10, 1e-12}) {
    const Polygon speck = parallelogram({0.3, 0.4, 0.5}, {0, size, 0}, {size, 0, 0});
    const host::FixedScene scene = host::FixedScene::of_polygons({floor, speck}, {});
    for (const int points : {1, 2, 3, 4}) {
      CHECK(exchange(scene, 0, 1, points) == urad::kNoExchange);
      CHECK(exchange(scene, 1, 0, points) == urad::kNoExchange);
    }
  }
}

TEST_CASE(
    "sums of two and of three points a side know their first differences, of one they do not") {
  const host::Polygon floor{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}};
  const host::Polygon wall{{{0, 0, 0.1}, {0, 1.5, 0.1}, {0, 1.5, 1.2}, {0, 0, 1.2}}, {}};
  const host::FixedScene scene = host::FixedScene::of_polygons({floor, wall}, {});
  const urad::Patch i = urad::patch_at(scene.pod(), 0), j = urad::patch_at(scene.pod(), 1);
  const auto slope = [&](int points) {
    return urad::lambert_refined(scene.pod(), i, j, points, 0).log2_trait_q8[urad::sum_slope] /
           256.0;
  };
  const auto sums = [&](int halvings) {
    return urad::lambert_refined(scene.pod(), i, j, 3, halvings).point_sums;
  };
  CHECK(sums(0) == 9);
  CHECK(sums(4) == 9 + 4 * 18);
  CHECK(sums(1000) <= 9 + 18 * urad::kMostRefinedCells);
  CHECK(sums(1000) == sums(500));
  CHECK(slope(1) == -24);
  // The factor falls to a small part over the floor: its differences are of its own size.
  CHECK(std::fabs(slope(2)) < 2);
  CHECK(std::fabs(slope(3)) < 2);
}

TEST_CASE("patches of the same spread, and a long one over a round one: one integer both ways") {
  // 1 x 7 and 5 x 5: 1 + 49 = 25 + 25, so that the smaller area carries the points.
  const host::Polygon strip{{{0, 0, 0}, {7, 0, 0}, {7, 1, 0}, {0, 1, 0}}, {}};
  const host::Polygon square{{{0, 0, 2}, {0, 5, 2}, {5, 5, 2}, {5, 0, 2}}, {}};
  // Less spread than the plate, and yet it reaches further.
  const host::Polygon rod{
      {{-1.035, -0.01, 0}, {1.035, -0.01, 0}, {1.035, 0.01, 0}, {-1.035, 0.01, 0}}, {}};
  const host::Polygon plate{
      {{-0.9, -0.9, 0.1}, {-0.9, 0.9, 0.1}, {0.9, 0.9, 0.1}, {0.9, -0.9, 0.1}}, {}};
  for (const auto& [p, q] : {std::pair{strip, square}, std::pair{rod, plate}}) {
    const double exact = host::reference_exchange(p, q);
    for (const int points : {2, 3, 4}) {
      const host::FixedScene scene = host::FixedScene::of_polygons({p, q}, {});
      const urad::Patch i = urad::patch_at(scene.pod(), 0), j = urad::patch_at(scene.pod(), 1);
      const std::int32_t there = urad::lambert_exchange_log2_q24(scene.pod(), i, j, points);
      CHECK(there == urad::lambert_exchange_log2_q24(scene.pod(), j, i, points));
      const double units = scene.units_per_length();
      CHECK(std::exp2(there / 0x1p24) / (units * units) == doctest::Approx(exact).epsilon(5e-3));
    }
  }
}
