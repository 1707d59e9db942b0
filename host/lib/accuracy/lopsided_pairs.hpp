// Pairs of patches of one kind, from parallelograms to triangles: what moments of third order tell
// apart.
#pragma once
#include "geometry/polygon.hpp"
#include "network/general_pairs.hpp"
#include "network/random.hpp"

namespace host {

struct PatchKind {
  const char* name;
  int corners;
  double least_radius, most_radius;  // of the first corner; of the others 0.5 .. 1
  bool symmetric;
};
inline constexpr PatchKind kPatchKinds[] = {
    {"parallelograms", 4, 0.5, 1, true},
    {"convex quads", 4, 0.5, 1, false},
    {"concave quads", 4, 0.1, 0.3, false},
    {"triangles", 3, 0.5, 1, false},
};

/// The trace of the second moments, an area: rho of a pair is the sum of both over the distance
/// squared.
double squared_size(const Moments& moments);

/// No vertex of the polygon on or behind the plane through the centroid.
bool wholly_in_front(const Polygon& polygon, const Moments& plane);

/// Two of a kind, wholly in front of each other, least_rho <= rho < most_rho.
PolygonPair draw_pair(const PatchKind& kind, double least_rho, double most_rho, Random& random);

}  // namespace host
