// Auto, sums and moved light where pairs are at the ends of what can be said: factors below the last
// bit, surfaces whose polygons only almost share a plane, slivers.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "form_factor/reference.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"
#include "urad/grid.hpp"
#include "urad/lambert.hpp"
#include "urad/visibility.hpp"

using host::Polygon;
using host::Vec3;

namespace {

/// Quads with shapes of their own, in scene units; surface k has the quads [first[k], first[k + 1]).
struct Quads {
  struct Side {
    urad_point origin, u, v;
  };
  Quads(const std::vector<Side>& sides, const std::vector<std::uint16_t>& first, std::uint8_t flags)
      : polygon(sides.size()), surface(first.size() - 1) {
    for (std::size_t k = 0; k < sides.size(); ++k) {
      urad_grid grid{};
      const urad_point &origin = sides[k].origin, &u = sides[k].u, &v = sides[k].v;
      REQUIRE(urad::grid_make(origin, u, v, 1, 1, &grid) == urad::Status::ok);
      const auto at = [&](int a, int b) {
        return urad_point{origin.x + a * u.x + b * v.x, origin.y + a * u.y + b * v.y,
                          origin.z + a * u.z + b * v.z};
      };
      polygon[k] = {grid.shape, {}, std::uint32_t(vertex.size()), 4, 0};
      polygon[k].centroid = {origin.x + (u.x + v.x) / 2, origin.y + (u.y + v.y) / 2,
                             origin.z + (u.z + v.z) / 2};
      vertex.insert(vertex.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
    }
    for (std::size_t s = 0; s < surface.size(); ++s)
      surface[s] = {first[s],          std::uint16_t(first[s + 1] - first[s]), 0, flags, nullptr,
                    &polygon[first[s]]};
    scene.abi = URAD_SCENE_ABI;
    scene.patch_count = std::uint16_t(polygon.size());
    scene.surface_count = std::uint16_t(surface.size());
    scene.surface = surface.data();
    scene.vertex = vertex.data();
    scene.vertex_count = std::uint32_t(vertex.size());
  }
  urad::Patch operator[](std::uint16_t k) const { return urad::patch_at(scene, k); }

  std::vector<urad_polygon> polygon;
  std::vector<urad_surface> surface;
  std::vector<urad_point> vertex;
  urad_scene scene{};
};

urad::CheapestPair cheapest(const Quads& quads, std::uint16_t i, std::uint16_t j) {
  urad_counters counters{};
  return urad::cheapest_exchange(quads.scene, quads[i], quads[j], nullptr, urad::kPercentError_q8,
                                 &counters);
}

}  // namespace

TEST_CASE(
    "a factor below the last bit of a sum is the kernel's, and sums say that they have none") {
  const Quads quads(
      {{{0, 0, 0}, {16, 0, 0}, {0, 16, 0}}, {{0, 0, 1 << 22}, {0, 16, 0}, {16, 0, 0}}}, {0, 1, 2},
      URAD_SURFACE_PLANAR);
  std::int32_t log2_g_q24 = 0;
  urad::PairTraits traits{};
  REQUIRE(urad::exchange_by(quads.scene, quads[0], quads[1], urad::Way::kernel, nullptr,
                            &log2_g_q24, &traits));
  // 256^2 / (pi 2^44)
  CHECK(log2_g_q24 * 0x1p-24 == doctest::Approx(16 - 44 - std::log2(M_PI)).epsilon(1e-6));
  CHECK_FALSE(urad::exchange_by(quads.scene, quads[0], quads[1], urad::Way::nine_points, nullptr,
                                &log2_g_q24, &traits));
  std::array<urad::RefinedStop, 8> stop;
  CHECK(urad::refined_stops(quads.scene, quads[0], quads[1], stop.data(), 8) == 0);
  const urad::CheapestPair pair = cheapest(quads, 0, 1);
  CHECK(pair.way == urad::Way::kernel);
  CHECK(pair.log2_exchange_q24 == log2_g_q24);
}

TEST_CASE(
    "of a surface whose polygons almost share a plane, what stands in between exchanges all or "
    "nothing") {
  // The first polygon lies 200 units below the second; a wall rises from 10 to 60 units over that.
  const Quads quads({{{-90000, -9000, -200}, {9000, 0, 0}, {0, 9000, 0}},
                     {{-9000, -9000, 0}, {9000, 0, 0}, {0, 18000, 0}},
                     {{500, -9000, 10}, {0, 0, 50}, {0, 18000, 0}}},
                    {0, 2, 3}, URAD_SURFACE_PLANAR);
  const urad::CheapestPair pair = cheapest(quads, 1, 2);
  CHECK(pair.way == urad::Way::none);
  CHECK(pair.log2_exchange_q24 == urad::kNoExchange);
  CHECK(pair.log2_error_q8 == 0);  // all of it
  std::array<urad::RefinedStop, 8> stop;
  CHECK(urad::refined_stops(quads.scene, quads[1], quads[2], stop.data(), 8) == 0);
}

TEST_CASE(
    "polygons of one bent surface exchange nothing for certain where they look away, not where "
    "they touch a plane") {
  const std::vector<Quads::Side> sides{{{0, 0, 0}, {900, 0, 0}, {0, 900, 0}},
                                       {{900, 0, 0}, {900, 0, 0}, {0, 900, 0}},
                                       {{0, 0, -9000}, {0, 900, 0}, {900, 0, 0}}};
  for (const int flags : {0, int(URAD_SURFACE_PLANAR)}) {
    const Quads quads(sides, {0, 3}, std::uint8_t(flags));
    CHECK(cheapest(quads, 0, 1).way == urad::Way::none);
    CHECK(cheapest(quads, 0, 1).log2_error_q8 == (flags ? -32767 : 0));
    CHECK(cheapest(quads, 0, 2).way == urad::Way::none);
    CHECK(cheapest(quads, 0, 2).log2_error_q8 == -32767);
  }
}

TEST_CASE("a sliver that touches with its end is halved as deep as cells go") {
  const Polygon sliver{{{0, 0, 0}, {0, 2e-6, 0}, {0, 2e-6, 1}, {0, 0, 1}}, {}},
      floor{{{0, -1, 0}, {2, -1, 0}, {2, 1, 0}, {0, 1, 0}}, {}};
  const host::FixedScene scene = host::FixedScene::of_polygons({sliver, floor}, {});
  const urad::Patch p = urad::patch_at(scene.pod(), 0), q = urad::patch_at(scene.pod(), 1);
  const double exact = std::log2(host::reference_exchange(sliver, floor));
  const double unit = 2 * 0.5 * (p.shape->log2_area_q24 * 0x1p-24 - std::log2(2e-6));
  for (const int halvings : {0, 64}) {
    const urad::LambertSum sum = urad::lambert_refined(scene.pod(), p, q, 3, halvings);
    CHECK(std::fabs(sum.log2_exchange_q24 * 0x1p-24 - unit - exact) < (halvings ? 0.003 : 0.05));
  }
}

TEST_CASE("rays that disagree, and of which parts of the pair make none, end in a fraction") {
  // A wall that rises a hair above the floor's plane: of a thousand rays one or two are made.
  int none = 0;
  for (int k = 1; k <= 60; ++k) {
    const double hair = 1e-5 * k;
    const Polygon floor{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}},
        wall{{{1.5, 0, -1}, {1.5, 0, hair}, {1.5, 1, hair}, {1.5, 1, -1}}, {}},
        blocker{{{1.2, 0, -0.1}, {1.2, 0.5, -0.1}, {1.2, 0.5, 1}, {1.2, 0, 1}}, {}};
    const host::FixedScene scene = host::FixedScene::of_polygons({floor, wall}, {blocker});
    const urad::Patch p = urad::patch_at(scene.pod(), 0), q = urad::patch_at(scene.pod(), 1);
    urad_counters counters{};
    const urad::AdaptiveRays plan{64, 2, 1};
    const std::uint32_t there =
        urad::adaptive_fraction_uq16(scene.pod(), p, q, plan, 1u << 31, &counters);
    CHECK(there <= 65536);
    CHECK(urad::adaptive_fraction_uq16(scene.pod(), q, p, plan, 1u << 31, &counters) == there);
    none += there == 0;
  }
  CHECK(none > 0);
  CHECK(none < 60);
}

TEST_CASE(
    "of a loop that crosses itself nothing is exchanged where its front part is seen from behind") {
  Quads quads(
      {{{-900, -500, 0}, {1800, 0, 0}, {0, 1000, 0}}, {{0, -500, 0}, {0, 1000, 0}, {0, 0, 1000}}},
      {0, 1, 2}, URAD_SURFACE_PLANAR);
  CHECK(cheapest(quads, 0, 1).way != urad::Way::none);
  const std::vector<urad_point> loop(quads.vertex.begin(), quads.vertex.begin() + 4);
  const std::array<std::size_t, 4> order{3, 0, 2, 1};
  for (std::size_t k = 0; k < 4; ++k) quads.vertex[k] = loop[order[k]];
  CHECK(cheapest(quads, 0, 1).way == urad::Way::none);
  CHECK(cheapest(quads, 0, 1).log2_error_q8 == 0);  // all of it
}
