// What a network learns from: pairs as the engine sees them, and how much each of them matters.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "urad/pair.hpp"

namespace host {

/// One configuration of two patches. Its error is e = target - gate * y(input), in units of log2.
struct Sample {
  std::array<std::int16_t, urad::kPairInputs> input_q15{};
  std::uint16_t gate_uq16 =
      0;              ///< g^2; 0 below the far threshold: the engine does not run the net there
  double target = 0;  ///< log2 of exact exchange over moment kernel
  double weight = 1;  ///< of e^2, relative to the other samples
  std::int16_t more_q15 = 0;  ///< an input that the engine does not have, for trials

  double gate() const { return gate_uq16 / 65536.0; }
  double input(int n) const {
    return (n < urad::kPairInputs ? input_q15[std::size_t(n)] : more_q15) / 32768.0;
  }
};

/// factor * e(sample) is part of the error of row sum `row`.
struct RowTerm {
  std::uint32_t row = 0;
  std::uint32_t sample = 0;
  double factor = 0;
};

/// Objective: sum w e^2 / sum w + row_weight * mean over rows of (sum factor e)^2.
struct TrainingSet {
  std::vector<Sample> samples;
  std::vector<RowTerm> row_terms;  ///< ordered by sample
  std::uint32_t rows = 0;
  double row_weight = 0;
  int inputs = urad::kPairInputs;  ///< one more: more_q15 is an input, too
};

}  // namespace host
