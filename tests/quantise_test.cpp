// Integers against the net they come from: the engine's own network_run() is what is measured.
#include "network/quantise.hpp"
#include "network/net_rounding.hpp"

#include <doctest/doctest.h>

#include "base/error.hpp"
#include "network/random.hpp"
#include "network/trainer.hpp"
#include "urad/network.hpp"

namespace {

constexpr std::uint64_t kSeed = 20240302;

host::FloatNet random_net(int hidden, double size, std::uint64_t seed) {
  host::Random random(seed);
  host::FloatNet net(urad::kPairInputs, hidden);
  for (double& p : net.parameters) p = size * random.normal();
  return net;
}

host::Sample random_sample(host::Random& random) {
  host::Sample sample;
  for (auto& x : sample.input_q15) x = std::int16_t(random.uniform(-32767, 32768));
  sample.gate_uq16 = 20000;
  return sample;
}

// Inputs that hang together, as a pair's do: only then can one weight make up for another's
// rounding.
host::Sample related_sample(host::Random& random) {
  host::Sample sample;
  const double a = random.uniform(-1, 1), b = random.uniform(-1, 1), c = random.uniform(-1, 1);
  for (std::size_t n = 0; n < sample.input_q15.size(); ++n) {
    const double t = double(n);
    const double x =
        a * std::cos(t) + b * std::sin(2 * t) + c * std::cos(3 * t) + 0.05 * random.uniform(-1, 1);
    sample.input_q15[n] = std::int16_t(10000 * x);
  }
  sample.gate_uq16 = 20000;
  return sample;
}

template <class Draw>
double rms(const host::QuantisedNet& q, const host::FloatNet& net, std::uint64_t seed, Draw draw) {
  host::Random random(seed);
  double sum = 0;
  for (int k = 0; k < 2000; ++k) {
    const host::Sample s = draw(random);
    const double y = std::clamp(net.run(s.input_q15.data()), -16.0, 16.0);  // as the engine does
    const double e = urad::network_run(q.pod(), s.input_q15.data()) * 0x1p-16 - y;
    sum += e * e;
  }
  return std::sqrt(sum / 2000);
}

}  // namespace

TEST_CASE("rescale_of keeps 16 bits over its whole range, and refuses the rest") {
  for (int k = 0; k < 104; ++k) {
    const double factor = 0x1p-32 * std::pow(1.37, k);  // up to 2^15
    const urad_rescale r = host::rescale_of(factor);
    CHECK(r.multiplier >= 32768);
    CHECK(r.shift >= 1);
    CHECK(r.shift <= 48);
    CHECK(std::fabs(host::value_of(r) / factor - 1) <= 0x1p-16);
  }
  CHECK_THROWS_AS(host::rescale_of(0), host::Error);
  CHECK_THROWS_AS(host::rescale_of(0x1p15), host::Error);
  CHECK_THROWS_AS(host::rescale_of(std::nan("")), host::Error);
}

TEST_CASE("16-bit nets compute what the float net does, to the sigmoid's rounding") {
  for (const double size : {0.01, 0.3, 1.0, 30.0})
    for (const int hidden : {1, 8, 64}) {
      INFO("seed ", kSeed, " size ", size, " hidden ", hidden);
      const host::FloatNet net = random_net(hidden, size, kSeed);
      const host::QuantisedNet q(host::round_net(net, 16, 0.01));
      CHECK(urad::network_check(&q.pod()) == urad::Status::ok);
      CHECK(q.pod().far_rho_uq16 == 655);
      // z in Q4.11 and 2.2 units of 2^-15 a sigmoid, weights to 2^-16 of their sum; |y| is clamped
      // at 16
      if (size <= 1) CHECK(rms(q, net, kSeed + 1, random_sample) < (6e-4 * hidden + 1e-4) * size);
    }
}

TEST_CASE("the proof holds: no input drives a proven net's z beyond its range") {
  const host::QuantisedNet small(host::round_net(random_net(4, 0.5, kSeed), 16, 0.01));
  CHECK(small.proven());
  CHECK(small.hidden_range() < 16);
  const host::QuantisedNet large(host::round_net(random_net(4, 20, kSeed), 16, 0.01));
  CHECK_FALSE(large.proven());
}

TEST_CASE("8 bits with compensation lose less than plain rounding") {
  host::Random random(kSeed + 2);
  const host::FloatNet teacher = random_net(4, 1.5, kSeed + 3);
  host::TrainingSet set;
  for (int k = 0; k < 800; ++k) set.samples.push_back(related_sample(random));
  set = host::with_word_of(teacher, set);
  const double plain = rms(host::QuantisedNet(host::round_net(teacher, 8, 0.01)), teacher,
                           kSeed + 4, related_sample);
  const double compensated = rms(host::quantise(teacher, 8, 0.01, {&set, 0, 1e-12, 1}), teacher,
                                 kSeed + 4, related_sample);
  INFO("plain ", plain, " compensated ", compensated);
  CHECK(compensated < 0.7 * plain);
}

TEST_CASE("what the engine cannot run is refused") {
  const host::NetTables good = host::round_net(random_net(2, 1, kSeed), 16, 0.01);
  CHECK_NOTHROW(host::QuantisedNet{good});
  host::NetTables t = good;
  t.hidden_weight.pop_back();
  CHECK_THROWS_AS(host::QuantisedNet{t}, host::Error);
  t = good;
  t.weight_bits = 8;
  CHECK_THROWS_AS(host::QuantisedNet{t}, host::Error);
  t = good;
  for (auto& w : t.hidden_weight) w = 32767;
  CHECK_THROWS_AS(host::QuantisedNet{t}, host::Error);
  t = good;
  t.output_rescale.shift = 0;
  CHECK_THROWS_AS(host::QuantisedNet{t}, host::Error);
  CHECK_THROWS_AS(host::round_net(random_net(2, 1, kSeed), 12, 0.01), host::Error);
  CHECK_THROWS_AS(host::round_net(random_net(2, 1, kSeed), 16, 1.5), host::Error);
}
