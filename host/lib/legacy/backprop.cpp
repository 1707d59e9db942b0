#include "legacy/backprop.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "base/error.hpp"
#include "network/random.hpp"

namespace host {

namespace {

constexpr int kLanes = 8;
using Lanes = float __attribute__((vector_size(4 * kLanes)));
using Bits = std::int32_t __attribute__((vector_size(4 * kLanes)));
#define URAD_INLINE inline __attribute__((always_inline))

/// 1 / (1 + e^-z), relative error below 1e-6: 2^x from its exponent bits and Taylor's polynomial.
/// In place, so that no vector travels through a call.
URAD_INLINE void squash(Lanes* z) {
  constexpr float kRound = 12582912.0F;  // 1.5 * 2^23: adding it leaves the nearest whole number
  Lanes x = *z * -1.44269504F;
  x = x > 40.0F ? Lanes{} + 40.0F : x;
  x = x < -40.0F ? Lanes{} - 40.0F : x;
  const Lanes whole = (x + kRound) - kRound, t = (x - whole) * 0.693147181F;
  Lanes power = t * (1.0F / 720) + 1.0F / 120;
  power = power * t + 1.0F / 24;
  power = power * t + 1.0F / 6;
  power = power * t + 0.5F;
  power = power * t + 1.0F;
  power = power * t + 1.0F;
  const Bits exponent = (__builtin_convertvector(whole, Bits) + 127) << 23;
  Lanes scale;
  std::memcpy(&scale, &exponent, sizeof scale);
  *z = 1.0F / (1.0F + power * scale);
}

/// The network with a vector for eight hidden units; units that fill the last vector have no output
/// weight and do not learn one.
struct WideNet {
  /// Aligned for what the vectors are: as the argument of a template, Lanes would forget it.
  struct alignas(4 * kLanes) Block {
    Lanes lanes{};
  };
  int blocks = 0;
  std::vector<Block> weight;        // [24][blocks]
  std::vector<Block> bias, output;  // [blocks]
  float output_bias = 0;
};

WideNet widened(const LegacyNet& net) {
  WideNet wide;
  wide.blocks = (net.hidden + kLanes - 1) / kLanes;
  const auto blocks = std::size_t(wide.blocks);
  wide.weight.assign(blocks * kLegacyInputs, {});
  wide.bias.assign(blocks, {});
  wide.output.assign(blocks, {});
  wide.output_bias = net.output_bias;
  for (std::size_t h = 0; h < std::size_t(net.hidden); ++h) {
    const std::size_t block = h / kLanes, lane = h % kLanes;
    for (std::size_t n = 0; n < kLegacyInputs; ++n)
      wide.weight[n * blocks + block].lanes[lane] = net.hidden_weight[h * kLegacyInputs + n];
    wide.bias[block].lanes[lane] = net.hidden_bias[h];
    wide.output[block].lanes[lane] = net.output_weight[h];
  }
  return wide;
}

void narrow(const WideNet& wide, LegacyNet* net) {
  const auto blocks = std::size_t(wide.blocks);
  for (std::size_t h = 0; h < std::size_t(net->hidden); ++h) {
    const std::size_t block = h / kLanes, lane = h % kLanes;
    for (std::size_t n = 0; n < kLegacyInputs; ++n)
      net->hidden_weight[h * kLegacyInputs + n] = wide.weight[n * blocks + block].lanes[lane];
    net->hidden_bias[h] = wide.bias[block].lanes[lane];
    net->output_weight[h] = wide.output[block].lanes[lane];
  }
  net->output_bias = wide.output_bias;
}

/// y, and the hidden units' outputs. kBlocks 0: as many as the net has.
template <int kBlocks>
URAD_INLINE float forward(const WideNet& net, const float* input, Lanes* hidden) {
  const int blocks = kBlocks ? kBlocks : net.blocks;
  for (int b = 0; b < blocks; ++b) hidden[b] = net.bias[std::size_t(b)].lanes;
  const WideNet::Block* weight = net.weight.data();
  for (int n = 0; n < kLegacyInputs; ++n)
    for (int b = 0; b < blocks; ++b) hidden[b] += weight++->lanes * input[n];
  Lanes sum{};
  for (int b = 0; b < blocks; ++b) {
    squash(&hidden[b]);
    sum += hidden[b] * net.output[std::size_t(b)].lanes;
  }
  Lanes total{};
  total[0] = net.output_bias;
  for (int lane = 0; lane < kLanes; ++lane) total[0] += sum[lane];
  squash(&total);
  return total[0];
}

struct Rates {
  float hidden, output;
};
constexpr int kMostBlocks = 32;

template <int kBlocks>
URAD_INLINE void learn(WideNet* net, const LegacySample& sample, const Rates& rates,
                       const Lanes& learns_last) {
  const int blocks = kBlocks ? kBlocks : net->blocks;
  Lanes hidden[kBlocks ? kBlocks : kMostBlocks], delta[kBlocks ? kBlocks : kMostBlocks];
  const float* input = sample.input.data();
  const float y = forward<kBlocks>(*net, input, hidden);
  const float out = (sample.target - y) * y * (1 - y);
  for (int b = 0; b < blocks; ++b) {
    Lanes& output = net->output[std::size_t(b)].lanes;
    delta[b] = output * (rates.hidden * out) * hidden[b] * (1.0F - hidden[b]);
    Lanes step = hidden[b] * (rates.output * out);
    if (b == blocks - 1) step *= learns_last;
    output += step;
    net->bias[std::size_t(b)].lanes += delta[b];
  }
  net->output_bias += rates.output * out;
  WideNet::Block* weight = net->weight.data();
  for (int n = 0; n < kLegacyInputs; ++n)
    for (int b = 0; b < blocks; ++b) weight++->lanes += delta[b] * input[n];
}

template <int kBlocks>
URAD_INLINE void epoch(WideNet* net, const LegacySample* samples, const std::uint32_t* order,
                       std::size_t count, const Rates& rates, const Lanes& learns_last) {
  for (std::size_t k = 0; k < count; ++k) {
    if (k + 4 < count) __builtin_prefetch(&samples[order[k + 4]]);
    learn<kBlocks>(net, samples[order[k]], rates, learns_last);
  }
}

// The sizes of the report have their registers planned at compile time.
URAD_INLINE void epoch_of_size(WideNet* net, const LegacySample* samples,
                               const std::uint32_t* order, std::size_t count, const Rates& rates,
                               const Lanes& learns_last) {
  switch (net->blocks) {
    case 1:
      return epoch<1>(net, samples, order, count, rates, learns_last);
    case 2:
      return epoch<2>(net, samples, order, count, rates, learns_last);
    case 4:
      return epoch<4>(net, samples, order, count, rates, learns_last);
    case 7:
      return epoch<7>(net, samples, order, count, rates, learns_last);
    default:
      return epoch<0>(net, samples, order, count, rates, learns_last);
  }
}

URAD_INLINE double sum_of_squares(const WideNet& net, const LegacySample* samples,
                                  std::size_t count) {
  Lanes hidden[kMostBlocks];
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double error =
        double(forward<0>(net, samples[k].input.data(), hidden)) - double(samples[k].target);
    sum += error * error;
  }
  return sum;
}

// Each loop twice: for any processor, and for one with wide vectors. Products and sums are not
// fused in either, so that both give the same bits.
using Epoch = void (*)(WideNet*, const LegacySample*, const std::uint32_t*, std::size_t,
                       const Rates&, const Lanes&);
using Squares = double (*)(const WideNet&, const LegacySample*, std::size_t);
struct Loops {
  Epoch epoch;
  Squares squares;
};

void epoch_portable(WideNet* net, const LegacySample* samples, const std::uint32_t* order,
                    std::size_t count, const Rates& rates, const Lanes& learns_last) {
  epoch_of_size(net, samples, order, count, rates, learns_last);
}
double squares_portable(const WideNet& net, const LegacySample* samples, std::size_t count) {
  return sum_of_squares(net, samples, count);
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) void epoch_avx2(WideNet* net, const LegacySample* samples,
                                                const std::uint32_t* order, std::size_t count,
                                                const Rates& rates, const Lanes& learns_last) {
  epoch_of_size(net, samples, order, count, rates, learns_last);
}
__attribute__((target("avx2"))) double squares_avx2(const WideNet& net, const LegacySample* samples,
                                                    std::size_t count) {
  return sum_of_squares(net, samples, count);
}
#endif

Loops loops() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return {epoch_avx2, squares_avx2};
#endif
  return {epoch_portable, squares_portable};
}

void check_size(int hidden) {
  if (hidden < 1 || hidden > kMostBlocks * kLanes)
    throw Error("hidden units: 1 to " + std::to_string(kMostBlocks * kLanes));
}

}  // namespace

LegacySplit legacy_split(std::vector<LegacySample> samples, std::uint64_t seed) {
  Random(seed, 1).shuffle(samples);
  const auto tenth = std::ptrdiff_t(samples.size() / 10);
  LegacySplit split;
  split.validation.assign(samples.end() - tenth, samples.end());
  split.test.assign(samples.end() - 2 * tenth, samples.end() - tenth);
  samples.resize(samples.size() - std::size_t(2 * tenth));
  split.training = std::move(samples);
  return split;
}

BackpropState backprop_start(const BackpropSettings& settings) {
  check_size(settings.hidden);
  Random random(settings.seed, 2);
  BackpropState state;
  LegacyNet& net = state.net;
  net.hidden = settings.hidden;
  net.scaling = settings.scaling;
  const auto draw = [&](std::size_t count) {
    std::vector<float> values(count);
    for (float& value : values) value = float(random.uniform(-0.5, 0.5));
    return values;
  };
  const auto hidden = std::size_t(settings.hidden);
  net.hidden_weight = draw(hidden * kLegacyInputs);
  net.hidden_bias = draw(hidden);
  net.output_weight = draw(hidden);
  net.output_bias = draw(1)[0];
  state.best = net;
  return state;
}

void backprop(const LegacySplit& data, const BackpropSettings& settings, BackpropState* state,
              const std::function<bool(const BackpropState&)>& after_epoch) {
  if (data.training.empty() || data.validation.empty())
    throw Error("backpropagation needs samples to train on and samples to judge by");
  check_size(state->net.hidden);
  const Loops run = loops();
  const Rates rates{settings.hidden_rate, settings.output_rate};
  WideNet net = widened(state->net);
  Lanes learns_last{};
  for (int lane = 0; lane < kLanes; ++lane)
    learns_last[lane] = (net.blocks - 1) * kLanes + lane < state->net.hidden ? 1.0F : 0.0F;
  std::vector<std::uint32_t> order(data.training.size());
  while (state->epoch < settings.epochs) {
    std::iota(order.begin(), order.end(), 0U);
    Random(settings.seed, 3 + std::uint64_t(state->epoch)).shuffle(order);
    run.epoch(&net, data.training.data(), order.data(), order.size(), rates, learns_last);
    ++state->epoch;
    const double error = run.squares(net, data.validation.data(), data.validation.size()) /
                         double(data.validation.size());
    narrow(net, &state->net);
    if (state->best_epoch == 0 || error < state->best_error) {
      state->best = state->net;
      state->best_error = error;
      state->best_epoch = state->epoch;
    }
    if (after_epoch && !after_epoch(*state)) return;
  }
}

double legacy_error(const LegacyNet& net, const std::vector<LegacySample>& samples) {
  if (samples.empty()) return 0;
  check_size(net.hidden);
  return loops().squares(widened(net), samples.data(), samples.size()) / double(samples.size());
}

}  // namespace host
