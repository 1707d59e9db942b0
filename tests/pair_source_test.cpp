// Rows of factors from pairs: skips that leave the bits, counters that add up, reciprocity, and the
// network's own bits.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "method/engine_source.hpp"
#include "scene/builtin.hpp"
#include "urad/form_factor.hpp"
#include "weights/cornell.h"
#include "weights/cube7.h"
#include "weights/general.h"

namespace {

const host::NetChoice kNets{[](const std::string& name) -> const urad_net* {
  return name == "cube7" ? &urad_cube7 : name == "cornell" ? &urad_cornell : &urad_general;
}};

host::EngineRows rows(const host::FixedScene& scene, const std::string& method,
                      std::uint32_t skips_off) {
  return host::engine_rows(scene, host::parse_method(method), kNets, {16, skips_off}, 0);
}

std::uint64_t accounted(const urad_counters& c) {
  return std::uint64_t{c.evaluated} + c.skipped_same + c.skipped_facing;
}

}  // namespace

TEST_CASE("evaluated and skipped pairs add up, and any skip switched off leaves the bits") {
  for (const char* name : {"cube7", "cornell"}) {
    CAPTURE(name);
    const host::Scene scene = host::load_scene(name);
    const host::FixedScene fixed(scene);
    const std::uint64_t n = scene.patches.size();
    const host::EngineRows all = rows(fixed, std::string("net:") + name, 0);
    CHECK(accounted(all.counters) == n * (n - 1));
    CHECK(all.counters.far_pairs > 0);
    CHECK(all.counters.networks ==
          all.counters.evaluated - all.counters.far_pairs - all.counters.near_pairs);
    CHECK(all.counters.skipped_same > 0);
    for (const std::uint32_t off :
         {urad::skip_off_far, urad::skip_off_facing, urad::skip_off_same}) {
      CAPTURE(off);
      const host::EngineRows without = rows(fixed, std::string("net:") + name, off);
      CHECK(without.f_uq32 == all.f_uq32);
      CHECK(accounted(without.counters) == n * (n - 1));
      if (off == urad::skip_off_same) CHECK(without.counters.skipped_same == 0);
    }
    for (const char* method : {"fixed-kernel", "fixed-moment", "hemicube:32", "hybrid:32"}) {
      CAPTURE(method);
      CHECK(accounted(rows(fixed, method, 0).counters) == n * (n - 1));
    }
  }
}

TEST_CASE("no factor exceeds 1, and A F is reciprocal to the rounding of F") {
  const host::Scene scene = host::load_scene("cornell");
  const host::FixedScene fixed(scene);
  const host::EngineRows f = rows(fixed, "net:cornell", 0);
  for (std::size_t i = 0; i < f.patches; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double a_i = scene.patches[i].moments.area, a_j = scene.patches[j].moments.area;
      const double rounding = (a_i + a_j) * 0x1p-32 + 4e-6 * a_i * f(i, j);
      CHECK(std::fabs(a_i * f(i, j) - a_j * f(j, i)) <= rounding);
      CHECK(f(i, j) <= 1.0);
    }
  }
}

TEST_CASE("the exchange of a pair is one integer, whichever patch comes first") {
  const host::FixedScene fixed(host::load_scene("cornell"));
  const urad_scene& scene = fixed.pod();
  urad_counters counters{};
  for (std::uint16_t i = 0; i < scene.patch_count; i = std::uint16_t(i + 3)) {
    for (std::uint16_t j = 0; j < i; j = std::uint16_t(j + 2)) {
      const urad::Patch a = urad::patch_at(scene, i), b = urad::patch_at(scene, j);
      CHECK(
          urad::exchange_log2_q24(scene, a, b, urad::Kernel::moment, &urad_general, 0, &counters) ==
          urad::exchange_log2_q24(scene, b, a, urad::Kernel::moment, &urad_general, 0, &counters));
    }
  }
}

TEST_CASE("an exact pair counts as a near one, or as one that does not face the other") {
  const host::Polygon floor{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}};
  const host::Polygon above{{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, {}};
  const host::Polygon turned{{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, {}};
  const auto asked = [&](const host::Polygon& other, urad_counters* counters) {
    const host::FixedScene scene = host::FixedScene::of_polygons({floor, other}, {});
    const urad::Patch i = urad::patch_at(scene.pod(), 0), j = urad::patch_at(scene.pod(), 1);
    const std::int32_t g = urad::exchange_exact_q24(scene.pod(), i, j, 2, counters);
    return urad::form_factor_uq32(g, i.shape->log2_area_q24) / 0x1p32;
  };
  urad_counters facing{}, away{};
  CHECK(asked(above, &facing) == doctest::Approx(0.19982).epsilon(2e-3));  // [Howell C-11]
  CHECK(facing.evaluated == 1);
  CHECK(facing.near_pairs == 1);
  CHECK(facing.skipped_facing == 0);
  CHECK(facing.sums >= 4);
  CHECK(asked(turned, &away) == 0);
  CHECK(away.evaluated == 0);
  CHECK(away.near_pairs == 0);
  CHECK(away.skipped_facing == 1);
}
