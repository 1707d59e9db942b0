#include "network/narrow_weights.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "network/net_rounding.hpp"
#include "network/random.hpp"
#include "network/trainer.hpp"
#include "network/whole_steps.hpp"

namespace host {

namespace {

constexpr int kBits = 8;
// What is left of the error depends on the order of the neurons by as much as a half.
constexpr int kOrders = 12;
constexpr int kKicks = 20000;  // ten times as many: a fiftieth less error
constexpr int kSteps = 1,
              kLastSteps = 4;  // of training after each neuron, and after all are whole
constexpr int kWalks = 8;      // each from the model at the end of the one before; most take three

/// Rounds the hidden weights of one network; everything in parameters for normalised inputs.
class Narrowing {
 public:
  Narrowing(const FloatNet& net, double far_rho, const Compensation& c)
      : compensation_(c),
        scaling_(normalisation(*c.training)),
        objective_(*c.training, scaling_, c.threads),
        original_(net),
        empty_(empty_tables(net, kBits, far_rho)) {}

  /// A net with whole hidden weights; the rest made up for them.
  struct Rounded {
    FloatNet net;
    NetTables tables;
    std::vector<WeightScale> scales;
    std::vector<char> is_free;  ///< of the parameters: not whole
    double loss = 0;
  };

  Rounded in_order(const std::vector<int>& neurons) const;

  /// Steps whole weights for as long as the loss falls.
  void walk(Rounded* rounded) const {
    for (int k = 0; k < kWalks; ++k) {
      Rounded next = *rounded;
      step(&next);
      train(&next, kLastSteps);
      if (!(next.loss < rounded->loss)) return;
      *rounded = std::move(next);
    }
  }

 private:
  /// Half the second derivatives of the loss, and half its slope downhill.
  struct Model {
    Eigen::MatrixXd hessian;
    Eigen::VectorXd downhill;
  };
  Model model(const FloatNet& scaled) const {
    Model model;
    objective_.model(scaled, compensation_.robust, &model.hessian, &model.downhill);
    return model;
  }
  FloatNet unfolded(const FloatNet& net) const {
    return unfold_normalisation(net, scaling_.mean, scaling_.deviation);
  }
  /// The part of a Hessian that belongs to free parameters, made sure to be definite.
  Eigen::MatrixXd among(const std::vector<int>& free, const Eigen::MatrixXd& hessian) const {
    Eigen::MatrixXd part = hessian(free, free);
    part.diagonal().array() += compensation_.decay + 1e-7 * part.diagonal().mean();
    return part;
  }
  void train(Rounded* rounded, int steps) const {
    rounded->net = refine(rounded->net, objective_, scaling_, rounded->is_free, steps,
                          compensation_.robust, compensation_.decay);
    rounded->loss = objective_.value(unfolded(rounded->net), compensation_.robust);
  }
  void round_neuron(const FloatNet& scaled, int h, Eigen::MatrixXd inverse,
                    const std::vector<int>& free, Rounded* rounded) const;
  void step(Rounded* rounded) const;

  const Compensation& compensation_;
  Normalisation scaling_;
  Objective objective_;
  const FloatNet& original_;
  NetTables empty_;
};

std::vector<int> places(const std::vector<char>& is_free, bool wanted) {
  std::vector<int> places;
  for (std::size_t p = 0; p < is_free.size(); ++p)
    if (bool(is_free[p]) == wanted) places.push_back(int(p));
  return places;
}

// The weights of neuron h in turn; the parameters that are still free take up each rounding error
// along the inverse Hessian of what is left.
void Narrowing::round_neuron(const FloatNet& scaled, int h, Eigen::MatrixXd inverse,
                             const std::vector<int>& free, Rounded* rounded) const {
  const int inputs = original_.inputs();
  const double unit = rounded->scales[std::size_t(h)].unit, greatest = greatest_weight(kBits);
  Eigen::VectorXd value = scaled.parameters(free);
  for (std::size_t k = 0; k < free.size(); ++k) {
    const int n = free[k] - h * inputs;
    if (n < 0 || n >= inputs) continue;
    const auto at = Eigen::Index(k);
    const double step = unit * scaling_.deviation[n];
    const double q = std::clamp(std::round(value[at] / step), -greatest, greatest);
    rounded->tables.hidden_weight[std::size_t(free[k])] = std::int16_t(q);
    const Eigen::VectorXd column = inverse.col(at) / inverse(at, at);
    value -= column * (value[at] - q * step);
    value[at] = q * step;
    inverse -= column * inverse.row(at).eval();
    inverse.row(at).setZero(), inverse.col(at).setZero();
    inverse(at, at) = 1;
  }
  FloatNet made_up = scaled;
  made_up.parameters(free) = value;
  rounded->net = fold_normalisation(made_up, scaling_.mean, scaling_.deviation);
  for (int p = h * inputs; p < (h + 1) * inputs; ++p) {
    rounded->net.parameters[p] = rounded->tables.hidden_weight[std::size_t(p)] * unit;
    rounded->is_free[std::size_t(p)] = 0;
  }
}

Narrowing::Rounded Narrowing::in_order(const std::vector<int>& neurons) const {
  Rounded result{original_, empty_, std::vector<WeightScale>(neurons.size()),
                 std::vector<char>(std::size_t(original_.parameters.size()), 1)};
  for (const int h : neurons) {
    result.scales[std::size_t(h)] = hidden_scale(result.net, h, kBits);
    const FloatNet scaled = unfolded(result.net);
    const std::vector<int> free = places(result.is_free, true);
    const Eigen::MatrixXd hessian = among(free, model(scaled).hessian);
    round_neuron(scaled, h,
                 hessian.ldlt().solve(Eigen::MatrixXd::Identity(hessian.rows(), hessian.cols())),
                 free, &result);
    train(&result, kSteps);
  }
  return result;
}

// By the model at the present weights, with the free parameters where they are best for each
// choice of whole ones: the Schur complement of theirs.
void Narrowing::step(Rounded* rounded) const {
  const Model m = model(unfolded(rounded->net));
  const std::vector<int> whole = places(rounded->is_free, false),
                         free = places(rounded->is_free, true);
  const Eigen::LDLT<Eigen::MatrixXd> made_up(among(free, m.hessian));
  const Eigen::MatrixXd across = m.hessian(whole, free);
  const int inputs = original_.inputs();
  Eigen::VectorXd unit(Eigen::Index(whole.size()));
  std::vector<int> start(whole.size());
  for (std::size_t k = 0; k < whole.size(); ++k) {
    unit[Eigen::Index(k)] = rounded->scales[std::size_t(whole[k] / inputs)].unit *
                            scaling_.deviation[whole[k] % inputs];
    start[k] = rounded->tables.hidden_weight[std::size_t(whole[k])];
  }
  const Eigen::VectorXd downhill =
      m.downhill(whole) - across * made_up.solve(Eigen::VectorXd(m.downhill(free)));
  const Eigen::MatrixXd curve =
      Eigen::MatrixXd(m.hessian(whole, whole)) - across * made_up.solve(across.transpose());
  const std::vector<int> steps =
      whole_steps(-downhill.cwiseProduct(unit), unit.asDiagonal() * curve * unit.asDiagonal(),
                  start, greatest_weight(kBits), kKicks);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    const auto p = std::size_t(whole[k]);
    rounded->tables.hidden_weight[p] = std::int16_t(start[k] + steps[k]);
    rounded->net.parameters[whole[k]] =
        rounded->tables.hidden_weight[p] * rounded->scales[p / std::size_t(inputs)].unit;
  }
}

}  // namespace

NetTables narrow_net(const FloatNet& net, double far_rho, const Compensation& compensation) {
  const Narrowing narrowing(net, far_rho, compensation);
  std::vector<int> neurons(std::size_t(net.hidden()));
  std::iota(neurons.begin(), neurons.end(), 0);
  Random random(1);
  std::optional<Narrowing::Rounded> best;
  for (int k = 0; k < kOrders; ++k) {
    Narrowing::Rounded rounded = narrowing.in_order(neurons);
    narrowing.walk(&rounded);
    if (!best || rounded.loss < best->loss) best = std::move(rounded);
    random.shuffle(neurons);
  }
  round_rest(best->net, best->scales, &best->tables);
  return best->tables;
}

}  // namespace host
