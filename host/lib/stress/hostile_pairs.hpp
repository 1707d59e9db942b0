// Polygon pairs that break programs.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "network/general_pairs.hpp"
#include "network/random.hpp"

namespace host {

struct HostileFamily {
  std::string name;
  std::function<PolygonPair(Random&)> draw;
};

/// Shared edges from 1e-6 to pi - 1e-6, near parallel plates turned by 1e-16 to 1e-4, slivers to
/// 1e6, gaps to 1e-9 of the size, size ratios to 1e9, concave polygons, 3 to 64 vertices, holes,
/// collinear and repeated vertices, scales from 1e-12 to 1e12, places 1e6 sizes from the origin.
/// Every one is turned freely but for a quarter that stays upright.
std::vector<HostileFamily> hostile_families();

/// A star about the line between the centroids of the pair, across it at `place` (0 at p's, 1 at
/// q's), of so many corners, its radius `size` times that of the smaller polygon. Greater sizes
/// cover smaller ones.
Polygon blocker_between(const PolygonPair& pair, int corners, double place, double size);

}  // namespace host
