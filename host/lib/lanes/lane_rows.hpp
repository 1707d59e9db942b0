// All factors of a convex scene by kernel or network, in SIMD lanes.
#pragma once
#include <cstdint>
#include <span>

#include "urad/form_factor.hpp"

namespace host {

/// True where lane_rows() gives what urad::pair_fill() gives: the scene is convex, every pair goes
/// by kernel or network, no skip is switched off and none bounded.
bool has_lanes(const urad::PairSource& pairs);

/// Factors [N][N] UQ0.32, the same bits as urad::pair_fill() row by row, and adds to *counters what
/// it would count. Each unordered pair is done once: in lanes where two surfaces wholly face each
/// other, by the engine where they do not or where the network hands over to the exact sum.
/// has_lanes(pairs) holds; pairs.counters is not used.
void lane_rows(const urad::PairSource& pairs, int threads, std::span<std::uint32_t> f_uq32,
               urad_counters* counters);

}  // namespace host
