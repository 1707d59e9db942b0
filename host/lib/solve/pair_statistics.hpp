// What the pairs of a scene are to each other: how many face, see or half see each other.
#pragma once
#include <cstdint>

#include "scene/scene.hpp"

namespace host {

/// Unordered pairs of patches.
struct PairStatistics {
  std::uint64_t all = 0;      ///< N (N - 1) / 2
  std::uint64_t facing = 0;   ///< on different planes, part of each in front of the other
  std::uint64_t seen = 0;     ///< facing, nothing between them
  std::uint64_t partly = 0;   ///< facing, some rays blocked
  std::uint64_t blocked = 0;  ///< facing, all rays blocked

  double facing_share() const { return all ? double(facing) / double(all) : 0; }
  double share_of_facing(std::uint64_t count) const {
    return facing ? double(count) / double(facing) : 0;
  }
};

/// By `rays` rays a pair, where a blocker could stand between the two.
PairStatistics pair_statistics(const Scene& scene, int threads, int rays);

}  // namespace host
