// Sets of polygon pairs with their exact factors, drawn from a seed.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "network/general_pairs.hpp"

namespace host {

struct PairSet {
  std::string name;
  std::vector<PolygonPair> pairs;
  std::vector<double> exact;  ///< F from p to q
};

/// Free quads [Martin 1996, 3.2], `per_decade` pairs for each decade of F from 1e-6 to 1, smallest
/// first. The same for a seed on any number of threads.
std::vector<PairSet> free_quads_by_decade(std::uint64_t seed, std::size_t per_decade, int threads);

/// Of all sets, the pairs with (or without) a concave quad.
PairSet concave_part(const std::vector<PairSet>& sets, bool concave);

/// Patches of meshed rooms with free sides, angles and meshes (PairFamily::room).
PairSet room_pairs(std::uint64_t seed, std::size_t count, int threads);

}  // namespace host
