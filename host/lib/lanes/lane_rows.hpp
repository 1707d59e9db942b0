// All factors of a convex scene, each unordered pair done once, by kernel or network in SIMD lanes.
#pragma once
#include <cstdint>
#include <span>

#include "urad/form_factor.hpp"

namespace host {

/// True where lane_rows() gives what urad::pair_fill() gives: the scene is convex and no skip
/// is switched off.
bool has_lanes(const urad::PairSource& pairs);

/// Factors [N][N] UQ0.32, the same bits as urad::pair_fill() row by row, and adds to *counters (and
/// to pairs.ways, if there are some) what it would count. Pairs by kernel or network go in lanes
/// where two surfaces wholly face each other; by the engine where they do not, where the network
/// hands over to the exact sum, and where every pair goes by a sum or by auto. has_lanes(pairs)
/// holds; pairs.counters is not used.
void lane_rows(const urad::PairSource& pairs, int threads, std::span<std::uint32_t> f_uq32,
               urad_counters* counters);

}  // namespace host
