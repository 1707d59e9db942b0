// Inference and its check: any weights stay in range, every damaged net is found.
#include "urad/network.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include "weights/cornell.h"
#include "weights/cube7.h"
#include "weights/general.h"

namespace {

constexpr unsigned kSeed = 24;

/// A copy of a net whose tables can be changed.
struct OwnNet {
  explicit OwnNet(const urad_net& from) : net(from) {
    const auto inputs = std::size_t(from.inputs), hidden = std::size_t(from.hidden);
    const auto* weight = static_cast<const std::uint8_t*>(from.hidden_weight);
    hidden_weight.assign(weight, weight + inputs * hidden * (from.weight_bits / 8u));
    hidden_bias.assign(from.hidden_bias, from.hidden_bias + hidden);
    hidden_rescale.assign(from.hidden_rescale, from.hidden_rescale + hidden);
    output_weight.assign(from.output_weight, from.output_weight + hidden);
    skip_weight.assign(from.skip_weight, from.skip_weight + inputs);
    net.hidden_weight = hidden_weight.data();
    net.hidden_bias = hidden_bias.data();
    net.hidden_rescale = hidden_rescale.data();
    net.output_weight = output_weight.data();
    net.skip_weight = skip_weight.data();
  }
  OwnNet(const OwnNet&) = delete;

  urad_net net;
  std::vector<std::uint8_t> hidden_weight;
  std::vector<std::int32_t> hidden_bias;
  std::vector<urad_rescale> hidden_rescale;
  std::vector<std::int16_t> output_weight, skip_weight;
};

bool good(const urad_net& net) { return urad::network_check(&net) == urad::Status::ok; }

/// Flips every bit of `bytes` in turn; counts the flips that the check lets through.
int undetected(const urad_net& net, void* bytes, std::size_t size) {
  auto* at = static_cast<std::uint8_t*>(bytes);
  int passed = 0;
  for (std::size_t bit = 0; bit < size * 8; ++bit) {
    at[bit / 8] = std::uint8_t(at[bit / 8] ^ (1u << bit % 8));
    passed += good(net);
    at[bit / 8] = std::uint8_t(at[bit / 8] ^ (1u << bit % 8));
  }
  return passed;
}

template <class Value>
int undetected(const urad_net& net, std::vector<Value>& table) {
  return undetected(net, table.data(), table.size() * sizeof(Value));
}

}  // namespace

TEST_CASE("shipped nets pass, and every single bit flipped in one is found") {
  for (const urad_net* shipped : {&urad_general, &urad_cube7, &urad_cornell}) {
    CHECK(good(*shipped));
    OwnNet own(*shipped);
    CHECK(good(own.net));
    CHECK(undetected(own.net, own.hidden_weight) == 0);
    CHECK(undetected(own.net, own.hidden_bias) == 0);
    CHECK(undetected(own.net, own.hidden_rescale) == 0);
    CHECK(undetected(own.net, own.output_weight) == 0);
    CHECK(undetected(own.net, own.skip_weight) == 0);
    CHECK(undetected(own.net, &own.net.crc32, sizeof own.net.crc32) == 0);
    CHECK(undetected(own.net, &own.net.output_bias, sizeof own.net.output_bias) == 0);
    CHECK(undetected(own.net, &own.net.output_rescale, sizeof own.net.output_rescale) == 0);
    CHECK(undetected(own.net, &own.net.far_rho_uq16, sizeof own.net.far_rho_uq16) == 0);
    CHECK(undetected(own.net, &own.net.abi, sizeof own.net.abi) == 0);
    CHECK(undetected(own.net, &own.net.flags, sizeof own.net.flags) == 0);
  }
}

TEST_CASE("sizes, null pointers and shifts out of range are bad nets") {
  const auto bad = [](auto&& change) {
    OwnNet own(urad_general);
    change(own);
    own.net.crc32 = 0;
    return urad::network_check(&own.net) == urad::Status::bad_net;
  };
  CHECK(urad::network_check(nullptr) == urad::Status::bad_net);
  CHECK(bad([](OwnNet& n) { n.net.abi = 2; }));
  CHECK(bad([](OwnNet& n) { n.net.reserved = 1; }));
  CHECK(bad([](OwnNet& n) { n.net.inputs = 0; }));
  CHECK(bad([](OwnNet& n) { n.net.inputs = URAD_NET_MAX_INPUTS + 1; }));
  CHECK(bad([](OwnNet& n) { n.net.hidden = 0; }));
  CHECK(bad([](OwnNet& n) { n.net.hidden = URAD_NET_MAX_HIDDEN + 1; }));
  CHECK(bad([](OwnNet& n) { n.net.weight_bits = 12; }));
  CHECK(bad([](OwnNet& n) { n.net.hidden_weight = nullptr; }));
  CHECK(bad([](OwnNet& n) { n.net.hidden_bias = nullptr; }));
  CHECK(bad([](OwnNet& n) { n.net.hidden_rescale = nullptr; }));
  CHECK(bad([](OwnNet& n) { n.net.output_weight = nullptr; }));
  CHECK(bad([](OwnNet& n) { n.net.skip_weight = nullptr; }));
  CHECK(bad([](OwnNet& n) { n.hidden_rescale[0].shift = 0; }));
  CHECK(bad([](OwnNet& n) { n.hidden_rescale[0].shift = 48; }));
  CHECK(bad([](OwnNet& n) { n.net.output_rescale.shift = 16; }));
}

TEST_CASE(
    "with a checksum that is right: the least net is good, and one step past each limit is not") {
  const auto check = [](auto&& change) {
    OwnNet own(urad_general);
    change(own);
    own.net.crc32 = urad::network_crc32(own.net);
    return urad::network_check(&own.net) == urad::Status::ok;
  };
  CHECK(check([](OwnNet&) {}));
  CHECK(check([](OwnNet& n) { n.net.inputs = 1; }));
  CHECK(check([](OwnNet& n) { n.net.hidden = 1; }));
  CHECK(check([](OwnNet& n) { n.net.inputs = n.net.hidden = 1; }));
  CHECK_FALSE(check([](OwnNet& n) { n.net.inputs = 0; }));
  CHECK_FALSE(check([](OwnNet& n) { n.net.hidden = 0; }));
  CHECK_FALSE(check([](OwnNet& n) { ++n.net.abi; }));
  CHECK_FALSE(check([](OwnNet& n) { --n.net.abi; }));
  CHECK_FALSE(check([](OwnNet& n) { n.net.reserved = 1; }));
  CHECK_FALSE(check([](OwnNet& n) { n.net.flags = 0x8000; }));
  CHECK_FALSE(check([](OwnNet& n) { n.hidden_rescale[0].shift = 0; }));
  CHECK_FALSE(check([](OwnNet& n) { n.hidden_rescale[0].shift = 48; }));
}

TEST_CASE("an accumulator that could overflow is refused, whatever the checksum says") {
  OwnNet own(urad_general);
  own.hidden_bias[0] = INT32_MIN;
  own.net.crc32 = urad::network_crc32(own.net);
  CHECK_FALSE(good(own.net));
}

TEST_CASE("random nets that pass the check stay in range on extreme inputs") {
  MESSAGE("seed ", kSeed);
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> byte(0, 255), shift(17, 47), big(-2000, 2000),
      multiplier(0, 65535);
  int passed = 0;
  for (int n = 0; n < 2000; ++n) {
    OwnNet own(urad_general);
    own.net.weight_bits = n % 2 ? 8 : 16;
    own.net.flags = 0;
    for (std::uint8_t& w : own.hidden_weight) w = std::uint8_t(byte(random));
    if (own.net.weight_bits == 16) {  // small enough for the accumulator
      for (std::size_t k = 0; k < own.hidden_weight.size(); k += 2) {
        const auto w = std::int16_t(big(random));
        std::memcpy(&own.hidden_weight[k], &w, 2);
      }
    }
    for (std::int32_t& b : own.hidden_bias) b = big(random) * 100000;
    for (urad_rescale& r : own.hidden_rescale)
      r = {std::uint16_t(multiplier(random)), std::uint16_t(shift(random))};
    for (std::int16_t& w : own.output_weight) w = std::int16_t(big(random));
    for (std::int16_t& w : own.skip_weight) w = std::int16_t(big(random));
    own.net.output_rescale = {std::uint16_t(multiplier(random)), std::uint16_t(shift(random))};
    own.net.crc32 = urad::network_crc32(own.net);
    if (!good(own.net)) continue;
    ++passed;
    for (const int value : {-32767, 0, 32767}) {
      std::vector<std::int16_t> input(own.net.inputs, std::int16_t(value));
      const std::int32_t y_q16 = urad::network_run(own.net, input.data());
      for (const int gate_uq16 : {0, 1, 3473, 65535})
        CHECK(std::abs(urad::word_q24(y_q16, std::uint16_t(gate_uq16))) <= urad::kMostWord << 24);
    }
  }
  CHECK(passed > 1000);
}

TEST_CASE("a word that the gate leaves little of is not cut before the gate") {
  std::mt19937 random(kSeed + 2);
  MESSAGE("seed ", kSeed + 2);
  std::uniform_int_distribution<std::int32_t> word(-(1 << 30), 1 << 30), gate(0, 65535),
      fewer(0, 14);
  for (int k = 0; k < 100000; ++k) {
    const std::int32_t y_q16 = word(random) >> fewer(random);
    const auto gate_uq16 = std::uint16_t(gate(random) >> fewer(random));
    const double exact = y_q16 * 0x1p-16 * gate_uq16 * 0x1p-16;
    const double got = urad::word_q24(y_q16, gate_uq16) * 0x1p-24;
    if (std::fabs(exact) < urad::kMostWord - 1)
      REQUIRE(std::fabs(got - exact) <= 0x1p-25);
    else
      REQUIRE(std::fabs(got - std::clamp<double>(exact, -urad::kMostWord, urad::kMostWord)) <= 1);
    REQUIRE(got == -urad::word_q24(-y_q16, gate_uq16) * 0x1p-24);
  }
}
