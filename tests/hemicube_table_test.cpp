// Delta form factors: exact sums, symmetry, and every cell against numeric integration.
#include "urad/hemicube_table.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <vector>

namespace {

constexpr auto kCells = urad::make_hemicube_table<32>();  // at compile time
static_assert(kCells.top[0] > kCells.side[0]);

struct Cells {
  explicit Cells(int resolution)
      : half(resolution / 2), top(size_t(half * half)), side(top.size()) {
    std::vector<double> scratch(urad::hemicube_scratch(resolution));
    urad::fill_hemicube_cells(resolution, scratch.data(), top.data(), side.data());
  }
  uint32_t top_at(int row, int column) const { return top[size_t(row * half + column)]; }
  uint32_t side_at(int row, int column) const { return side[size_t(row * half + column)]; }
  int half;
  std::vector<uint32_t> top, side;
};

TEST_CASE("all five faces sum to exactly 2^32 and the top is symmetric, every even R") {
  for (int resolution = 16; resolution <= 128; resolution += 2) {
    const Cells cells(resolution);
    uint64_t sum = 0;
    bool symmetric = true;
    for (int row = 0; row < cells.half; ++row) {
      for (int column = 0; column < cells.half; ++column) {
        sum += uint64_t{4} * cells.top_at(row, column) + uint64_t{8} * cells.side_at(row, column);
        symmetric = symmetric && cells.top_at(row, column) == cells.top_at(column, row);
      }
    }
    INFO("R ", resolution);
    CHECK(sum == uint64_t{1} << 32);
    CHECK(symmetric);
  }
}

TEST_CASE("every cell is its integral to within one unit of 2^-32") {
  using Gauss = boost::math::quadrature::gauss<double, 15>;
  for (const int resolution : {16, 42, 128}) {
    const Cells cells(resolution);
    const double step = 1.0 / cells.half;
    double worst = 0;
    for (int row = 0; row < cells.half; ++row) {
      for (int column = 0; column < cells.half; ++column) {
        const auto integral = [&](auto density) {
          return 0x1p32 * Gauss::integrate(
                              [&](double v) {
                                return Gauss::integrate([&](double u) { return density(u, v); },
                                                        column * step, (column + 1) * step);
                              },
                              row * step, (row + 1) * step);
        };
        const double top = integral(
            [](double x, double y) { return 1 / (M_PI * std::pow(1 + x * x + y * y, 2)); });
        const double side = integral(
            [](double y, double z) { return z / (M_PI * std::pow(1 + y * y + z * z, 2)); });
        worst = std::max({worst, std::fabs(top - cells.top_at(row, column)),
                          std::fabs(side - cells.side_at(row, column))});
      }
    }
    INFO("R ", resolution);
    CHECK(worst < 1 + 1e-5);
  }
}

TEST_CASE(
    "compile time and run time give the same table; the elementary functions hold their error") {
  const Cells cells(32);
  CHECK(std::equal(cells.top.begin(), cells.top.end(), kCells.top));
  CHECK(std::equal(cells.side.begin(), cells.side.end(), kCells.side));
  const urad::HemicubeTable view = urad::hemicube_table(kCells);
  CHECK(view.resolution == 32);
  CHECK(view.side == kCells.side);

  double atan_error = 0, sqrt_error = 0;
  for (int k = -100000; k <= 100000; ++k) {
    const double t = k * 1e-5, x = 2 + t;
    atan_error = std::max(atan_error, std::fabs(urad::table::atan_unit(t) - std::atan(t)));
    sqrt_error = std::max(sqrt_error, std::fabs(urad::table::sqrt_near_one(x) / std::sqrt(x) - 1));
  }
  CHECK(atan_error <= 4e-16);
  CHECK(sqrt_error <= 3e-16);
  CHECK(urad::table::kPi == doctest::Approx(M_PI).epsilon(1e-15));
}

}  // namespace
