// Levenberg-Marquardt: it finds a known net, its model is the derivative of its loss, and stopping
// loses nothing.
#include "network/trainer.hpp"

#include <doctest/doctest.h>

#include "base/error.hpp"
#include "network/checkpoint.hpp"
#include "network/engine_range.hpp"
#include "network/net_rounding.hpp"
#include "network/quantise.hpp"
#include "network/random.hpp"

namespace {

constexpr std::uint64_t kSeed = 20240301;

// Samples whose targets come from a net that is known, gate times noise-free y.
host::TrainingSet taught_set(const host::FloatNet& teacher, std::size_t count, std::uint64_t seed) {
  host::Random random(seed);
  host::TrainingSet set;
  set.rows = 3;
  set.row_weight = 0.5;
  for (std::size_t k = 0; k < count; ++k) {
    host::Sample sample;
    for (auto& x : sample.input_q15) x = std::int16_t(random.uniform(-20000, 20000));
    sample.gate_uq16 = std::uint16_t(random.uniform(1000, 20000));
    sample.target = sample.gate() * teacher.run(sample.input_q15.data());
    sample.weight = random.uniform(0.5, 2);
    set.samples.push_back(sample);
    set.row_terms.push_back({std::uint32_t(k % 3), std::uint32_t(k), random.uniform(0.1, 0.3)});
  }
  return set;
}

host::FloatNet random_net(int hidden, std::uint64_t seed) {
  host::Random random(seed);
  host::FloatNet net(urad::kPairInputs, hidden);
  for (double& p : net.parameters) p = random.normal();
  return net;
}

host::TrainerSettings settings(int hidden) {
  host::TrainerSettings s;
  s.hidden = hidden, s.seed = kSeed, s.decay = 1e-14, s.threads = 2;
  s.stages = {{4, 30, 0}, {2, 60, 0}};
  return s;
}

}  // namespace

TEST_CASE(
    "the model's gradient is the slope of the objective, and its curvature that of the squares") {
  INFO("seed ", kSeed);
  const host::TrainingSet set = taught_set(random_net(3, kSeed), 700, kSeed + 1);
  const host::Normalisation scaling = host::normalisation(set);
  const host::Objective objective(set, scaling, 2);
  host::FloatNet net = random_net(3, kSeed + 2);
  for (const double robust : {0.0, 0.05}) {
    Eigen::MatrixXd hessian;
    Eigen::VectorXd gradient;
    const double at = objective.model(net, robust, &hessian, &gradient);
    CHECK(at == objective.value(net, robust));
    CHECK((hessian - hessian.transpose()).norm() == 0);
    for (Eigen::Index p = 0; p < net.parameters.size(); ++p) {
      const double h = 1e-5;
      host::FloatNet up = net, down = net;
      up.parameters[p] += h, down.parameters[p] -= h;
      const double slope = (objective.value(up, robust) - objective.value(down, robust)) / (2 * h);
      INFO("parameter ", p, " robust ", robust);
      CHECK(-2 * gradient[p] == doctest::Approx(slope).epsilon(1e-5).scale(at));
    }
  }
}

TEST_CASE("the objective has the same bits on one thread and on three") {
  const host::TrainingSet set = taught_set(random_net(2, kSeed), 5000, kSeed + 3);
  const host::Normalisation scaling = host::normalisation(set);
  const host::FloatNet net = random_net(2, kSeed + 4);
  Eigen::MatrixXd one, three;
  Eigen::VectorXd g_one, g_three;
  const double a = host::Objective(set, scaling, 1).model(net, 0, &one, &g_one);
  const double b = host::Objective(set, scaling, 3).model(net, 0, &three, &g_three);
  CHECK(a == b);
  CHECK(one == three);
  CHECK(g_one == g_three);
}

TEST_CASE("a net learns what a net of the same size says") {
  const host::FloatNet teacher = random_net(2, kSeed + 5);
  const host::TrainingSet set = taught_set(teacher, 600, kSeed + 6);
  const host::TrainingSet other = taught_set(teacher, 200, kSeed + 7);
  host::TrainerSettings many = settings(2);
  many.stages = {{24, 30, 0}, {4, 200, 0}};
  const auto net = host::train(set, {}, many);
  REQUIRE(net);
  double worst = 0;
  for (const host::Sample& s : other.samples)
    worst = std::max(worst, std::fabs(s.target - s.gate() * net->run(s.input_q15.data())));
  CHECK(worst < 1e-4);
}

TEST_CASE("inputs set off against each other end in weights that the engine can hold") {
  host::TrainingSet set = taught_set(random_net(2, kSeed + 8), 400, kSeed + 9);
  host::Random random(kSeed + 10);
  for (host::Sample& s : set.samples) {
    const int apart = int(random.below(25)) - 12;  // units of 2^-15
    s.input_q15[1] = std::int16_t(s.input_q15[0] / 2 + apart);
    s.input_q15[0] = std::int16_t(s.input_q15[0] / 2);
    s.target = s.gate() * apart;  // 32768 (x1 - x0)
  }
  const auto net = host::train(set, {}, settings(2));
  REQUIRE(net);
  CHECK(host::engine_can_hold(*net));
  CHECK_NOTHROW(host::QuantisedNet(host::round_net(*net, 16, 0)));
  host::FloatNet ideal(urad::kPairInputs, 2);
  ideal.parameters[ideal.skip_at()] = -32768, ideal.parameters[ideal.skip_at() + 1] = 32768;
  CHECK_FALSE(host::engine_can_hold(ideal));
  CHECK_THROWS_AS(host::QuantisedNet(host::round_net(ideal, 16, 0)), host::Error);
}

TEST_CASE("a training that is stopped and resumed through its file ends with the same bits") {
  const host::TrainingSet set = taught_set(random_net(2, kSeed + 8), 300, kSeed + 9);
  const auto whole = host::train(set, {}, settings(3));
  REQUIRE(whole);
  for (const int stop_after : {1, 47, 130}) {
    host::TrainerHooks hooks;
    host::Checkpoint saved;
    saved.command = "urad train";
    int steps = 0;
    hooks.step = [&](const host::TrainerProgress& progress, const host::TrainerState& state) {
      CHECK(progress.done <= 1);
      saved.state = state;
      return ++steps < stop_after;
    };
    REQUIRE_FALSE(host::train(set, {}, settings(3), hooks));
    const auto read =
        host::checkpoint_from_json(host::to_json(saved), saved.command, "net.json.partial");
    REQUIRE(read);
    host::TrainerHooks rest;
    rest.resume = read->state;
    const auto resumed = host::train(set, {}, settings(3), rest);
    REQUIRE(resumed);
    CHECK(resumed->parameters == whole->parameters);
  }
}

TEST_CASE("a checkpoint of another command, or cut short, is of no use") {
  host::Checkpoint saved;
  saved.command = "urad train --seed 1";
  const std::string text = host::to_json(saved);
  const auto read = [](const std::string& checkpoint, const char* command) {
    return host::checkpoint_from_json(checkpoint, command, "net.json.partial");
  };
  CHECK(read(text, "urad train --seed 1"));
  CHECK_FALSE(read(text, "urad train --seed 2"));
  CHECK_FALSE(read(text.substr(0, text.size() / 2), "urad train --seed 1"));
  CHECK_FALSE(read("[]", "urad train --seed 1"));
}

TEST_CASE("an altered checkpoint is refused by name: it would end in another net") {
  host::Checkpoint saved;
  saved.command = "urad train";
  saved.finished = {{0.25, -1.5}};
  saved.state.candidates.push_back({0, {1, 2}, {3, 4}, 5, 6, 7, false});
  const std::string text = host::to_json(saved);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"0.25", "0.35"}, {"\"stage\":0", "\"stage\":9"}, {"[3.0,4.0]", "\"x\""}}) {
    std::string altered = text;
    REQUIRE(altered.find(from) != std::string::npos);
    altered.replace(altered.find(from), from.size(), to);
    CHECK_THROWS_WITH_AS(host::checkpoint_from_json(altered, "urad train", "net.json.partial"),
                         doctest::Contains("net.json.partial: "), host::Error);
  }
}

TEST_CASE("only the parameters that are free move") {
  const host::TrainingSet set = taught_set(random_net(2, kSeed + 10), 300, kSeed + 11);
  const host::FloatNet start = random_net(2, kSeed + 12);
  std::vector<char> free(std::size_t(start.parameters.size()), 0);
  for (int p = start.output_at(); p <= start.bias_at(); ++p) free[std::size_t(p)] = 1;
  const host::FloatNet moved = host::refine(start, {set, host::normalisation(set), 1},
                                            host::normalisation(set), free, 5, 0, 0);
  for (int p = 0; p < start.hidden_bias_at(); ++p)
    CHECK(moved.parameters[p] == doctest::Approx(start.parameters[p]).epsilon(1e-12));
  CHECK((moved.parameters - start.parameters).norm() > 1e-3);
}

TEST_CASE("settings that make no sense are refused") {
  const host::TrainingSet set = taught_set(random_net(1, kSeed), 20, kSeed);
  host::TrainerSettings s = settings(1);
  s.stages = {{1, 5, 0}, {2, 5, 0}};
  CHECK_THROWS_AS(host::train(set, {}, s), host::Error);
  s.stages.clear();
  CHECK_THROWS_AS(host::train(set, {}, s), host::Error);
  host::TrainingSet far = set;
  for (host::Sample& sample : far.samples) sample.gate_uq16 = 0;
  CHECK_THROWS_AS(host::train(far, {}, settings(1)), host::Error);
}
