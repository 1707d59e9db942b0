// Polygons as text: "x y z;x y z;x y z|x y z;..." - vertices, then holes after bars.
#pragma once
#include <string>
#include <string_view>

#include "geometry/validate.hpp"

namespace host {

struct ParsedPolygon {
  Polygon polygon;
  PolygonStatus status = PolygonStatus::ok;  // ok or the first thing wrong, text and geometry
};

/// Reads three numbers a vertex, blanks between. "nan" and "inf" are numbers here, and so is 1e999;
/// what they make of the polygon is `validate`'s to say. Returns false when the text is not of that
/// form.
bool read_polygon(std::string_view text, Polygon* polygon);

/// read_polygon and validate.
ParsedPolygon parse_polygon(std::string_view text);

/// The text of a polygon, as few digits as give the same doubles when read.
std::string write_polygon(const Polygon& polygon);

}  // namespace host
