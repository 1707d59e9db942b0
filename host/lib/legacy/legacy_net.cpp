#include "legacy/legacy_net.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "network/float_net.hpp"

namespace host {

std::string_view name(LegacyScaling scaling) {
  return scaling == LegacyScaling::linear ? "linear" : "log";
}

double legacy_scaled(LegacyScaling scaling, double f) {
  if (scaling == LegacyScaling::linear) return 0.8 * f + 0.1;
  if (!(f > 0))
    throw Error(fmt::format("log scaling has no image of F = {}: leave such pairs out", f));
  return 0.1 - 0.1 * std::log10(f);
}

double legacy_unscaled(LegacyScaling scaling, double y) {
  return scaling == LegacyScaling::linear ? (y - 0.1) / 0.8 : std::pow(10.0, (0.1 - y) / 0.1);
}

LegacyInput legacy_input(const Polygon& p, const Polygon& q) {
  LegacyInput input{};
  std::size_t at = 0;
  for (const Polygon* polygon : {&p, &q}) {
    const std::vector<Vec3>& corner = polygon->outer;
    if (corner.size() < 3 || corner.size() > 4 || !polygon->holes.empty())
      throw Error(
          fmt::format("the report's networks read quads and triangles: {} vertices and {} holes",
                      corner.size(), polygon->holes.size()));
    for (std::size_t n = 0; n < 4; ++n)
      for (int k = 0; k < 3; ++k) input[at++] = float(corner[std::min(n, corner.size() - 1)][k]);
  }
  return input;
}

std::string LegacyNet::name() const { return fmt::format("{}{}", host::name(scaling), hidden); }

double LegacyNet::run(const LegacyInput& input) const {
  double sum = output_bias;
  const float* weight = hidden_weight.data();
  for (int h = 0; h < hidden; ++h) {
    double z = hidden_bias[std::size_t(h)];
    for (int n = 0; n < kLegacyInputs; ++n) z += double(*weight++) * double(input[std::size_t(n)]);
    sum += double(output_weight[std::size_t(h)]) * sigmoid(z);
  }
  return sigmoid(sum);
}

double LegacyNet::hidden_range() const {
  double range = 0;
  for (int h = 0; h < hidden; ++h) {
    double sum = std::fabs(double(hidden_bias[std::size_t(h)]));
    for (int n = 0; n < kLegacyInputs; ++n) {
      const int at = h * kLegacyInputs + n;
      sum += std::fabs(double(hidden_weight[std::size_t(at)]));
    }
    range = std::max(range, sum);
  }
  return range;
}

}  // namespace host
