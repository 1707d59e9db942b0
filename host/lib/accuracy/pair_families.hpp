// Polygon pairs to measure on: simple shapes, the free quadrilaterals of [Martin 1996], and the
// families on which programs return NaN, negative or plainly wrong factors.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "network/general_pairs.hpp"
#include "network/random.hpp"

namespace host {

/// w x h rectangle in the plane z, lit side up, one corner at (x, y).
Polygon rectangle(double w, double h, double z = 0, double x = 0, double y = 0);

/// Lit from the other side. For polygons without holes.
Polygon flipped(const Polygon& polygon);

/// Inscribed in a circle about the z axis, lit side up.
Polygon regular_polygon(int corners, double radius, double z);

/// A floor of depth w and a wall of height h, hinged along an edge of length l at an inner angle in
/// degrees.
PolygonPair hinge(double degrees, double w = 1, double h = 1, double l = 1);

/// [Martin 1996, 3.2]: a random point and a random plane of the unit cube, then a random walk in
/// that plane until four vertices make a polygon that does not cross itself; often concave. Here
/// with an area of at least 1e-4.
Polygon random_quad(Random& random);

bool is_concave(const Polygon& quad);

/// Two such quads, each wholly in front of the other's plane (by 1e-3 at least).
PolygonPair random_facing_quads(Random& random);

struct DegenerateFamily {
  std::string name;
  std::function<PolygonPair(Random&)> draw;
};

/// Shared edges at all angles, shared vertices, almost parallel squares, repeated vertices.
std::vector<DegenerateFamily> degenerate_families();

/// Both polygons times `factor`.
PolygonPair scaled(const PolygonPair& pair, double factor);

}  // namespace host
