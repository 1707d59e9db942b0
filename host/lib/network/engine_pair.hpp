// A pair of patches exactly as the engine sees it: cut first, then the invariants.
#pragma once
#include <cstdint>
#include <optional>

#include "urad/form_factor.hpp"

namespace host {

struct EnginePair {
  urad::Pair invariants;
  std::int32_t limit_q24 = 0;  ///< log2 of the smaller area left, which G cannot exceed
  bool clipped = false;        ///< a part of one of the two was behind the other's plane

  double rho() const { return invariants.rho_uq16 / 65536.0; }
  /// log2 of the moment kernel, in square scene units.
  double log2_kernel() const {
    return (invariants.log2_kernel_q24 + invariants.log2_bend_q24) * 0x1p-24;
  }
};

/// Nothing when the two exchange no light.
inline std::optional<EnginePair> engine_pair(const urad_scene& scene, std::size_t i,
                                             std::size_t j) {
  EnginePair pair;
  if (!urad::clipped_pair(scene, urad::patch_at(scene, std::uint16_t(i)),
                          urad::patch_at(scene, std::uint16_t(j)), &pair.invariants,
                          &pair.limit_q24, &pair.clipped))
    return std::nullopt;
  return pair;
}

}  // namespace host
