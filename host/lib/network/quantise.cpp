#include "network/quantise.hpp"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/error.hpp"
#include "network/engine_range.hpp"
#include "network/random.hpp"
#include "network/trainer.hpp"

namespace host {

namespace {

constexpr double kFullScale = 32768;
// What is left of the error depends on the order of the neurons by as much as a half.
constexpr int kOrders = 12;
constexpr int kSteps = 1,
              kLastSteps = 4;  // of training after each neuron, and after the best order
// Scale of one accumulator: real weight per integer. rescale is exact, so the weights can be
// rounded against it.
struct Scale {
  urad_rescale rescale;
  double unit;
};

// factor = unit * units_per_weight is what the accumulator is multiplied by.
Scale scale_for(double least_unit, double units_per_weight) {
  const double factor = std::clamp(least_unit * units_per_weight, 0x1p-31, kFactorMax);
  const urad_rescale rescale = rescale_of(factor * (1 + 0x1p-15));  // never finer than least_unit
  return {rescale, value_of(rescale) / units_per_weight};
}

// A threshold on rho that is 0 or more and below 1.
std::uint16_t threshold_uq16(double rho, const char* which) {
  if (!(rho >= 0 && rho < 1))
    throw Error(fmt::format("the {} threshold is 0 or more and below 1, not {}", which, rho));
  return static_cast<std::uint16_t>(std::min(65535.0, std::round(rho * 65536)));
}

double weight_max(int bits) { return bits == 8 ? 127 : 32767; }

Scale hidden_scale(const FloatNet& net, int h, int bits) {
  const WeightReach reach = hidden_reach(net, h);
  return scale_for(std::max(reach.largest / weight_max(bits), reach.sum / kWeightSumMax),
                   kHiddenUnits);
}

std::int16_t round16(double x) { return static_cast<std::int16_t>(std::lround(x)); }

std::int32_t round_bias(double bias, double unit) {
  const double b = std::round(bias / unit * kFullScale);
  if (!(std::fabs(b) < 0x1p31))
    throw Error(fmt::format("a bias of {} does not fit beside weights in units of {}", bias, unit));
  return static_cast<std::int32_t>(b);
}

// Everything but the hidden weights, which are already integers in `tables`.
void round_rest(const FloatNet& net, const std::vector<Scale>& scales, NetTables* tables) {
  if (!engine_can_hold(net))
    throw Error("weights of many thousands do not fit the engine's 16 bits");
  const WeightReach reach = output_reach(net);
  const Scale output =
      scale_for(std::max(reach.largest / weight_max(16), reach.sum / kOutputSumMax), kOutputUnits);
  tables->output_rescale = output.rescale;
  tables->output_bias = round_bias(net.output_bias(), output.unit);
  tables->hidden_bias.clear(), tables->hidden_rescale.clear();
  tables->output_weight.clear(), tables->skip_weight.clear();
  for (int h = 0; h < net.hidden(); ++h) {
    const Scale& scale = scales[std::size_t(h)];
    tables->hidden_bias.push_back(round_bias(net.hidden_bias(h), scale.unit));
    tables->hidden_rescale.push_back(scale.rescale);
    tables->output_weight.push_back(round16(net.output_weight(h) / output.unit));
  }
  for (int n = 0; n < net.inputs(); ++n)
    tables->skip_weight.push_back(round16(net.skip_weight(n) / output.unit));
}

NetTables empty_tables(const FloatNet& net, int bits, double far_rho) {
  if (bits != 8 && bits != 16) throw Error(fmt::format("weights have 8 or 16 bits, not {}", bits));
  NetTables tables;
  tables.inputs = net.inputs();
  tables.hidden = net.hidden();
  tables.weight_bits = bits;
  tables.far_rho_uq16 = threshold_uq16(far_rho, "far");
  tables.hidden_weight.assign(std::size_t(net.inputs() * net.hidden()), 0);
  return tables;
}

// Rounds the hidden weights of neuron h in turn; the parameters that are still free take up each
// rounding error along the inverse Hessian of what is left. All in normalised parameters.
void round_neuron(const FloatNet& scaled, int h, const Scale& scale,
                  const Eigen::VectorXd& deviation, Eigen::MatrixXd inverse,
                  const std::vector<int>& free, FloatNet* net, NetTables* tables) {
  Eigen::VectorXd value(Eigen::Index(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) value[Eigen::Index(k)] = scaled.parameters[free[k]];
  for (std::size_t k = 0; k < free.size(); ++k) {
    const int n = free[k] - h * net->inputs();
    if (n < 0 || n >= net->inputs()) continue;
    const auto at = Eigen::Index(k);
    const double unit = scale.unit * deviation[n];
    const double q = std::clamp(std::round(value[at] / unit), -127.0, 127.0);
    tables->hidden_weight[std::size_t(free[k])] = round16(q);
    const Eigen::VectorXd column = inverse.col(at) / inverse(at, at);
    value -= column * (value[at] - q * unit);
    value[at] = q * unit;
    inverse -= column * inverse.row(at).eval();
    inverse.row(at).setZero(), inverse.col(at).setZero();
    inverse(at, at) = 1;
  }
  for (std::size_t k = 0; k < free.size(); ++k) net->parameters[free[k]] = value[Eigen::Index(k)];
}

/// A net with whole hidden weights; the rest made up for them.
struct Rounded {
  FloatNet net;
  NetTables tables;
  std::vector<Scale> scales;
  std::vector<char> is_free;  ///< of the parameters: not rounded yet
  double loss = 0;
};

Rounded round_in_order(const FloatNet& original, const std::vector<int>& neurons,
                       const NetTables& empty, const Normalisation& scaling,
                       const Objective& objective, const Compensation& c) {
  Rounded result{original, empty, std::vector<Scale>(neurons.size()),
                 std::vector<char>(std::size_t(original.parameters.size()), 1)};
  auto& [net, tables, scales, is_free, loss] = result;
  for (const int h : neurons) {
    Scale& scale = scales[std::size_t(h)];
    scale = hidden_scale(net, h, 8);
    FloatNet scaled = unfold_normalisation(net, scaling.mean, scaling.deviation);
    Eigen::MatrixXd hessian;
    Eigen::VectorXd gradient;
    objective.model(scaled, c.robust, &hessian, &gradient);
    std::vector<int> free;
    for (std::size_t p = 0; p < is_free.size(); ++p)
      if (is_free[p]) free.push_back(int(p));
    hessian = Eigen::MatrixXd(hessian(free, free));
    hessian.diagonal().array() += c.decay + 1e-7 * hessian.diagonal().mean();
    const Eigen::MatrixXd inverse =
        hessian.ldlt().solve(Eigen::MatrixXd::Identity(hessian.rows(), hessian.cols()));
    FloatNet rounded = scaled;
    round_neuron(scaled, h, scale, scaling.deviation, inverse, free, &rounded, &tables);
    net = fold_normalisation(rounded, scaling.mean, scaling.deviation);
    for (int n = 0; n < net.inputs(); ++n) {
      const auto p = std::size_t(h * net.inputs() + n);
      net.parameters[Eigen::Index(p)] = tables.hidden_weight[p] * scale.unit;
      is_free[p] = 0;
    }
    net = refine(net, objective, scaling, is_free, kSteps, c.robust, c.decay);
  }
  loss = objective.value(unfold_normalisation(net, scaling.mean, scaling.deviation), c.robust);
  return result;
}

QuantisedNet quantise_narrow(const FloatNet& net, double far_rho, const Compensation& c) {
  const Normalisation scaling = normalisation(*c.training);
  const Objective objective(*c.training, scaling, c.threads);
  const NetTables empty = empty_tables(net, 8, far_rho);
  std::vector<int> neurons(std::size_t(net.hidden()));
  std::iota(neurons.begin(), neurons.end(), 0);
  Random random(1);
  std::optional<Rounded> best;
  for (int k = 0; k < kOrders; ++k) {
    Rounded rounded = round_in_order(net, neurons, empty, scaling, objective, c);
    if (!best || rounded.loss < best->loss) best = std::move(rounded);
    random.shuffle(neurons);
  }
  best->net = refine(best->net, objective, scaling, best->is_free, kLastSteps, c.robust, c.decay);
  round_rest(best->net, best->scales, &best->tables);
  return QuantisedNet(best->tables);
}

}  // namespace

double value_of(const urad_rescale& rescale) {
  return std::ldexp(double(rescale.multiplier), -int{rescale.shift});
}

urad_rescale rescale_of(double factor) {
  if (!(factor >= 0x1p-32 && factor < 0x1p15))
    throw Error(fmt::format("a scale of {} is outside 2^-32 .. 2^15", factor));
  int exponent = 0;
  double multiplier = std::round(std::ldexp(std::frexp(factor, &exponent), 16));
  if (multiplier > 65535) multiplier /= 2, ++exponent;
  return {static_cast<std::uint16_t>(multiplier), static_cast<std::uint16_t>(16 - exponent)};
}

NetTables round_net(const FloatNet& net, int weight_bits, double far_rho) {
  NetTables tables = empty_tables(net, weight_bits, far_rho);
  std::vector<Scale> scales;
  for (int h = 0; h < net.hidden(); ++h) {
    scales.push_back(hidden_scale(net, h, weight_bits));
    for (int n = 0; n < net.inputs(); ++n)
      tables.hidden_weight[std::size_t(h * net.inputs() + n)] =
          round16(std::clamp(net.hidden_weight(h, n) / scales.back().unit, -weight_max(weight_bits),
                             weight_max(weight_bits)));
  }
  round_rest(net, scales, &tables);
  return tables;
}

TrainingSet with_word_of(const FloatNet& net, TrainingSet set) {
  for (Sample& sample : set.samples)
    sample.target = sample.gate() * net.run(sample.input_q15.data());
  return set;
}

QuantisedNet quantise(const FloatNet& net, int weight_bits, double far_rho,
                      const Compensation& compensation) {
  if (weight_bits == 8 && compensation.training != nullptr)
    return quantise_narrow(net, far_rho, compensation);
  return QuantisedNet(round_net(net, weight_bits, far_rho));
}

QuantisedNet with_near_rho(const QuantisedNet& net, double near_rho) {
  NetTables tables = net.tables();
  tables.near_rho_uq16 = threshold_uq16(near_rho, "near");
  return QuantisedNet(tables);
}

}  // namespace host
