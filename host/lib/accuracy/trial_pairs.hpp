// Pairs of polygons by kind: easy ones, and those on which form factors go wrong. What methods are
// judged on, and what the error constants of `auto` are fitted to.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "accuracy/pair_sets.hpp"
#include "network/random.hpp"

namespace host {

/// Streams that have no pair in common: constants are fitted on the first, everything that is
/// stated is measured on the second.
enum class TrialUse { fit, test };

struct TrialFamily {
  std::string name;
  std::function<PolygonPair(Random&)> draw;
  bool test_only = false;  ///< never fitted on
};

/// Random quads (convex, concave), room pairs, shared edges at all angles and aspect ratios, part
/// of an edge, a vertex in common, nearly touching, partly behind, slivers, size ratios to 1e6,
/// aligned rectangles; only to be tested on: triangles and pentagons, plates close to each other, freely turned
/// rectangles.
std::vector<TrialFamily> trial_families();

/// Factors below this count nowhere: light would not notice.
inline constexpr double kLeastTrialFactor = 1e-7;

/// 0: F below 1e-6, 1: 1e-6 .. 1e-5, ... 6: 0.1 .. 1.
inline constexpr int kTrialDecades = 7;
int trial_decade(double f);

/// `count` pairs of a family, spread over the decades of F as evenly as it can, exact factors
/// included; the same for a seed on any number of threads.
PairSet trial_pairs(const TrialFamily& family, TrialUse use, std::uint64_t seed, std::size_t count,
                    int threads);

}  // namespace host
