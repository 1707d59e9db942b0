// Finds the affine grid that a set of parallelograms tiles.
#pragma once
#include <optional>
#include <vector>

#include "scene/scene.hpp"

namespace host {

/// The quad as a 1 x 1 grid when it is a parallelogram within 1e-5 of its shorter diagonal;
/// opposite edges are averaged.
std::optional<Grid> parallelogram(const Polygon& polygon);

struct DetectedGrid {
  Grid grid;
  std::vector<std::size_t>
      order;  ///< order[v * count_u + u] = index of the polygon that lies there
};

/// The grid whose patches are exactly `polygons`, each once, in any order and from any first
/// corner. u runs along the first edge of the first polygon.
std::optional<DetectedGrid> detect_grid(const std::vector<Polygon>& polygons);

/// Corners of patch (u, v), counter-clockwise, and of the whole grid.
Polygon grid_patch(const Grid& grid, int u, int v);
Polygon grid_outline(const Grid& grid);

}  // namespace host
