// Factors of one patch with many, in SIMD lanes: the engine's integers, bit for bit, 4 to 16 pairs at
// a time.
//
// The engine takes pairs one by one, because a small chip has nothing else. A host has wider
// registers; which ones is found out at run time (Highway). Formulas as in pair.hpp and
// network.hpp; tests/lanes_test.cpp holds every instruction set of the machine to the engine's bits.
#pragma once
#include <cstdint>
#include <vector>

#include "lanes/patch_lanes.hpp"
#include "urad/form_factor.hpp"

namespace host {

/// Grows as needed and is used again. Values beyond the pairs asked for are undefined.
struct LaneFactors {
  std::vector<std::uint32_t> from_uq32,
      to_uq32;                          ///< F_ij, F_ji of i and patches first + k; repaired
  std::vector<std::uint32_t> rho_uq16;  ///< kNotFacing: both factors are 0
  static constexpr std::uint32_t kNotFacing = UINT32_MAX;
};

/// Factors of patch i with patches first .. first + count - 1 by kernel and network (null: kernel
/// alone) from urad::exchange_in_front_q24() and urad::form_factor_uq32(), for patches that lie
/// wholly in front of each other's plane. Nothing is handed over to the exact sum: whoever asks
/// looks at rho.
void lane_factors(const PatchLanes& patches, std::uint16_t i, std::uint16_t first,
                  std::uint16_t count, urad::Kernel kernel, const urad_net* net, LaneFactors* out);

}  // namespace host
