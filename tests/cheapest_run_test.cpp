// Auto in runs, where what all pairs have in common is looked at once and no estimate is asked for:
// the same bits as pair by pair.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"
#include "urad/clip.hpp"
#include "urad/grid.hpp"
#include "urad/vec.hpp"
#include "weights/general.h"

namespace {

using Ways = std::array<std::uint32_t, urad::kWays>;

/// Rows by pair_fill() are those of cheapest_exchange(), and so are the ways; every step-th patch
/// shoots. Returns the ways.
Ways same_as_pairs(const urad_scene& scene, int step) {
  urad_counters counters{}, expected_counters{};
  Ways ways{}, expected_ways{};
  urad::PairSource source{&scene, &urad_general, urad::Kernel::moment, 0, 0, &counters};
  source.log2_error_q8 = urad::kPercentError_q8;
  source.exchange = urad::cheapest_of_source;
  source.ways = ways.data();
  std::vector<std::uint32_t> row(scene.patch_count);
  int different = 0;
  for (int k = 0; k < scene.patch_count; k += step) {
    const urad::Patch i = urad::patch_at(scene, std::uint16_t(k));
    for (std::uint16_t s = 0; s < scene.surface_count; ++s) {
      const urad_surface& to = scene.surface[s];
      counters = expected_counters = {};
      REQUIRE(urad::pair_fill(&source, i.index, s, to.first_patch, to.patch_count, row.data()) ==
              URAD_OK);
      if (counters.skipped_same || counters.skipped_behind) continue;
      for (std::uint16_t n = 0; n < to.patch_count; ++n) {
        const urad::Patch j = urad::patch_at(scene, std::uint16_t(to.first_patch + n));
        if (i.index == j.index) continue;
        const urad::CheapestPair pair = urad::cheapest_exchange(
            scene, i, j, &urad_general, urad::kPercentError_q8, &expected_counters);
        ++expected_ways[std::size_t(pair.way)];
        const std::uint32_t f =
            pair.log2_exchange_q24 == urad::kNoExchange
                ? 0
                : urad::form_factor_uq32(pair.log2_exchange_q24, i.shape->log2_area_q24);
        different += row[n] != f;
      }
      CHECK(counters.evaluated == expected_counters.evaluated);
      CHECK(counters.skipped_facing == expected_counters.skipped_facing);
      CHECK(counters.clipped == expected_counters.clipped);
    }
  }
  CHECK(different == 0);
  CHECK(ways == expected_ways);
  return ways;
}

}  // namespace

TEST_CASE("a run by auto is its pairs: cube7, and a room with walls that cut each other") {
  for (const char* name : {"cube7", "room"}) {
    CAPTURE(name);
    host::Scene scene = host::load_scene(name);
    scene.convex = true;  // no rays: factors as they are
    const host::FixedScene fixed(scene);
    const Ways ways = same_as_pairs(fixed.pod(), 37);
    CHECK(ways[std::size_t(urad::Way::kernel)] > 500);
    CHECK(ways[std::size_t(urad::Way::nine_points)] > 0);
  }
}

TEST_CASE(
    "a patch of a run that lies on the other's plane, within rounding, exchanges nothing there "
    "either") {
  // A floor that looks up, and a strip at its edge that looks at it: a patch of the strip is as high as
  // the tolerance of planes or lower, the next one is not. The run as a whole is in front.
  for (const std::int32_t high : {1, 31, 32, 33, 63, 64, 65, 66, 67, 68, 1000}) {
    CAPTURE(high);
    const std::array<urad_point, 2> origin{{{0, 0, 0}, {0, 0, 0}}};
    std::array<urad_grid, 2> grid{};
    REQUIRE(urad::grid_make(origin[0], {1 << 20, 0, 0}, {0, 1 << 20, 0}, 3, 3, &grid[0]) ==
            urad::Status::ok);
    REQUIRE(urad::grid_make(origin[1], {0, 1 << 20, 0}, {0, 0, high}, 3, 4, &grid[1]) ==
            urad::Status::ok);
    std::array<urad_surface, 2> surface{};
    surface[0] = {0, 9, 0, URAD_SURFACE_PLANAR, &grid[0], nullptr};
    surface[1] = {9, 12, 0, URAD_SURFACE_PLANAR, &grid[1], nullptr};
    urad_scene scene{};
    scene.abi = URAD_SCENE_ABI;
    scene.flags = URAD_SCENE_CONVEX;
    scene.patch_count = 21;
    scene.surface_count = 2;
    scene.surface = surface.data();
    const urad::Side side = urad::side_of_run(scene, urad::patch_at(scene, 0), surface[1]);
    CHECK((side == urad::Side::front) == (4 * high > urad::kPlaneTolerance));
    const Ways ways = same_as_pairs(scene, 1);
    // Those rows of the strip of which no vertex is clear exchange nothing with a floor's patch.
    const auto low_rows = std::uint32_t(std::min(4, urad::kPlaneTolerance / high));
    if (side == urad::Side::front) CHECK(ways[std::size_t(urad::Way::none)] >= 9 * 3 * low_rows);
    CHECK((ways[std::size_t(urad::Way::none)] == 0) == (low_rows == 0 || low_rows == 4));
  }
}

TEST_CASE("guesses are the same integers whether neurons go one by one or four at once") {
  std::mt19937 random(1996);
  std::uniform_int_distribution<int> trait(-urad::kTraitLimit_q8, urad::kTraitLimit_q8);
  const urad::ErrorModels& models = urad::error_models();
  int different = 0;
  for (const urad::ErrorModel* model : {&models.kernel, &models.network, &models.point,
                                        &models.four_points, &models.refined, &models.before_four})
    for (int k = 0; k < 5000; ++k) {
      urad::PairTraits traits{};
      for (std::int16_t& t : traits.log2_q8) t = std::int16_t(trait(random) >> (k & 7));
      traits.pair_class = urad::PairClass(k % urad::kPairClasses);
      const std::int32_t error_q8 = urad::plain::error_q8(*model, traits);
      different += urad::error_q8(*model, traits) != error_q8;
      for (const std::int32_t most_q8 : {error_q8 - 1, error_q8, -1701})
        different += urad::plain::error_within(*model, traits, most_q8) !=
                     urad::error_within(*model, traits, most_q8);
    }
  CHECK(different == 0);
}

TEST_CASE("whether an error is low enough is what the whole guess says") {
  std::mt19937 random(19930719);
  std::uniform_int_distribution<int> trait(-12 * 256, 12 * 256), one_of(0, urad::kPairClasses - 1);
  const urad::ErrorModels& models = urad::error_models();
  int within = 0, cases = 0, wrong = 0;
  for (const urad::ErrorModel* model : {&models.kernel, &models.network, &models.point,
                                        &models.four_points, &models.refined, &models.before_four})
    for (int k = 0; k < 2000; ++k) {
      urad::PairTraits traits{};
      for (std::int16_t& t : traits.log2_q8) t = std::int16_t(trait(random));
      traits.pair_class = urad::PairClass(one_of(random));
      const std::int32_t error_q8 = urad::error_q8(*model, traits);
      for (const std::int32_t most_q8 :
           {error_q8 - 1, error_q8, error_q8 + 1, -2551, -1701, -850, 0, -30000, 30000}) {
        const bool is = urad::error_within(*model, traits, most_q8);
        wrong += is != (error_q8 <= most_q8);
        within += is, ++cases;
      }
    }
  CHECK(wrong == 0);
  CHECK(within > cases / 4);
  CHECK(within < 3 * cases / 4);
}

TEST_CASE("neurons that may say most are asked first") {
  const urad::ErrorModels& models = urad::error_models();
  for (const urad::ErrorModel* model : {&models.kernel, &models.network, &models.point,
                                        &models.four_points, &models.refined, &models.before_four})
    CHECK(std::is_sorted(std::begin(model->out_q8), std::end(model->out_q8),
                         [](int a, int b) { return std::abs(a) > std::abs(b); }));
}
