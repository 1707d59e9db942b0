// A network in the engine's integers, with the proofs that the engine's inner loops rely on.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "urad/net.h"

namespace host {

/// The tables of urad_net, owned. Hidden weights are held in 16 bits whatever weight_bits is.
struct NetTables {
  int inputs = 0, hidden = 0;
  int weight_bits = 16;  ///< 8 or 16
  std::uint16_t far_rho_uq16 = 0;
  std::uint16_t near_rho_uq16 = 0;  ///< 0: the net never hands over to the exact sum
  std::vector<std::int16_t> hidden_weight;  ///< [hidden][inputs]
  std::vector<std::int32_t> hidden_bias;
  std::vector<urad_rescale> hidden_rescale;
  std::vector<std::int16_t> output_weight, skip_weight;
  std::int32_t output_bias = 0;
  urad_rescale output_rescale{};
};

/// Immutable; copies share the tables.
class QuantisedNet {
 public:
  /// Sets the PROVEN flag where it holds, and the CRC. Error when sizes or weights leave their
  /// ranges, when an accumulator could overflow, or when the engine's network_check() refuses the
  /// result.
  explicit QuantisedNet(const NetTables& tables);

  const urad_net& pod() const { return owned_->pod; }
  const NetTables& tables() const { return owned_->tables; }
  bool proven() const { return (pod().flags & URAD_NET_PROVEN) != 0; }
  /// Largest |z| that any input can cause, in real units (clamped at 16 where not proven).
  double hidden_range() const { return owned_->hidden_range; }
  /// Bytes of flash on a 32-bit target: struct and tables.
  int flash_bytes() const;

 private:
  struct Owned {
    NetTables tables;
    std::vector<std::int8_t> narrow_weight;
    urad_net pod{};
    double hidden_range = 0;
  };
  std::shared_ptr<const Owned> owned_;
};

}  // namespace host
