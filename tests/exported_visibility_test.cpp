// Visible parts in flash: what is read is what was made, light by them, and bytes that are not trusted.
#include "solve/exported_visibility.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.hpp"
#include "method/engine_source.hpp"
#include "scene/builtin.hpp"
#include "solve/embree_visibility.hpp"
#include "solve/scene_solver.hpp"
#include "urad/urad.h"
#include "weights/general.h"

namespace {

const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_general; }};
constexpr host::VisibilityCode kCodes[] = {host::VisibilityCode::bits,
                                           host::VisibilityCode::fractions};
const host::MethodSpec kNet = host::parse_method("net");

}  // namespace

TEST_CASE("the engine reads of every pair what was exported, and makes no ray") {
  constexpr int kRays = 16;
  for (const char* name : {"cornell", "louvre", "room"}) {
    const host::Scene scene = host::load_scene(name, {2, 0});
    host::FixedScene fixed(scene);
    const host::EngineRows open = host::engine_rows(fixed, kNet, kNets, {.rays = 0}, 0);
    const host::EmbreeVisibility truth(scene, kRays);
    for (const host::VisibilityCode code : kCodes) {
      CAPTURE(name);
      const bool bits = code == host::VisibilityCode::bits;
      fixed.set_visibility(host::make_visibility(scene, fixed, code, kRays, 0));
      REQUIRE(urad_scene_check(&fixed.pod()) == URAD_OK);
      const host::EngineRows rows = host::engine_rows(fixed, kNet, kNets, {.rays = 16}, 0);
      CHECK(rows.counters.rays == 0);
      CHECK(rows.counters.sights == rows.counters.evaluated);
      CHECK(rows.counters.blocked > 0);
      double seen = 0, read = 0;
      int wrong = 0;
      for (std::size_t i = 0; i < rows.patches; ++i) {
        for (std::size_t j = 0; j < rows.patches; ++j) {
          const double f = open(i, j), g = rows(i, j);
          wrong += g > f;
          if (f < 1e-6) continue;
          const double exact = truth.fraction(i, j), part = g / f;
          wrong += std::abs(part - exact) > (bits ? 1 : 0.5 / 15) + 1e-3;
          wrong += (exact == 0 && g != 0) || (exact == 1 && g != f);
          wrong += bits && g != 0 && g != f;
          seen += exact * f, read += g;
        }
      }
      CHECK(wrong == 0);
      CHECK(read == doctest::Approx(seen).epsilon(0.01));
    }
  }
}

TEST_CASE("radiosity by exported visibility: fractions to 1 % rms, bits to 6 %") {
  for (const char* name : {"cornell", "louvre", "room"}) {
    for (const host::VisibilityCode code : kCodes) {
      const host::Scene scene = host::load_scene(name);
      host::SceneSolver solver(scene, 0, true, 256);
      const host::VisibilityTables& tables = solver.use_visibility(code);
      host::SolveGoal goal;
      goal.error = 0.001;
      const double rms = solver.run(kNet, kNets, goal).rms;
      MESSAGE(std::string(name) << ": " << 100 * rms << " % rms, " << host::to_line(tables));
      CHECK(rms <= (code == host::VisibilityCode::bits ? 0.06 : 0.01));
      CHECK(tables.bytes() < 4 * tables.row.size() + 16 +
                                 tables.row.size() * (tables.row.size() * tables.bits + 7) / 8);
    }
  }
}

TEST_CASE("codes that do not end with the last patch are refused") {
  const host::Scene scene = host::load_scene("louvre", {2, 0});
  host::FixedScene fixed(scene);
  for (const host::VisibilityCode code : kCodes) {
    fixed.set_visibility(host::make_visibility(scene, fixed, code, 16, 0));
    const urad_visibility good = *fixed.pod().visibility;
    std::vector<std::uint32_t> row(good.row, good.row + good.patch_count);
    std::vector<std::uint8_t> codes(good.code, good.code + good.byte_count);
    urad_visibility table = good;
    table.row = row.data(), table.code = codes.data();
    urad_scene pod = fixed.pod();
    pod.visibility = &table;
    const auto check = [&] { return urad_scene_check(&pod); };
    REQUIRE(check() == URAD_OK);
    const auto refused = [&](auto& value, auto other) {
      const auto kept = value;
      value = static_cast<std::decay_t<decltype(value)>>(other);
      const bool found = check() == URAD_BAD_SCENE;
      value = kept;
      return found && check() == URAD_OK;
    };
    CHECK(refused(table.bits, 2));
    CHECK(refused(table.patch_count, table.patch_count - 1));
    CHECK(refused(table.byte_count, table.byte_count - 1));
    CHECK(refused(table.byte_count, 0));
    CHECK(refused(row[3], good.byte_count));
    CHECK(refused(row[3], 0xFFFFFFFFu));
    CHECK(refused(row[3], good.byte_count - 1));
    CHECK(refused(table.row, nullptr));
    CHECK(refused(table.code, nullptr));
    int longer = 0;
    for (const std::uint32_t start : row) {
      if (!(start & URAD_VISIBILITY_RUNS)) continue;
      std::uint8_t& first = codes[start & ~URAD_VISIBILITY_RUNS];
      if ((first & (0xFF >> table.bits)) == 0xFF >> table.bits) continue;
      CHECK(refused(first, first + 1));  // a patch more than there are
      ++longer;
    }
    CHECK(longer > 0);
    table.patch_count = 0;
    pod.abi = URAD_SCENE_ABI;  // not looked at
    CHECK(check() == URAD_OK);
  }
  CHECK_THROWS_AS(host::parse_visibility_code("bytes"), host::UsageError);
  CHECK_THROWS_AS(fixed.set_visibility({}), host::Error);
}
