#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <sstream>

#include "base/error.hpp"
#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "stress/attacks.hpp"
#include "stress/net_tables.hpp"
#include "urad/network.hpp"
#include "urad/urad.h"

namespace host {
namespace {

constexpr int kInputs = 14;  // of a pair
constexpr int kMostShots = 400;

struct RandomNetCase {
  NetTemper temper;
  int inputs, hidden, bits;
  std::uint64_t seed;
};

std::string text_of(const RandomNetCase& c) {
  return fmt::format("temper {} inputs {} hidden {} bits {} seed {}", int(c.temper), c.inputs,
                     c.hidden, c.bits, c.seed);
}

RandomNetCase case_of(const std::string& text) {
  int temper = 0, inputs = 0, hidden = 0, bits = 0;
  unsigned long long seed = 0;
  const std::array<std::string, 5> names{"temper", "inputs", "hidden", "bits", "seed"};
  std::array<std::string, 5> name;
  std::istringstream words(text);
  words >> name[0] >> temper >> name[1] >> inputs >> name[2] >> hidden >> name[3] >> bits;
  words >> name[4] >> seed;
  if (!words || name != names || inputs < 1 || inputs > URAD_NET_MAX_INPUTS || hidden < 1 ||
      hidden > URAD_NET_MAX_HIDDEN || (bits != 8 && bits != 16))
    throw Error("a case of a random net is 'temper T inputs N hidden H bits 8 or 16 seed S'");
  return {NetTemper(temper), inputs, hidden, bits, seed};
}

/// A room to solve in: 24 patches.
const FixedScene& small_room() {
  static const FixedScene room(load_scene("cube7", {2, 0}));
  return room;
}

void compare_with_wide(const urad_net& net, Random& random, Findings* findings) {
  std::array<std::int16_t, URAD_NET_MAX_INPUTS> input{};
  bool same = true, in_range = true;
  for (int k = 0; k < 8; ++k) {
    for (std::int16_t& x : input)
      x = k < 2 ? std::int16_t(k ? -32768 : 32767)
                : std::int16_t(k < 4 ? (random.below(2) ? -32768 : 32767)
                                     : random.below(65536) - 32768);
    const std::int32_t y = urad::network_run(net, input.data());
    same = same && y == wide_network(net, input.data());
    const std::int32_t word_q24 = urad::word_q24(y, std::uint16_t(random.below(65536)));
    in_range = in_range && std::abs(word_q24) <= urad::kMostWord << 24;
  }
  findings->expect("the same as in 64 bits", same);
  findings->expect("|log2 correction| <= 61", in_range);
}

/// A whole solve: every factor and every status must be one that the engine promises.
void solve_with(const urad_net& net, unsigned flags, Findings* findings) {
  const urad_scene& scene = small_room().pod();
  std::vector<std::uint64_t> pairs(urad_pair_source_bytes() / 8 + 1);
  std::vector<std::uint32_t> memory(
      URAD_RADIOSITY_BYTES(scene.patch_count, urad_longest_run(&scene)) / 4);
  urad_counters counters{};
  urad_source source;
  urad_radiosity state;
  const urad_status made = urad_pair_source_init(&source, &scene, URAD_KERNEL_MOMENT, &net, 0,
                                                 &counters, pairs.data(), pairs.size() * 8);
  if (net.inputs != kInputs) {
    findings->expect("a net of other inputs is refused", made == URAD_BAD_NET);
    return;
  }
  if (made != URAD_OK ||
      urad_radiosity_init(&state, &scene, &source, flags, urad_longest_run(&scene), memory.data(),
                          memory.size() * 4) != URAD_OK) {
    findings->expect("a solve can be started", false);
    return;
  }
  bool ledger = true;
  urad_status status = URAD_OK;
  int shots = 0;
  for (; shots < kMostShots && !urad_radiosity_done(&state, URAD_PERCENT); ++shots) {
    status = urad_radiosity_step(&state);
    ledger = ledger && urad_radiosity_audit(&state, nullptr);
    if (status != URAD_OK) break;
  }
  findings->expect("ledger exact at every shot", ledger);
  findings->expect("converged, capped or guarded",
                   status == URAD_OK || status == URAD_DIVERGES || status == URAD_OVERFLOW);
  findings->measure("solves stopped at the power limit", status == URAD_OVERFLOW);
  findings->measure("solves stopped by the guard", status == URAD_DIVERGES);
}

void run_random_net(const std::string& text, Findings* findings) {
  const RandomNetCase c = case_of(text);
  Random random(c.seed);
  OpenNet net(c.inputs, c.hidden, c.bits);
  randomise(&net, c.temper, random);
  const bool accepted = urad_net_check(&net.pod()) == URAD_OK;
  findings->measure("nets that pass the check", accepted);
  if (!accepted) return;
  compare_with_wide(net.pod(), random, findings);
  solve_with(net.pod(), random.below(2) ? URAD_OVERSHOOT : 0, findings);
}

Attack random_net(std::string family, NetTemper temper) {
  const auto draw = [temper](Random& random) {
    // Mostly the shape of a pair's net, small enough that random weights can be proven.
    const bool other = random.below(4) == 0;
    const int inputs = other ? 1 + random.below(URAD_NET_MAX_INPUTS) : kInputs;
    const int hidden = other ? 1 + random.below(URAD_NET_MAX_HIDDEN) : 1 + random.below(8);
    return text_of({temper, inputs, hidden, random.below(2) ? 8 : 16,
                    std::uint64_t(random.uniform() * 0x1p53)});
  };
  return {"networks", std::move(family), draw, run_random_net};
}

/// Turns every bit of the net in turn.
void run_bit_faults(const urad_net& shipped, Findings* findings) {
  OpenNet net(shipped);
  findings->expect("the shipped net passes", urad_net_check(&net.pod()) == URAD_OK);
  const std::size_t bits = net.bits();
  std::size_t missed = 0;
  for (std::size_t bit = 0; bit < bits; ++bit) {
    // Tables as long as the fields say: the check may read them all.
    OpenNet faulty(shipped);
    faulty.flip(bit);
    const std::size_t weights = std::size_t(faulty.fields.inputs) * faulty.fields.hidden * 2;
    faulty.hidden_weight.resize(std::max(faulty.hidden_weight.size(), weights));
    faulty.hidden_bias.resize(std::max<std::size_t>(faulty.hidden_bias.size(), 256));
    faulty.hidden_rescale.resize(std::max<std::size_t>(faulty.hidden_rescale.size(), 256));
    faulty.output_weight.resize(std::max<std::size_t>(faulty.output_weight.size(), 256));
    faulty.skip_weight.resize(std::max<std::size_t>(faulty.skip_weight.size(), 256));
    missed += urad_net_check(&faulty.pod()) == URAD_OK;
  }
  findings->measure("single-bit faults that pass the check", double(missed), 0);
  findings->measure("bits turned", double(bits));
}

}  // namespace

std::vector<Attack> network_attacks(const NetChoice& nets) {
  std::vector<Attack> attacks{random_net("random weights", NetTemper::any),
                              random_net("extreme weights", NetTemper::extreme),
                              random_net("zero weights", NetTemper::zero)};
  attacks.push_back({"networks", "bit faults",
                     [](Random& random) {
                       constexpr const char* names[] = {"cornell", "cube7", "general"};
                       return std::string(names[random.below(3)]);
                     },
                     [nets](const std::string& name, Findings* findings) {
                       run_bit_faults(nets.find(name), findings);
                     }});
  return attacks;
}

}  // namespace host
