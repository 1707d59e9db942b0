// The report's training: one step by hand, resuming, units that only fill a vector, a task it can
// learn.
#include <doctest/doctest.h>

#include <cmath>

#include "base/error.hpp"
#include "legacy/backprop.hpp"
#include "legacy/legacy_json.hpp"
#include "network/float_net.hpp"
#include "network/random.hpp"

namespace {

constexpr std::uint64_t kSeed = 1996;

/// Points of a smooth function of the coordinates.
std::vector<host::LegacySample> samples(int count) {
  host::Random random(kSeed);
  std::vector<host::LegacySample> all(static_cast<std::size_t>(count));
  for (host::LegacySample& sample : all) {
    for (float& x : sample.input) x = float(random.uniform());
    sample.target = 0.1F + 0.8F * sample.input[0] * sample.input[13];
  }
  return all;
}

bool same(const host::LegacyNet& a, const host::LegacyNet& b) {
  return a.hidden_weight == b.hidden_weight && a.hidden_bias == b.hidden_bias &&
         a.output_weight == b.output_weight && a.output_bias == b.output_bias;
}

}  // namespace

TEST_CASE("one step of backpropagation is the gradient times the two rates") {
  for (const int hidden : {1, 5, 8, 15, 30, 50, 100}) {
    CAPTURE(hidden);
    host::BackpropSettings settings;
    settings.hidden = hidden;
    settings.epochs = 1;
    settings.seed = kSeed;
    host::LegacySplit split;
    split.training = samples(1);
    split.validation = samples(2);
    host::BackpropState state = host::backprop_start(settings);
    const host::LegacyNet before = state.net;
    host::backprop(split, settings, &state);

    const host::LegacySample& sample = split.training[0];
    const double y = before.run(sample.input);
    const double out = (double(sample.target) - y) * y * (1 - y);
    double worst =
        std::fabs(double(state.net.output_bias) - double(before.output_bias) - 0.1 * out);
    for (std::size_t h = 0; h < std::size_t(hidden); ++h) {
      double z = before.hidden_bias[h];
      for (std::size_t n = 0; n < host::kLegacyInputs; ++n)
        z += double(before.hidden_weight[h * host::kLegacyInputs + n]) * double(sample.input[n]);
      const double s = host::sigmoid(z),
                   delta = out * double(before.output_weight[h]) * s * (1 - s);
      const auto off = [&](float after, float start, double step) {
        worst = std::max(worst, std::fabs(double(after) - double(start) - step));
      };
      off(state.net.output_weight[h], before.output_weight[h], 0.1 * out * s);
      off(state.net.hidden_bias[h], before.hidden_bias[h], delta);
      for (std::size_t n = 0; n < host::kLegacyInputs; ++n) {
        const std::size_t at = h * host::kLegacyInputs + n;
        off(state.net.hidden_weight[at], before.hidden_weight[at], delta * double(sample.input[n]));
      }
    }
    CHECK(std::fabs(out) > 1e-3);
    CHECK(worst <= 2e-7);  // rounding of weights below 1 in single precision
  }
}

TEST_CASE("a training that was interrupted ends with the same bits") {
  const host::LegacySplit split = host::legacy_split(samples(500), kSeed);
  CHECK(split.training.size() == 400);
  CHECK(split.validation.size() == 50);
  CHECK(split.test.size() == 50);
  host::BackpropSettings settings;
  settings.hidden = 15;
  settings.epochs = 12;
  host::BackpropState whole = host::backprop_start(settings), part = whole;
  host::backprop(split, settings, &whole);
  host::backprop(split, settings, &part,
                 [](const host::BackpropState& state) { return state.epoch < 5; });
  CHECK(part.epoch == 5);
  auto resumed = host::backprop_from_json(host::to_json(part, "a command"), "a command");
  REQUIRE(resumed);
  host::backprop(split, settings, &*resumed);
  CHECK(resumed->epoch == 12);
  CHECK(same(resumed->net, whole.net));
  CHECK(same(resumed->best, whole.best));
  CHECK(resumed->best_error == whole.best_error);
  CHECK_FALSE(host::backprop_from_json(host::to_json(part, "a command"), "another"));
  CHECK_FALSE(host::backprop_from_json("{\"format\": 1", "a command"));
}

TEST_CASE("the network learns, and the state with the best validation error is kept") {
  const host::LegacySplit split = host::legacy_split(samples(2000), kSeed);
  host::BackpropSettings settings;
  settings.hidden = 15;
  settings.epochs = 60;
  host::BackpropState state = host::backprop_start(settings);
  const double start = host::legacy_error(state.net, split.test);
  double least = 1;
  host::backprop(split, settings, &state, [&](const host::BackpropState& now) {
    const double error = host::legacy_error(now.net, split.validation);
    least = std::min(least, error);
    CHECK(now.best_error == least);
    return true;
  });
  CHECK(host::legacy_error(state.best, split.test) < start / 20);
  CHECK(host::legacy_error(state.best, split.validation) == state.best_error);
  // The vectors' own sigmoid against the library's.
  double sum = 0;
  for (const host::LegacySample& sample : split.test)
    sum += std::pow(state.best.run(sample.input) - double(sample.target), 2);
  CHECK(sum / double(split.test.size()) ==
        doctest::Approx(host::legacy_error(state.best, split.test)).epsilon(1e-4));
}

TEST_CASE("both scalings are undone, and log scaling refuses what it has no image for") {
  using host::LegacyScaling;
  CHECK(host::legacy_scaled(LegacyScaling::linear, 0) == 0.1);
  CHECK(host::legacy_scaled(LegacyScaling::linear, 1) == doctest::Approx(0.9));
  CHECK(host::legacy_scaled(LegacyScaling::log, 1) == 0.1);
  CHECK(host::legacy_scaled(LegacyScaling::log, 1e-8) == doctest::Approx(0.9));
  for (const LegacyScaling scaling : {LegacyScaling::linear, LegacyScaling::log})
    for (const double f : {1e-8, 3e-4, 0.2, 1.0})
      CHECK(host::legacy_unscaled(scaling, host::legacy_scaled(scaling, f)) ==
            doctest::Approx(f).epsilon(1e-6));
  CHECK_THROWS_AS(host::legacy_scaled(LegacyScaling::log, 0), host::Error);
  CHECK_THROWS_AS(host::legacy_input({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {.5, 1, 0}, {0, 1, 0}}, {}},
                                     {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, {}}),
                  host::Error);
}

TEST_CASE("a network file says what it is, and what is wrong with it") {
  host::LegacyNetFile file;
  host::BackpropSettings settings;
  settings.hidden = 5;
  file.net = host::backprop_start(settings).net;
  file.fixed = host::round_legacy(file.net);
  file.command = "a command";
  const std::string text = host::to_json(file);
  CHECK(host::is_legacy_json(text));
  CHECK_FALSE(host::is_legacy_json("{\"version\": 1}"));
  CHECK_FALSE(host::is_legacy_json(text.substr(0, 50)));
  CHECK(same(host::legacy_from_json(text, "x").net, file.net));
  CHECK(host::to_json(host::legacy_from_json(text, "x")) == text);
  for (const std::string& bad : {text.substr(0, text.size() / 2), std::string("{}")})
    CHECK_THROWS_AS(host::legacy_from_json(bad, "x"), host::Error);
}
