// Networks that guess an error: on errors with a known quantile, in the engine's integers.
#include "accuracy/error_training.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.hpp"
#include "network/random.hpp"
#include "urad/error_guess.hpp"

namespace {

constexpr int kInputs = 3, kSteps = 3000;

/// log2 error: the greater of two causes, and normal noise of one bit about it.
host::ErrorSample sample(host::Random& random) {
  host::ErrorSample s;
  for (std::size_t k = 0; k < kInputs; ++k) s.trait[k] = float(random.uniform(-8, 0));
  s.error = float(std::max(2.0 * double(s.trait[0]), double(s.trait[1]) - 4) + random.normal());
  return s;
}

urad::PairTraits traits_of(const host::ErrorSample& s) {
  urad::PairTraits traits{};
  for (std::size_t k = 0; k < kInputs; ++k)
    traits.log2_q8[k] = std::int16_t(std::lround(256 * double(s.trait[k])));
  return traits;
}

}  // namespace

TEST_CASE("a trained guess covers its share of errors and follows what causes them") {
  host::Random random(7);
  std::vector<host::ErrorSample> seen, others;
  for (int k = 0; k < 4000; ++k) seen.push_back(sample(random)), others.push_back(sample(random));
  const urad::ErrorModel model = host::train_error_model(seen, kInputs, 0.9, 1, kSteps);
  int covered = 0;
  double off = 0;
  for (const host::ErrorSample& s : others) {
    const double guess = urad::error_q8(model, traits_of(s)) / 256.0;
    covered += double(s.error) <= guess;
    const double truth =
        std::max(2.0 * double(s.trait[0]), double(s.trait[1]) - 4) + 1.2816;  // 90 % of a normal
    off += std::fabs(guess - truth) / double(others.size());
  }
  MESSAGE("covered ", covered, " of ", others.size(), ", mean distance from the quantile ", off);
  CHECK(covered > 3480);
  CHECK(covered < 3720);
  CHECK(off < 0.4);
}

TEST_CASE("shifts are added class by class; nothing can be learnt from nothing") {
  urad::ErrorModel model{};
  model.traits = kInputs;
  model.bias_q8 = 100;
  model.shift_q8[2] = 7;
  urad::PairTraits traits{};
  traits.pair_class = urad::PairClass::near;
  CHECK(urad::error_q8(model, traits) == 107);
  traits.pair_class = urad::PairClass::cut;
  CHECK(urad::error_q8(model, traits) == 100);
  CHECK_THROWS_AS(host::train_error_model({}, kInputs, 0.9, 1), host::Error);
}
