// The trainer's objective with its Gauss-Newton model, on all cores; the same bits for any number
// of threads.
#pragma once
#include <Eigen/Core>

#include "network/float_net.hpp"
#include "network/training_set.hpp"

namespace host {

/// Mean and deviation of each input over the samples the network is run on, every sample with its
/// weight.
struct Normalisation {
  Eigen::VectorXd mean, deviation;  ///< deviation of an input that never varies: 1
};
Normalisation normalisation(const TrainingSet& set);

/// L(p) = sum w loss(e) / sum w + row_weight mean_rows (sum factor e)^2, e = target - gate y_p(x).
/// over the samples with gate > 0; the others, far pairs, add a constant error to the row sums and
/// are not evaluated again.
///   loss(e) = e^2                                     robust = 0
///   loss(e) = (4/3) c^2 ((1 + (e/c)^2)^(3/4) - 1)     robust = c: weight (1 + (e/c)^2)^(-1/4) on e^2
class Objective {
 public:
  /// Copies what it needs. Inputs are normalised once, here. threads: 0 for all cores.
  Objective(const TrainingSet& set, const Normalisation& normalisation, int threads);

  /// L at the parameters of `net`, whose inputs are the normalised ones.
  double value(const FloatNet& net, double robust) const;

  /// L, and gradient = -1/2 dL/dp.
  double slope(const FloatNet& net, double robust, Eigen::VectorXd* gradient) const;

  /// L, and gradient = -1/2 dL/dp, hessian ~ 1/2 d2L/dp2 [Gauss-Newton]; hessian in full, not one
  /// triangle.
  double model(const FloatNet& net, double robust, Eigen::MatrixXd* hessian,
               Eigen::VectorXd* gradient) const;

 private:
  struct Part;
  enum class Wanted { value, slope, model };
  template <Wanted kWanted>
  double evaluate(const FloatNet& net, double robust, Eigen::MatrixXd* hessian,
                  Eigen::VectorXd* gradient) const;
  template <Wanted kWanted>
  void add_block(const FloatNet& net, double robust, Eigen::Index first, Eigen::Index count,
                 Part* part) const;

  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor inputs_;  ///< [sample][input]
  Eigen::VectorXd gate_, target_, weight_;
  std::vector<RowTerm> row_terms_;
  std::vector<std::size_t> first_term_;  ///< [sample + 1]
  Eigen::Index rows_ = 0;
  Eigen::VectorXd far_row_error_;  ///< what far pairs add to each row's error
  double row_weight_ = 0;
  int threads_ = 0;
};

}  // namespace host
