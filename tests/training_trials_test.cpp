// Ways to train: each row holds what was reached, and the one that is shipped is no worse.
#include "accuracy/training_trials.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "network/general_pairs.hpp"
#include "network/trainer.hpp"
#include "urad/pair.hpp"

namespace {

constexpr std::uint64_t kSeed = 3;

host::TrainingTrialRequest small_request() {
  host::TrainingTrialRequest request;
  request.hidden = 3;
  request.seeds = {kSeed};
  request.effort = 0.05;
  request.threads = 2;
  return request;
}

}  // namespace

TEST_CASE("L-BFGS and Adam start where Levenberg-Marquardt does, and get somewhere") {
  MESSAGE("seed ", kSeed);
  const auto trials = host::try_optimisers(small_request());
  REQUIRE(trials.size() == 5);
  const host::GeneralDataset data = host::general_dataset(0.01, kSeed, 0.03, 2);
  const host::Normalisation scaling = host::normalisation(data.training);
  const host::FloatNet start = host::random_start(3, kSeed, 0);
  const double before = std::sqrt(host::Objective(data.validation, scaling, 1).value(start, 0.03));
  for (const host::TrainingTrial& trial : trials) {
    CAPTURE(trial.name);
    REQUIRE(trial.validation.size() == 1);
    CHECK(trial.validation[0] > 0);
    CHECK(trial.validation[0] <= before);
    CHECK(trial.training[0] > 0);
  }
  // Adam has few steps in the time that this test allows, fewer still under sanitizers.
  for (const int way : {0, 1, 3}) CHECK(trials[std::size_t(way)].validation[0] < before);
  CHECK(host::training_table(trials).find("| Levenberg-Marquardt |") != std::string::npos);
}

TEST_CASE(
    "each input held at 0 changes what is reached, and some are missed even by a short training") {
  MESSAGE("seed ", kSeed);
  const auto trials = host::try_inputs(small_request());
  REQUIRE(trials.size() == 1 + urad::kPairInputs);
  int missed = 0;
  for (std::size_t k = 1; k < trials.size(); ++k) {
    CAPTURE(trials[k].name);
    CHECK(trials[k].training[0] != trials[0].training[0]);
    missed += trials[k].training[0] > trials[0].training[0];
  }
  CHECK(missed > 0);
}

TEST_CASE("the slope of the objective is the model's") {
  const host::GeneralDataset data = host::general_dataset(0.01, kSeed, 0.01, 2);
  const host::Objective objective(data.training, host::normalisation(data.training), 2);
  const host::FloatNet net = host::random_start(3, kSeed, 1);
  Eigen::VectorXd alone, beside;
  Eigen::MatrixXd hessian;
  CHECK(objective.slope(net, 0.03, &alone) == objective.model(net, 0.03, &hessian, &beside));
  CHECK(alone == beside);
}
