// The report's networks in the engine's integers: against the same weights in double, in runs and
// alone, where they saturate, and what is refused.
#include "urad/legacy.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "base/file.hpp"
#include "legacy/backprop.hpp"
#include "legacy/legacy_export.hpp"
#include "legacy/legacy_fixed.hpp"
#include "method/engine_source.hpp"
#include "network/digest.hpp"
#include "network/random.hpp"
#include "scene/builtin.hpp"

namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t kSeed = 1996;

host::LegacyNet random_net(int hidden, host::LegacyScaling scaling, double size) {
  host::BackpropSettings settings;
  settings.hidden = hidden;
  settings.scaling = scaling;
  settings.seed = kSeed;
  host::LegacyNet net = host::backprop_start(settings).net;
  for (float& w : net.hidden_weight) w *= float(size);
  for (float& b : net.hidden_bias) b *= float(4 * size);
  for (float& v : net.output_weight) v *= float(size);
  return net;
}

std::vector<host::LegacyInput> random_inputs(int count) {
  host::Random random(kSeed, 5);
  std::vector<host::LegacyInput> inputs(static_cast<std::size_t>(count));
  for (host::LegacyInput& input : inputs)
    for (float& x : input) x = float(random.uniform());
  inputs.push_back({});  // a corner of the range, and the other
  inputs.emplace_back();
  inputs.back().fill(1.0F);
  return inputs;
}

/// The report's networks of weights/, by path.
std::vector<std::string> shipped() {
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(URAD_SOURCE_DIR "/weights")) {
    const std::string path = entry.path().string();
    if (path.find("/legacy_") != std::string::npos && path.ends_with(".json"))
      paths.push_back(path);
  }
  return paths;
}

host::NetChoice choice(const urad_legacy_net& net) { return {nullptr, nullptr, nullptr, &net}; }

}  // namespace

TEST_CASE("every shipped network: integers within 2e-3 of its floats, header as exported") {
  const host::Scene scene = host::load_scene("cube7");
  std::vector<host::LegacyInput> inputs = random_inputs(2000);
  for (std::size_t k = 0; k < 20000; ++k) {
    const auto &a = scene.patches[k * 7 % 294], &b = scene.patches[k * 31 % 293];
    inputs.push_back(host::legacy_input(a.polygon, b.polygon));
  }
  const auto paths = shipped();
  REQUIRE(paths.size() == 7);
  for (const std::string& path : paths) {
    CAPTURE(path);
    const std::string text = host::read_file(path);
    const host::LegacyNetFile file = host::legacy_from_json(text, path);
    const host::LegacyFixed fixed(file.fixed);
    const host::LegacyRounding worst = host::legacy_rounding(file.net, fixed, inputs);
    CHECK(worst.output <= 2e-3);
    CHECK(worst.factor <= (file.net.scaling == host::LegacyScaling::linear ? 2.6e-3 : 2e-2));
    CHECK(host::round_legacy(file.net).hidden_weight == file.fixed.hidden_weight);
    const std::string header = path.substr(0, path.size() - 4) + "h";
    const std::string name = header.substr(header.rfind('/') + 1);
    CHECK(host::legacy_to_c(file, name.substr(0, name.size() - 2), host::sha256(text)) ==
          host::read_file(header));
    CHECK(host::to_json(file) == text);
  }
}

TEST_CASE("random weights, small ones proven, large ones saturating") {
  const auto inputs = random_inputs(3000);
  for (const int hidden : {1, 5, 30, 50, 64}) {
    for (const double size : {0.3, 1.0, 4.0, 12.0}) {
      for (const auto scaling : {host::LegacyScaling::linear, host::LegacyScaling::log}) {
        const host::LegacyNet net = random_net(hidden, scaling, size);
        CAPTURE(hidden);
        CAPTURE(size);
        const host::LegacyFixed fixed(host::round_legacy(net));
        CHECK(fixed.proven() == (fixed.hidden_range() <= 16 - 65536.0 / 8388608));
        CHECK(fixed.hidden_range() == doctest::Approx(net.hidden_range()).epsilon(1e-3));
        // Weights of 16 bits: the output weights' share grows with their number and size.
        CHECK(host::legacy_rounding(net, fixed, inputs).output <= 4e-4 + 1.5e-5 * hidden * size);
      }
    }
  }
  CHECK_THROWS_AS(host::round_legacy(random_net(65, host::LegacyScaling::linear, 1)), host::Error);
  CHECK_THROWS_AS(host::round_legacy(random_net(5, host::LegacyScaling::linear, 60)), host::Error);
}

TEST_CASE("F from y: all 32,769 values") {
  host::LegacyTables tables = host::round_legacy(random_net(1, host::LegacyScaling::linear, 1));
  const host::LegacyFixed linear(tables);
  tables.scaling = host::LegacyScaling::log;
  const host::LegacyFixed log(tables);
  double worst_linear = 0, worst_log = 0;
  std::uint32_t last = 0;
  for (std::uint32_t y = 0; y <= 32768; ++y) {
    const double exact = std::clamp((y / 32768.0 - 0.1) / 0.8, 0.0, 1.0);
    const std::uint32_t f = urad::legacy_form_factor_uq32(linear.pod(), std::uint16_t(y));
    worst_linear = std::max(worst_linear, std::fabs(f / 4294967296.0 - exact));
    CHECK_FALSE(f < last);
    last = f;
    const double power = std::min(1.0, std::pow(10.0, 1 - 10 * (y / 32768.0)));
    const double g = urad::legacy_form_factor_uq32(log.pod(), std::uint16_t(y)) / 4294967296.0;
    worst_log = std::max(worst_log, std::fabs(g - power) / (power + 1e-3));
  }
  CHECK(worst_linear <= 0x1p-31);
  CHECK(worst_log <= 2e-6);
}

TEST_CASE("a run over a grid, its parts, and single patches give the same bits") {
  const host::Scene scene = host::load_scene("cube7");
  const host::FixedScene fixed(scene);
  const host::LegacyNet net = random_net(30, host::LegacyScaling::linear, 2);
  const host::LegacyFixed integers(host::round_legacy(net));
  const host::NetChoice nets = choice(integers.pod());
  const host::EngineSource source(fixed, host::parse_method("legacy"), nets, {});
  std::vector<std::uint32_t> whole(294), part(294);
  const urad_source fill = source.source();
  host::Random random(kSeed);
  double worst = 0;
  for (int shot = 0; shot < 40; ++shot) {
    const auto shooter = std::uint16_t(random.below(294));
    source.row(shooter, whole.data());
    for (std::uint16_t s = 0; s < 6; ++s) {
      const auto cut = std::uint16_t(1 + random.below(48)), first = std::uint16_t(49 * s);
      REQUIRE(fill.fill(fill.context, shooter, s, std::uint16_t(first + cut),
                        std::uint16_t(49 - cut), &part[first + cut]) == URAD_OK);
      REQUIRE(fill.fill(fill.context, shooter, s, first, cut, &part[first]) == URAD_OK);
    }
    CHECK(whole == part);
    for (std::size_t j = 0; j < 294; ++j) {
      const auto &a = scene.patches[shooter], &b = scene.patches[j];
      const double alone = a.surface == b.surface
                               ? 0
                               : integers.form_factor(host::legacy_input(a.polygon, b.polygon));
      worst = std::max(worst, std::fabs(whole[j] / 4294967296.0 - alone));
    }
  }
  // Coordinates and steps are rounded to the grid's own units: a hidden unit may fall on the other
  // side of a step of 2^-11, which is 2^-13 of its output weight in the sum.
  CHECK(worst <= 5e-4);
  CHECK(source.counters().skipped_same > 0);
  CHECK(source.counters().evaluated == 40 * 245 * 2);
}

TEST_CASE("a triangle is read as a quad with its last corner twice") {
  const host::LegacyFixed net(host::round_legacy(random_net(30, host::LegacyScaling::linear, 2)));
  const host::NetChoice nets = choice(net.pod());
  // The box of both is the unit cube, which the network then reads as it is.
  const host::Polygon low{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
  const host::Polygon high{{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, {}};
  const host::FixedScene scene = host::FixedScene::of_polygons({low, high}, {});
  const host::EngineSource source(scene, host::parse_method("legacy"), nets, {});
  std::uint32_t f[2] = {};
  const host::Polygon* const polygon[] = {&low, &high};
  for (std::uint16_t shooter : {std::uint16_t{0}, std::uint16_t{1}}) {
    source.row(shooter, f);
    const host::LegacyInput input = host::legacy_input(*polygon[shooter], *polygon[1 - shooter]);
    CHECK(f[1 - shooter] > 0);
    CHECK(f[1 - shooter] / 4294967296.0 == doctest::Approx(net.form_factor(input)).epsilon(1e-6));
  }
}

TEST_CASE("scenes of pentagons, and damaged networks, are refused") {
  const host::LegacyFixed good(host::round_legacy(random_net(5, host::LegacyScaling::log, 1)));
  CHECK(urad::legacy_check(&good.pod()) == urad::Status::ok);
  CHECK(urad::legacy_check(nullptr) == urad::Status::bad_argument);
  const auto broken = [&](auto change) {
    urad_legacy_net net = good.pod();
    change(net);
    return urad::legacy_check(&net) == urad::Status::bad_net;
  };
  CHECK(broken([](auto& n) { n.abi = 2; }));
  CHECK(broken([](auto& n) { n.flags |= 8; }));
  CHECK(broken([](auto& n) { n.flags ^= URAD_LEGACY_LOG; }));  // the checksum
  CHECK(broken([](auto& n) { n.hidden = 0; }));
  CHECK(broken([](auto& n) { n.hidden = 65; }));
  CHECK(broken([](auto& n) { n.output_shift = 16; }));
  CHECK(broken([](auto& n) { n.reserved[1] = 1; }));
  CHECK(broken([](auto& n) { n.reserved[0] = 1; }));
  CHECK(broken([](auto& n) { n.hidden_weight = nullptr; }));
  CHECK(broken([](auto& n) { n.hidden_shift = nullptr; }));
  CHECK(broken([](auto& n) { n.hidden_bias = nullptr; }));
  CHECK(broken([](auto& n) { n.output_weight = nullptr; }));
  CHECK(broken([](auto& n) { n.output_bias ^= 1; }));
  CHECK(broken([](auto& n) {
    n.output_bias = INT32_MAX;  // a sum that overflows, checksum right
    n.crc32 = urad::legacy_crc32(n);
  }));
  const host::FixedScene pentagons =
      host::FixedScene::of_polygons({{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}}, {}},
                                     {{{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}, {}}},
                                    {});
  const host::NetChoice nets = choice(good.pod());
  CHECK_THROWS_AS(host::EngineSource(pentagons, host::parse_method("legacy"), nets, {}),
                  host::Error);
  urad::LegacySource source;
  urad_counters counters{};
  std::int32_t memory[21];
  const host::FixedScene cube(host::load_scene("cube7"));
  CHECK(urad::legacy_init(&source, &cube.pod(), &good.pod(), 0, &counters, memory,
                          urad::legacy_bytes(5)) == urad::Status::ok);
  CHECK(urad::legacy_init(&source, &cube.pod(), &good.pod(), 0, &counters, memory,
                          urad::legacy_bytes(5) - 1) == urad::Status::out_of_memory);
  const auto init = [&](urad::LegacySource* to, const urad_scene* scene, urad_counters* counts,
                        void* at) {
    return urad::legacy_init(to, scene, &good.pod(), 0, counts, at, sizeof memory - 4);
  };
  CHECK(init(nullptr, &cube.pod(), &counters, memory) == urad::Status::bad_argument);
  CHECK(init(&source, nullptr, &counters, memory) == urad::Status::bad_argument);
  CHECK(init(&source, &cube.pod(), nullptr, memory) == urad::Status::bad_argument);
  CHECK(init(&source, &cube.pod(), &counters, nullptr) == urad::Status::bad_argument);
  CHECK(init(&source, &cube.pod(), &counters, reinterpret_cast<char*>(memory) + 2) ==
        urad::Status::out_of_memory);
  urad_legacy_net stranger = good.pod();
  stranger.abi = 7;
  CHECK(urad::legacy_init(&source, &cube.pod(), &stranger, 0, &counters, memory, 80) ==
        urad::Status::bad_net);
}

TEST_CASE("weights of any number of fraction bits: what reaches too far is refused") {
  const host::LegacyFixed good(host::round_legacy(random_net(5, host::LegacyScaling::log, 1)));
  std::vector<std::uint8_t> shift(5);
  std::vector<std::int32_t> bias(5, 0);
  const auto checked = [&](std::uint8_t bits, std::int32_t most, unsigned flags) {
    std::fill(shift.begin(), shift.end(), bits);
    bias[4] = most;
    urad_legacy_net net = good.pod();
    net.hidden_shift = shift.data();
    net.hidden_bias = bias.data();
    net.flags = std::uint16_t(flags);
    net.crc32 = urad::legacy_crc32(net);
    return urad::legacy_check(&net);
  };
  using urad::Status;
  // Weights of 16 bits over 2^24: the sum of 24 of them is below 1/16.
  CHECK(checked(24, 0, URAD_LEGACY_LOG | URAD_LEGACY_PROVEN) == Status::ok);
  CHECK(checked(23, 0, URAD_LEGACY_LOG | URAD_LEGACY_PROVEN) == Status::ok);
  CHECK(checked(25, 0, URAD_LEGACY_LOG) == Status::bad_net);
  CHECK(checked(24, 16 << 23, URAD_LEGACY_LOG) == Status::ok);
  CHECK(checked(24, 16 << 23, URAD_LEGACY_LOG | URAD_LEGACY_PROVEN) == Status::bad_net);
  CHECK(checked(24, INT32_MAX, URAD_LEGACY_LOG) == Status::bad_net);
  CHECK(checked(0, 0, URAD_LEGACY_LOG) == Status::bad_net);
}

TEST_CASE("a network of the report is not asked of pairs that do not face each other") {
  const host::LegacyFixed net(host::round_legacy(random_net(5, host::LegacyScaling::linear, 1)));
  const host::Polygon floor{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}};
  const host::Polygon facing{{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, {}};
  const host::Polygon turned{{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, {}};
  const host::Polygon plate{{{-1, -1, 0.5}, {2, -1, 0.5}, {2, 2, 0.5}, {-1, 2, 0.5}}, {}};
  const auto asked = [&](const host::Polygon& other, std::uint16_t shooter, std::uint16_t rays) {
    const host::FixedScene scene = host::FixedScene::of_polygons({floor, other}, {plate});
    urad::LegacySource source;
    urad_counters counters{};
    std::vector<std::int32_t> memory(20);
    REQUIRE(urad::legacy_init(&source, &scene.pod(), &net.pod(), rays, &counters, memory.data(),
                              80) == urad::Status::ok);
    std::uint32_t f = 99;
    const auto to = std::uint16_t(1 - shooter);
    CHECK(urad::legacy_fill(&source, shooter, to, to, 1, &f) == URAD_OK);
    CHECK(counters.evaluated + counters.skipped_facing == 1);
    CHECK((counters.skipped_facing == 0 || f == 0));
    return std::pair{f, counters.evaluated};
  };
  for (const std::uint16_t shooter : {std::uint16_t{0}, std::uint16_t{1}}) {
    CHECK(asked(turned, shooter, 0).second == 0);
    CHECK(asked(facing, shooter, 0).first > 0);  // without rays nothing is in the way
    CHECK(asked(facing, shooter, 64).first == 0);
    CHECK(asked(facing, shooter, 64).second == 1);
  }
}

TEST_CASE("a repair scales what a network of the report says, up to 1") {
  const host::Scene scene = host::load_scene("cube7");
  host::FixedScene fixed(scene);
  const host::LegacyFixed net(host::round_legacy(random_net(30, host::LegacyScaling::linear, 2)));
  const host::NetChoice nets = choice(net.pod());
  const auto row = [&] {
    const host::EngineSource source(fixed, host::parse_method("legacy"), nets, {});
    std::vector<std::uint32_t> f(294);
    source.row(3, f.data());
    return f;
  };
  const std::vector<std::uint32_t> plain = row();
  std::vector<double> scale(294, 1.0);
  scale[3] = 0.5, scale[100] = 4, scale[200] = 0.25, scale[250] = 1e6;
  fixed.set_scale(scale);
  const std::vector<std::uint32_t> scaled = row();
  for (std::size_t j = 0; j < 294; ++j) {
    CAPTURE(j);
    const double exact = std::min(plain[j] * 0.5 * scale[j], 0x1p32 - 1);
    CHECK(scaled[j] == doctest::Approx(exact).epsilon(2e-5));
  }
  CHECK(plain[250] > 1 << 20);
  CHECK(scaled[250] == 0xFFFFFFFFu);
}

TEST_CASE("one checksum over a range of outputs: equal on every target") {
  const host::LegacyFixed net(host::round_legacy(random_net(15, host::LegacyScaling::log, 6)));
  std::uint32_t sum = 0;
  for (const host::LegacyInput& input : random_inputs(500))
    sum = sum * 31 +
          urad::legacy_form_factor_uq32(net.pod(), host::legacy_output_uq15(net.pod(), input));
  CHECK(sum == 2701560406u);
}
