// legacy.hpp -- the networks of the 1996 report on the engine's scenes: a source of factors like
// any other.
//
// The first layer is a sum of a part for the shooter and a part for the receiver, z = P_i + Q_j,
// and on a grid Q is affine: Q(u, v) = Q0 + u Du + v Dv. So a run over a surface costs 48 wide
// products a hidden unit once, and a sum, a look-up and a product a hidden unit for each receiver.
#pragma once
#include <stddef.h>

#include "urad/legacy_net.h"
#include "urad/source.h"
#include "urad/status.hpp"

namespace urad {

/// ABI, sizes, shifts, null pointers, sums that cannot overflow, the PROVEN flag, CRC-32.
Status legacy_check(const urad_legacy_net* net) noexcept;

/// CRC-32 of a net as legacy_check() computes it.
uint32_t legacy_crc32(const urad_legacy_net& net) noexcept;

/// The part of z_h that one polygon makes, Q8.23. `weight`: its 12 weights of a row; coordinates
/// in units of 2^-30 within [-2^29, 2^29], x = coordinate + 1/2.
///   Error   2^-24: products are exact in 64 bits and rounded once
int32_t legacy_half_q23(const int16_t* weight, int fraction_bits,
                        const urad_point vertex[4]) noexcept;

/// Output y, UQ1.15, for z_h in Q8.23. The net has passed legacy_check().
///   Error   of sigma(z): 7.8e-5 by the table; saturates at |z| = 16, where sigma is within 1.2e-7
///           of its end; of y against the same weights in double: tests/legacy_test.cpp
///   Cost    hidden + 1 look-ups, hidden + 2 products of 32 bits; no division
uint16_t legacy_output_uq15(const urad_legacy_net& net, const int32_t* z_q23) noexcept;

/// F in UQ0.32 from y: 0 where a linear net ends below 0.1, 2^32 - 1 where F would pass 1.
uint32_t legacy_form_factor_uq32(const urad_legacy_net& net, uint16_t y_uq15) noexcept;

/// A source (source.h). Patches have four vertices, or three: the last is then read twice. Pairs
/// whose centroids do not lie in front of each other's plane are 0, and so are patches of one planar
/// surface [Figure 4.1]. Coordinates are the scene's over 2^30, plus 1/2: a unit cube is read as it
/// was learned. F keeps what the network says: no repair makes rows sum to 1, no minimum makes it
/// symmetric.
struct LegacySource {
  const urad_scene* scene;
  const urad_legacy_net* net;
  uint16_t rays;     ///< visibility rays a pair where the scene is not convex; 0: ignore blockers
  uint16_t shooter;  ///< whose P is in memory; 0xFFFF: none yet
  urad_counters* counters;
  int32_t* memory;  ///< [4][hidden], Q8.23: P, z, Du, Dv
};

/// Bytes of memory for a net: 16 a hidden unit.
constexpr size_t legacy_bytes(uint8_t hidden) noexcept { return size_t{16} * hidden; }

/// bad_argument for null pointers or a patch of more than four vertices, bad_net, out_of_memory.
/// memory is aligned like an int32_t.
Status legacy_init(LegacySource* source, const urad_scene* scene, const urad_legacy_net* net,
                   uint16_t rays, urad_counters* counters, void* memory, size_t bytes) noexcept;

/// urad_fill for a LegacySource: always ok. Indices are not checked.
urad_status legacy_fill(void* legacy_source, uint16_t shooter, uint16_t surface, uint16_t first,
                        uint16_t count, uint32_t* f_uq32) noexcept;

}  // namespace urad
