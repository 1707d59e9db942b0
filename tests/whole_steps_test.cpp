// Whole steps of a quadratic: by trying all, against the search.
#include "network/whole_steps.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "network/random.hpp"

namespace {

struct Quadratic {
  Eigen::VectorXd slope;
  Eigen::MatrixXd curve;

  Quadratic(int size, host::Random* random) : slope(size), curve(size, size) {
    Eigen::MatrixXd root(size, size);
    for (double& x : root.reshaped()) x = random->normal();
    for (double& x : slope) x = 3 * random->normal();
    curve = root * root.transpose();
  }
  double at(const std::vector<int>& steps) const {
    Eigen::VectorXd d(slope.size());
    for (Eigen::Index k = 0; k < d.size(); ++k) d[k] = steps[std::size_t(k)];
    return slope.dot(d) + d.dot(curve * d) / 2;
  }
};

/// The least over all steps of at most `most`, one number of a mixed base after another.
double least(const Quadratic& q, int most) {
  const auto size = std::size_t(q.slope.size());
  double least = 0;
  std::vector<int> steps(size, -most);
  for (std::size_t k = 0; k < size;) {
    least = std::min(least, q.at(steps));
    for (k = 0; k < size && steps[k] == most; ++k) steps[k] = -most;
    if (k < size) ++steps[k];
  }
  return least;
}

}  // namespace

TEST_CASE("whole steps are those that trying all of them finds") {
  const std::uint64_t seed = 12;
  MESSAGE("seed " << seed);
  host::Random random(seed);
  for (int k = 0; k < 50; ++k) {
    const Quadratic q(5, &random);
    const std::vector<int> steps =
        host::whole_steps(q.slope, q.curve, std::vector<int>(5, 0), 3, 500);
    CHECK(q.at(steps) == doctest::Approx(least(q, 3)));
    for (const int step : steps) CHECK(std::abs(step) <= 3);
  }
}

TEST_CASE("whole steps stay within the range, and find the place of a round bowl") {
  const Eigen::MatrixXd bowl = Eigen::MatrixXd::Identity(3, 3);
  const Eigen::Vector3d slope(-2.2, 50, 0.4);  // lowest at 2.2, -50, -0.4
  CHECK(host::whole_steps(slope, bowl, {0, 0, 0}, 127, 10) == std::vector<int>{2, -50, 0});
  CHECK(host::whole_steps(slope, bowl, {0, -120, 0}, 127, 10) == std::vector<int>{2, -7, 0});
  CHECK(host::whole_steps(slope, bowl, {127, 0, 127}, 127, 0) == std::vector<int>{0, -50, 0});
  CHECK(host::whole_steps(Eigen::Vector3d::Zero(), Eigen::MatrixXd::Zero(3, 3), {1, 2, 3}, 127,
                          100) == std::vector<int>{0, 0, 0});
}
