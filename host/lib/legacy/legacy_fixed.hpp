// A network of the report in the engine's integers.
#pragma once
#include <memory>
#include <vector>

#include "legacy/legacy_net.hpp"
#include "urad/legacy_net.h"

namespace host {

/// The tables of urad_legacy_net, owned.
struct LegacyTables {
  int hidden = 0;
  LegacyScaling scaling = LegacyScaling::linear;
  std::vector<std::int16_t> hidden_weight;
  std::vector<std::uint8_t> hidden_shift;
  std::vector<std::int32_t> hidden_bias;
  std::vector<std::int16_t> output_weight;
  int output_shift = 0;
  std::int32_t output_bias = 0;
};

/// Each weight rounded on its own; per unit the most fraction bits that 16 bits and the sums allow.
/// Whole numbers and powers of two only: the same integers from every compiler. Throws Error for
/// weights that the formats cannot hold.
LegacyTables round_legacy(const LegacyNet& net);

/// Immutable; copies share the tables.
class LegacyFixed {
 public:
  /// Sets the PROVEN flag where it holds, and the CRC. Error when the engine's legacy_check()
  /// refuses the result.
  explicit LegacyFixed(const LegacyTables& tables);

  const urad_legacy_net& pod() const { return owned_->pod; }
  const LegacyTables& tables() const { return owned_->tables; }
  bool proven() const { return (pod().flags & URAD_LEGACY_PROVEN) != 0; }
  /// Largest |z| that coordinates in [0, 1] can cause.
  double hidden_range() const;
  /// Bytes of flash on a 32-bit target: struct and tables.
  int flash_bytes() const;

  /// F from p to q. Coordinates in [0, 1].
  double form_factor(const LegacyInput& input) const;
  /// y before it is unscaled.
  double run(const LegacyInput& input) const;

 private:
  struct Owned {
    LegacyTables tables;
    urad_legacy_net pod{};
  };
  std::shared_ptr<const Owned> owned_;
};

/// y of a net in the engine's integers, UQ1.15. Coordinates in [0, 1].
std::uint16_t legacy_output_uq15(const urad_legacy_net& net, const LegacyInput& input);

/// What rounding costs on a set of inputs: the largest difference of y and of F.
struct LegacyRounding {
  double output = 0, factor = 0;
};
LegacyRounding legacy_rounding(const LegacyNet& net, const LegacyFixed& fixed,
                               const std::vector<LegacyInput>& inputs);

}  // namespace host
