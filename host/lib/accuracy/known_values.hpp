// Form factors that others have computed: what the reference, hemicubes and rays are held against.
#pragma once
#include <string>
#include <vector>

#include "geometry/polygon.hpp"

namespace host {

/// F from p to q past `blockers` (opaque from both sides; none: unoccluded).
struct KnownValue {
  std::string name;
  Polygon p, q;
  double f = 0;
  double tolerance = 0;  ///< 1e-12, or one unit of the last digit that was printed
  std::vector<Polygon> blockers;
};

/// Parallel, perpendicular, hinged, shifted, concave, many-cornered and clipped polygons: closed
/// forms [Howell, C-11 and C-14] and a double contour integral in 80-bit arithmetic. Among them
/// the pairs of the L-shaped room below that nothing stands between.
std::vector<KnownValue> known_values();

/// Two unit squares with a square half way between them, in a corner and in the middle.
std::vector<KnownValue> known_square_obstructions();

/// All printed factors of the L-shaped room [Pinney & Bean 1988, test 4], by shadow integration
/// good to about 1e-7; every other wall is a blocker.
std::vector<KnownValue> known_l_room();

}  // namespace host
