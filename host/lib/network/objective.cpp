#include "network/objective.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace host {

namespace {
// Sums run over this many parts, each in order, and then over the parts in order: the number of
// threads changes nothing.
constexpr Eigen::Index kParts = 16;
constexpr Eigen::Index kBlock = 256;  // samples whose Jacobian is in cache at a time
}  // namespace

struct Objective::Part {
  double loss = 0;
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  Eigen::VectorXd row_error;
  RowMajor row_jacobian;
};

Normalisation normalisation(const TrainingSet& set) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(set.inputs), square = mean;
  double total = 0;
  for (const Sample& sample : set.samples) {
    if (sample.gate_uq16 == 0) continue;
    total += 1;
    for (int n = 0; n < set.inputs; ++n) {
      const double x = sample.input(n);
      mean[n] += x;
      square[n] += x * x;
    }
  }
  if (total > 0) mean /= total, square /= total;
  Eigen::VectorXd deviation = (square.array() - mean.array().square()).cwiseMax(0).sqrt();
  // Inputs that differ by rounding of Q0.15 alone say nothing; scaled up they would be noise with
  // large weights.
  for (double& d : deviation)
    if (d < 2 / 32768.0) d = 1;
  return {mean, deviation};
}

Objective::Objective(const TrainingSet& set, const Normalisation& normalisation, int threads)
    : rows_(set.rows), row_weight_(set.row_weight), threads_(threads) {
  std::vector<std::uint32_t> place(set.samples.size(), 0);
  Eigen::Index count = 0;
  for (std::size_t k = 0; k < set.samples.size(); ++k)
    if (set.samples[k].gate_uq16 != 0) place[k] = std::uint32_t(count++);
  inputs_.resize(count, set.inputs);
  gate_.resize(count), target_.resize(count), weight_.resize(count);
  for (std::size_t k = 0; k < set.samples.size(); ++k) {
    const Sample& sample = set.samples[k];
    if (sample.gate_uq16 == 0) continue;
    const Eigen::Index at = place[k];
    for (int n = 0; n < set.inputs; ++n)
      inputs_(at, n) = (sample.input(n) - normalisation.mean[n]) / normalisation.deviation[n];
    gate_[at] = sample.gate();
    target_[at] = sample.target;
    weight_[at] = sample.weight;
  }
  const double total = weight_.sum();
  if (total > 0) weight_ /= total;

  far_row_error_.setZero(rows_);
  first_term_.assign(std::size_t(count) + 1, 0);
  for (const RowTerm& term : set.row_terms) {
    const Sample& sample = set.samples[term.sample];
    if (sample.gate_uq16 == 0) {
      far_row_error_[term.row] += term.factor * sample.target;
      continue;
    }
    row_terms_.push_back({term.row, place[term.sample], term.factor});
    ++first_term_[place[term.sample] + 1];
  }
  for (std::size_t k = 1; k < first_term_.size(); ++k) first_term_[k] += first_term_[k - 1];
}

template <Objective::Wanted kWanted>
void Objective::add_block(const FloatNet& net, double robust, Eigen::Index first,
                          Eigen::Index count, Part* part) const {
  const int inputs = net.inputs(), hidden = net.hidden();
  const auto x = inputs_.middleRows(first, count);
  const Eigen::Map<const RowMajor> hidden_weight(net.parameters.data(), hidden, inputs);
  const auto hidden_bias = net.parameters.segment(net.hidden_bias_at(), hidden);
  const auto output = net.parameters.segment(net.output_at(), hidden);
  const auto skip = net.parameters.segment(net.skip_at(), inputs);

  Eigen::ArrayXXd s = (x * hidden_weight.transpose()).rowwise() + hidden_bias.transpose();
  s = 1 / (1 + (-s).exp());
  const Eigen::VectorXd y = (s.matrix() * output + x * skip).array() + net.output_bias();
  const auto gate = gate_.segment(first, count);
  const Eigen::VectorXd error = target_.segment(first, count) - gate.cwiseProduct(y);

  Eigen::VectorXd weight = weight_.segment(first, count);
  if (robust > 0) {
    const Eigen::ArrayXd bend = 1 + (error.array() / robust).square();
    part->loss +=
        4.0 / 3 * robust * robust * (weight.array() * (bend.sqrt() * bend.sqrt().sqrt() - 1)).sum();
    weight.array() /= bend.sqrt().sqrt();
  } else {
    part->loss += weight.dot(error.cwiseAbs2());
  }
  for (std::size_t t = first_term_[std::size_t(first)]; t < first_term_[std::size_t(first + count)];
       ++t)
    part->row_error[row_terms_[t].row] +=
        row_terms_[t].factor * error[Eigen::Index(row_terms_[t].sample) - first];

  if constexpr (kWanted != Wanted::value) {
    RowMajor jacobian(count, net.parameters.size());
    for (int h = 0; h < hidden; ++h) {
      const Eigen::ArrayXd slope = output[h] * s.col(h) * (1 - s.col(h)) * gate.array();
      jacobian.middleCols(h * inputs, inputs) = slope.matrix().asDiagonal() * x;
      jacobian.col(net.hidden_bias_at() + h) = slope.matrix();
      jacobian.col(net.output_at() + h) = (s.col(h) * gate.array()).matrix();
    }
    jacobian.middleCols(net.skip_at(), inputs) = gate.asDiagonal() * x;
    jacobian.col(net.bias_at()) = gate;

    for (std::size_t t = first_term_[std::size_t(first)];
         t < first_term_[std::size_t(first + count)]; ++t)
      part->row_jacobian.row(row_terms_[t].row) +=
          row_terms_[t].factor * jacobian.row(Eigen::Index(row_terms_[t].sample) - first);
    part->gradient.noalias() += jacobian.transpose() * weight.cwiseProduct(error);
    if constexpr (kWanted == Wanted::model) {
      const Eigen::MatrixXd scaled = (weight.cwiseSqrt().asDiagonal() * jacobian).transpose();
      part->hessian.selfadjointView<Eigen::Lower>().rankUpdate(scaled);
    }
  }
}

template <Objective::Wanted kWanted>
double Objective::evaluate(const FloatNet& net, double robust, Eigen::MatrixXd* hessian,
                           Eigen::VectorXd* gradient) const {
  const Eigen::Index size = net.parameters.size(), samples = inputs_.rows();
  const Eigen::Index parts = std::min(kParts, (samples + kBlock - 1) / kBlock);
  std::vector<Part> part(std::size_t(std::max<Eigen::Index>(parts, 1)));
  for (Part& p : part) p.row_error.setZero(rows_);
  parallel_for(std::size_t(parts), threads_, [&](std::size_t k) {
    Part& p = part[k];
    if constexpr (kWanted == Wanted::model) p.hessian.setZero(size, size);
    if constexpr (kWanted != Wanted::value) {
      p.gradient.setZero(size);
      p.row_jacobian.setZero(rows_, size);
    }
    const Eigen::Index begin = samples * Eigen::Index(k) / parts;
    const Eigen::Index end = samples * Eigen::Index(k + 1) / parts;
    for (Eigen::Index first = begin; first < end; first += kBlock)
      add_block<kWanted>(net, robust, first, std::min(kBlock, end - first), &p);
  });

  Part& sum = part.front();
  sum.row_error += far_row_error_;
  for (Eigen::Index k = 1; k < parts; ++k) {
    const Part& p = part[std::size_t(k)];
    sum.loss += p.loss;
    sum.row_error += p.row_error;
    if constexpr (kWanted == Wanted::model) sum.hessian += p.hessian;
    if constexpr (kWanted != Wanted::value) {
      sum.gradient += p.gradient;
      sum.row_jacobian += p.row_jacobian;
    }
  }
  const double row_scale = rows_ > 0 ? row_weight_ / double(rows_) : 0;
  if constexpr (kWanted == Wanted::model) {
    if (parts == 0) sum.hessian.setZero(size, size);
    *hessian = sum.hessian.selfadjointView<Eigen::Lower>();
    if (row_scale > 0) *hessian += row_scale * (sum.row_jacobian.transpose() * sum.row_jacobian);
  }
  if constexpr (kWanted != Wanted::value) {
    if (parts == 0) sum.gradient.setZero(size);
    *gradient = sum.gradient;
    if (row_scale > 0) *gradient += row_scale * (sum.row_jacobian.transpose() * sum.row_error);
  }
  return sum.loss + row_scale * sum.row_error.squaredNorm();
}

double Objective::value(const FloatNet& net, double robust) const {
  return evaluate<Wanted::value>(net, robust, nullptr, nullptr);
}

double Objective::slope(const FloatNet& net, double robust, Eigen::VectorXd* gradient) const {
  return evaluate<Wanted::slope>(net, robust, nullptr, gradient);
}

double Objective::model(const FloatNet& net, double robust, Eigen::MatrixXd* hessian,
                        Eigen::VectorXd* gradient) const {
  return evaluate<Wanted::model>(net, robust, hessian, gradient);
}

}  // namespace host
