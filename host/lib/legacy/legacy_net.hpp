// The network of the 1996 report: 24 raw coordinates, one layer of sigmoids, a sigmoid.
//
//   z_h = b_h + sum_n w_hn x_n        s_h = sigma(z_h)        y = sigma(c + sum_h v_h s_h)
//
// x: the vertices of p, then those of q, three coordinates each; y: F from p to q, scaled.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/polygon.hpp"

namespace host {

inline constexpr int kLegacyInputs = 24;

/// How the report fits F into the range of a sigmoid (sections 3.3 and 4.2.3).
enum class LegacyScaling {
  linear,  ///< y = 0.8 F + 0.1
  log,     ///< y = 0.1 - 0.1 log10 F: F = 1 -> 0.1, F = 1e-8 -> 0.9; F = 0 has no image
};

std::string_view name(LegacyScaling scaling);

/// F -> y. Throws Error for F <= 0 with log scaling.
double legacy_scaled(LegacyScaling scaling, double f);
/// y -> F: below 0 where a linear net ends below 0.1.
double legacy_unscaled(LegacyScaling scaling, double y);

using LegacyInput = std::array<float, kLegacyInputs>;

/// The coordinates of two quads; of a triangle the last corner twice. Throws Error for more than
/// four vertices or a hole.
LegacyInput legacy_input(const Polygon& p, const Polygon& q);

struct LegacyNet {
  int hidden = 0;
  LegacyScaling scaling = LegacyScaling::linear;
  std::vector<float> hidden_weight;  ///< [hidden][24]
  std::vector<float> hidden_bias, output_weight;
  float output_bias = 0;

  /// "linear50", "log5".
  std::string name() const;
  /// y in double, from the weights as they are.
  double run(const LegacyInput& input) const;
  double form_factor(const LegacyInput& input) const {
    return legacy_unscaled(scaling, run(input));
  }
  /// sum |w| + |b|, the largest of the hidden units: |z| cannot pass it for inputs in [0, 1].
  double hidden_range() const;
};

}  // namespace host
