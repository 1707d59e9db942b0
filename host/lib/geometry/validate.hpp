// Which polygons the command line accepts.
#pragma once
#include <string_view>

#include "geometry/polygon.hpp"

namespace host {

/// In the order in which they are looked for: the first that applies is reported.
enum class PolygonStatus {
  ok,
  invalid_syntax,
  invalid_nan,
  invalid_infinite,
  invalid_too_few_vertices,
  invalid_repeated_vertex,
  invalid_zero_area,
  invalid_non_planar,
  invalid_self_crossing,
};

/// "ok", "invalid_nan", ...
std::string_view name(PolygonStatus status);

/// The first status that applies to `polygon` (its text has been read already). Free of scale and
/// place: "zero" is the rounding of the largest coordinate, "planar" 1e-6 of the box diagonal. A
/// loop must not touch itself; a hole may touch another loop in single points, but lies inside the
/// outer loop and outside the other holes.
PolygonStatus validate(const Polygon& polygon);

/// Status of a pair: that of p unless it is ok, else that of q.
PolygonStatus validate(const Polygon& p, const Polygon& q);

}  // namespace host
