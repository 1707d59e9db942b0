// Random pairs for networks that must serve any scene: free quads, and neighbours as meshed rooms
// have them.
#pragma once
#include <vector>

#include "geometry/polygon.hpp"
#include "network/training_set.hpp"

namespace host {

/// What a general network is trained and judged on. Sizes, angles and offsets are continuous, so no
/// pair is one of a cube with square patches.
enum class PairFamily {
  free,      ///< two planar quads in the unit cube, convex or concave, rho spread over decades
  edge,      ///< patches of two adjoining walls that share a whole edge
  touching,  ///< the same with different meshes: part of an edge in common
  corner,    ///< the next patches along the edge: one vertex in common
  room,      ///< any two patches of two adjoining or opposite meshed walls
  rotated,   ///< rectangle and parallelogram, freely turned, next to each other
};
inline constexpr int kPairFamilies = 6;

struct PolygonPair {
  Polygon p, q;
  PairFamily family = PairFamily::free;
};

/// Streams of pairs that have none in common, for one seed of a training.
enum class PairUse { training, validation, test };

/// The seed for general_pair().
std::uint64_t general_seed(std::uint64_t training_seed, PairUse use);

/// Pair number `index` of a family: the same for the same seed, whatever is asked for besides.
PolygonPair general_pair(PairFamily family, std::uint64_t seed, std::uint64_t index);

/// Above it a general net hands over to the exact sum.
inline constexpr double kGeneralNearRho = 0.3;

/// The pair as a sample (weight 1, target against the moment kernel). False when engine or
/// reference sees no exchange, and for pairs that a general net hands over.
bool sample_of(const PolygonPair& pair, double far_rho, Sample* sample);

/// Training and validation sets of the general network, on all cores; `scale` 1 is about 60,000
/// pairs. Validation and test pairs are configurations of their own.
struct GeneralDataset {
  TrainingSet training, validation;
};
GeneralDataset general_dataset(double far_rho, std::uint64_t seed, double scale, int threads);

}  // namespace host
