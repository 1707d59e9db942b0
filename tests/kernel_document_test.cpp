// What was tried instead: every trial gets its table, and guesses that are told more do no worse.
#include "accuracy/kernel_document.hpp"

#include <doctest/doctest.h>

#include "accuracy/error_training.hpp"
#include "network/random.hpp"
#include "weights/general.h"

TEST_CASE("the document of other kernels holds every trial") {
  host::KernelTrialRequest request;
  request.effort = 0.02;
  request.net = &urad_general;
  request.threads = 2;
  const std::string text = host::kernel_document(host::try_kernels(request), "urad kernels");
  for (const char* row :
       {"Written by `urad kernels`", "| triangles | 0.001 .. 0.01 |", "| the Cornell box | 0.01 |",
        "| 16 pairs of points, 8 hidden | 0.01 .. 0.3 |", "| shared edge | "}) {
    CAPTURE(row);
    CHECK(text.find(row) != text.npos);
  }
  CHECK(text.find("nan") == text.npos);
  CHECK(text.find("inf") == text.npos);
}

TEST_CASE("a guess of any width covers the share of errors it was asked to cover") {
  constexpr std::uint64_t kGuessSeed = 11;
  constexpr Eigen::Index kSamples = 4000;
  MESSAGE("seed ", kGuessSeed);
  host::Random random(kGuessSeed);
  Eigen::MatrixXd traits(kSamples, 2);
  Eigen::VectorXd errors(kSamples);
  for (Eigen::Index k = 0; k < kSamples; ++k) {
    traits(k, 0) = random.uniform(-8, 0), traits(k, 1) = random.uniform(-2, 2);
    errors[k] = 2 * traits(k, 0) + traits(k, 1) * traits(k, 1) + random.normal();
  }
  const Eigen::VectorXd guess =
      host::guess_errors(traits, errors, traits, {24, 0.9, kGuessSeed, 3000});
  const auto covered = double((guess.array() >= errors.array()).count()) / double(kSamples);
  CHECK(covered > 0.87);
  CHECK(covered < 0.93);
  CHECK((guess - errors).cwiseAbs().mean() < 2);  // 1.4 for a guess that knows all but the noise
}
