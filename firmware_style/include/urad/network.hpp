// network.hpp -- inference: one hidden sigmoid layer and a linear skip, integers only, no state.
#pragma once
#include "urad/net.h"
#include "urad/status.hpp"

namespace urad {

/// Output y in Q15.16 (log2 units) for net.inputs Q0.15 inputs.
/// The net has passed network_check(): accumulators cannot overflow, whatever the inputs.
///   Cost   hidden * (inputs + 1) + inputs multiply-adds, hidden table look-ups; no division.
int32_t network_run(const urad_net& net, const int16_t* input_q15) noexcept;

/// ABI, sizes, null pointers, shifts, accumulators that cannot overflow, the PROVEN flag against
/// the weights, CRC-32.
Status network_check(const urad_net* net) noexcept;

/// CRC-32 of a net as network_check() computes it; the exporter stores it in net.crc32.
uint32_t network_crc32(const urad_net& net) noexcept;

}  // namespace urad
