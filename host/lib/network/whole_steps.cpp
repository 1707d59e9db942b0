#include "network/whole_steps.hpp"

#include <cstdlib>

#include "network/random.hpp"

namespace host {

namespace {

constexpr int kKick = 4;  // steps at most

/// Where a search stands.
struct Place {
  std::vector<int> at;
  Eigen::VectorXd slope;
  double value = 0;
};

class Descent {
 public:
  Descent(const Eigen::MatrixXd& curve, int most) : curve_(curve), most_(most) {}

  bool allowed(const Place& place, Eigen::Index k, int step) const {
    return std::abs(place.at[std::size_t(k)] + step) <= most_;
  }
  void step(Place* place, Eigen::Index k, int step) const {
    place->value += step * place->slope[k] + curve_(k, k) / 2;
    place->slope += step * curve_.col(k);
    place->at[std::size_t(k)] += step;
  }
  /// The most useful step, until none helps by more than rounding.
  void down(Place* place) const {
    for (;;) {
      double least = -1e-12 * std::abs(place->value);
      Eigen::Index best = -1;
      for (Eigen::Index k = 0; k < curve_.rows(); ++k) {
        const double change = curve_(k, k) / 2 - std::abs(place->slope[k]);
        if (change < least && allowed(*place, k, down_way(*place, k))) least = change, best = k;
      }
      if (best < 0) return;
      step(place, best, down_way(*place, best));
    }
  }

 private:
  static int down_way(const Place& place, Eigen::Index k) { return place.slope[k] > 0 ? -1 : 1; }

  const Eigen::MatrixXd& curve_;
  int most_;
};

}  // namespace

std::vector<int> whole_steps(const Eigen::VectorXd& slope, const Eigen::MatrixXd& curve,
                             const std::vector<int>& start, int most, int kicks) {
  const Descent descent(curve, most);
  Place best{start, slope, 0};
  descent.down(&best);
  Random random(1);
  for (int k = 0; k < kicks; ++k) {
    Place place = best;
    for (int left = 1 + random.below(kKick); left > 0; --left) {
      const auto at = Eigen::Index(random.below(int(start.size())));
      const int step = random.below(2) ? 1 : -1;
      if (descent.allowed(place, at, step)) descent.step(&place, at, step);
    }
    descent.down(&place);
    if (place.value < best.value) best = place;
  }
  std::vector<int> steps(start.size());
  for (std::size_t k = 0; k < steps.size(); ++k) steps[k] = best.at[k] - start[k];
  return steps;
}

}  // namespace host
