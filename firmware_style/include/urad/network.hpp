// network.hpp -- inference: one hidden sigmoid layer and a linear skip, integers only, no state.
#pragma once
#include "urad/net.h"
#include "urad/q.hpp"
#include "urad/status.hpp"

namespace urad {

/// Output y in Q15.16 (log2 units) for net.inputs Q0.15 inputs.
/// The net has passed network_check(): accumulators cannot overflow, whatever the inputs.
///   Cost   hidden * (inputs + 1) + inputs multiply-adds, hidden table look-ups; no division.
int32_t network_run(const urad_net& net, const int16_t* input_q15) noexcept;

/// What the network's word changes: gate y, |.| <= 61, Q7.24. With it kernel (-64 .. 63) and bend
/// (|.| < 2.2) stay within Q7.24. y itself may be hundreds where the gate leaves little of it.
inline constexpr int32_t kMostWord = 61;
constexpr int32_t word_q24(int32_t y_q16, uint16_t gate_uq16) noexcept {
  if ((magnitude(y_q16) >> 16) * gate_uq16 >= uint32_t{kMostWord - 1} << 16)
    return (y_q16 < 0 ? -kMostWord : kMostWord) * (1 << 24);
  return mul_round(y_q16, gate_uq16, 8);
}

/// ABI, sizes, null pointers, shifts, accumulators that cannot overflow, the PROVEN flag against
/// the weights, CRC-32.
Status network_check(const urad_net* net) noexcept;

/// CRC-32 of a net as network_check() computes it; the exporter stores it in net.crc32.
uint32_t network_crc32(const urad_net& net) noexcept;

}  // namespace urad
