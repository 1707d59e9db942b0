// The C interface of auto: what cheapest.hpp says, and nothing for wrong arguments.
#include "urad/auto.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "accuracy/trial_pairs.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"
#include "weights/general.h"

namespace {

constexpr std::uint64_t kSeed = 20110703;
constexpr double kOne = 4294967296.0;

}  // namespace

TEST_CASE("C: auto gives the factor, a bound of its error and the way") {
  for (const host::TrialFamily& family : host::trial_families()) {
    const host::PairSet set = host::trial_pairs(family, host::TrialUse::test, kSeed, 10, 0);
    for (std::size_t k = 0; k < set.pairs.size(); ++k) {
      const host::FixedScene scene =
          host::FixedScene::of_polygons({set.pairs[k].p, set.pairs[k].q}, {});
      urad_auto_factor factor{};
      urad_counters counters{}, by_engine{};
      REQUIRE(urad_form_factor_auto(&scene.pod(), 0, 1, &urad_general, URAD_PERCENT, &factor,
                                    &counters) == URAD_OK);
      const urad::CheapestPair pair = urad::cheapest_exchange(
          scene.pod(), urad::patch_at(scene.pod(), 0), urad::patch_at(scene.pod(), 1),
          &urad_general, urad::kPercentError_q8, &by_engine);
      CHECK(int(factor.way) == int(pair.way));
      CHECK(factor.points == pair.point_sums);
      CHECK(counters.evaluated == 1);
      const double estimate = std::exp2(pair.log2_error_q8 / 256.0) + 0.5 / factor.f_uq32;
      CHECK(factor.error_uq32 / kOne == doctest::Approx(std::min(estimate, 1.0)).epsilon(1e-5));

      alignas(8) unsigned char memory[256];
      REQUIRE(urad_pair_source_bytes() <= sizeof memory);
      urad_source source{};
      REQUIRE(urad_auto_source_init(&source, &scene.pod(), &urad_general, URAD_PERCENT, 0,
                                    &counters, memory, sizeof memory) == URAD_OK);
      std::uint32_t f_uq32 = 0;
      REQUIRE(source.fill(source.context, 0, 1, 1, 1, &f_uq32) == URAD_OK);
      CHECK(f_uq32 == factor.f_uq32);
    }
  }
}

TEST_CASE("C: auto refuses what it cannot do") {
  const host::PairSet set =
      host::trial_pairs(host::trial_families().front(), host::TrialUse::test, kSeed, 1, 1);
  const host::FixedScene scene =
      host::FixedScene::of_polygons({set.pairs[0].p, set.pairs[0].q}, {});
  const urad_scene* const pod = &scene.pod();
  urad_auto_factor factor{};
  urad_counters counters{};
  alignas(8) unsigned char memory[256];
  urad_source source{};
  CHECK(urad_form_factor_auto(nullptr, 0, 1, nullptr, URAD_PERCENT, &factor, nullptr) ==
        URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor_auto(pod, 2, 0, nullptr, URAD_PERCENT, &factor, nullptr) ==
        URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor_auto(pod, 0, 2, nullptr, URAD_PERCENT, &factor, nullptr) ==
        URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor_auto(pod, 0, 1, nullptr, 4295, &factor, nullptr) == URAD_BAD_ARGUMENT);
  CHECK(urad_form_factor_auto(pod, 0, 1, nullptr, URAD_PERCENT, nullptr, nullptr) ==
        URAD_BAD_ARGUMENT);
  urad_net other = urad_general;
  other.inputs = 3;
  CHECK(urad_form_factor_auto(pod, 0, 1, &other, URAD_PERCENT, &factor, nullptr) == URAD_BAD_NET);
  CHECK(urad_form_factor_auto(pod, 1, 1, nullptr, URAD_PERCENT, &factor, nullptr) == URAD_OK);
  CHECK(factor.f_uq32 == 0);
  CHECK(factor.way == URAD_WAY_NONE);
  CHECK(urad_auto_source_init(&source, pod, nullptr, 0, 0, &counters, memory, sizeof memory) ==
        URAD_BAD_ARGUMENT);
  CHECK(urad_auto_source_init(&source, pod, nullptr, URAD_PERCENT, 0, &counters, memory, 4) ==
        URAD_OUT_OF_MEMORY);
}

TEST_CASE("C: auto needs no counters, and says when nothing or less than a unit is exchanged") {
  const host::Polygon floor{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}};
  const auto above = [&](double size, bool turned) {
    host::Polygon plate{{{0, 0, 1}, {0, size, 1}, {size, size, 1}, {size, 0, 1}}, {}};
    if (turned) std::reverse(plate.outer.begin(), plate.outer.end());
    const host::FixedScene scene = host::FixedScene::of_polygons({floor, plate}, {});
    urad_auto_factor factor{};
    REQUIRE(urad_form_factor_auto(&scene.pod(), 0, 1, nullptr, URAD_PERCENT, &factor, nullptr) ==
            URAD_OK);
    return factor;
  };
  const urad_auto_factor one = above(1, false), none = above(1, true);
  CHECK(one.f_uq32 / kOne == doctest::Approx(0.19982).epsilon(0.01));
  CHECK(none.way == URAD_WAY_NONE);
  CHECK(none.f_uq32 == 0);
  CHECK(none.error_uq32 < 0xFFFFFFFFu);
  // F = 0.139 size^2: a small part of a unit of 2^-32 is 0, and all of it may be wrong.
  const urad_auto_factor small = above(1e-5, false);
  CHECK(small.way != URAD_WAY_NONE);
  CHECK(small.f_uq32 == 0);
  CHECK(small.error_uq32 == 0xFFFFFFFFu);
  const urad_auto_factor some = above(1e-4, false);
  CHECK(some.f_uq32 == 6);
  CHECK(some.error_uq32 > (1u << 31) / some.f_uq32);  // half a unit at least
}
