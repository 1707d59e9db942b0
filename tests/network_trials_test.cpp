// Networks by width and seed: the network in double and its 16 bits agree, and the document holds
// what was measured.
#include "accuracy/network_trials.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "weights/general.h"

TEST_CASE("a network in double and in 16 bits err alike, and every method gets its row") {
  host::NetworkRequest request;
  request.hidden = {2, 3};
  request.seeds = {5};
  request.effort = 0.01;
  request.pairs = 30;
  request.trials = 10;
  request.nets = {[](const std::string&) { return &urad_general; }};
  int trained = 0;
  request.progress = [&](int, std::uint64_t seed) { trained += seed == 5; };
  const std::vector<host::NetworkTrial> trials = host::try_networks(request);
  REQUIRE(trials.size() == 2);
  CHECK(trained == 2);
  for (const host::NetworkTrial& trial : trials) {
    CHECK(trial.real.pairs.pairs > 100);
    CHECK(trial.real.cube.pairs == 72030);
    CHECK(trial.int16.cube.median == doctest::Approx(trial.real.cube.median).epsilon(0.05));
    CHECK(trial.int16.cube.std == doctest::Approx(trial.real.cube.std).epsilon(0.05));
    CHECK(trial.int16.pairs.p95 == doctest::Approx(trial.real.pairs.p95).epsilon(0.05));
    CHECK(trial.int16.cube_apart_std <= 1.01 * trial.int16.cube.std);
    CHECK(trial.int8.cube.std > 0);
  }
  const host::MethodTrials fronts = host::try_fronts(request, trials);
  REQUIRE(!fronts.families.empty());
  CHECK(fronts.families.front().rows.size() == 10 + 2 * 2);
  const std::vector<host::TrainingTrial> none{{"a way", {0.5}, {0.25}, 1}};
  const std::string text =
      host::network_document(trials, fronts, none, none, "urad networks --seeds 5");
  CHECK(text.find("Written by `urad networks --seeds 5`") != text.npos);
  CHECK(text.find("| 2 hidden, alone |") != text.npos);
  CHECK(text.find("| 3 hidden, handing over |") != text.npos);
  CHECK(text.find("nan") == text.npos);
}
