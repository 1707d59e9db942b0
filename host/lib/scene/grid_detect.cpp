#include "scene/grid_detect.hpp"

#include <algorithm>
#include <cmath>

namespace host {
namespace {

// Files carry six decimals or so: corners that miss by this part of the size are meant to meet.
constexpr double kFileRounding = 1e-5;

Vec3 centre(const Grid& cell) { return cell.origin + 0.5 * (cell.step_u + cell.step_v); }

bool close(const Vec3& a, const Vec3& b, double tolerance) {
  return glm::length(a - b) <= tolerance;
}

// Edges equal to (u, v), (-u, -v), (v, -u) or (-v, u): the same tile from another first corner.
bool same_tile(const Grid& a, const Grid& b, double tolerance) {
  const auto is = [&](const Vec3& u, const Vec3& v) {
    return close(b.step_u, u, tolerance) && close(b.step_v, v, tolerance);
  };
  return is(a.step_u, a.step_v) || is(-a.step_u, -a.step_v) || is(a.step_v, -a.step_u) ||
         is(-a.step_v, a.step_u);
}

struct Cell {
  int u, v;
  std::size_t index;
};

// Lattice coordinates of x - origin in the basis (a, b).
glm::dvec2 coordinates(const Vec3& x, const Vec3& a, const Vec3& b) {
  const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b);
  const double xa = glm::dot(x, a), xb = glm::dot(x, b);
  const double det = aa * bb - ab * ab;
  return {(xa * bb - xb * ab) / det, (xb * aa - xa * ab) / det};
}

}  // namespace

std::optional<Grid> parallelogram(const Polygon& polygon) {
  if (polygon.outer.size() != 4 || !polygon.holes.empty()) return std::nullopt;
  const Loop& p = polygon.outer;
  const double size = std::min(glm::length(p[2] - p[0]), glm::length(p[3] - p[1]));
  if (!close(p[0] + p[2], p[1] + p[3], kFileRounding * size)) return std::nullopt;
  Grid grid;
  grid.step_u = 0.5 * ((p[1] - p[0]) + (p[2] - p[3]));
  grid.step_v = 0.5 * ((p[3] - p[0]) + (p[2] - p[1]));
  grid.origin = 0.25 * (p[0] + p[1] + p[2] + p[3]) - 0.5 * (grid.step_u + grid.step_v);
  if (p[0] + p[2] == p[1] + p[3]) grid = {p[0], p[1] - p[0], p[3] - p[0], 1, 1};
  return grid;
}

std::optional<DetectedGrid> detect_grid(const std::vector<Polygon>& polygons) {
  std::vector<Grid> tiles;
  for (const Polygon& polygon : polygons) {
    const auto tile = parallelogram(polygon);
    if (!tile) return std::nullopt;
    tiles.push_back(*tile);
  }
  if (tiles.empty()) return std::nullopt;
  const Grid& first = tiles.front();
  const double size = std::min(glm::length(first.step_u), glm::length(first.step_v));
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    if (!same_tile(first, tiles[k], 2 * kFileRounding * size)) return std::nullopt;
    const auto at = coordinates(centre(tiles[k]) - centre(first), first.step_u, first.step_v);
    if (std::abs(at.x) > 65535 || std::abs(at.y) > 65535) return std::nullopt;
    cells.push_back({int(std::lround(at.x)), int(std::lround(at.y)), k});
  }
  std::sort(cells.begin(), cells.end(),
            [](const Cell& a, const Cell& b) { return a.v != b.v ? a.v < b.v : a.u < b.u; });
  DetectedGrid found;
  Grid& grid = found.grid;
  grid.count_u = cells.back().u - cells.front().u + 1;
  grid.count_v = cells.back().v - cells.front().v + 1;
  if (grid.count_u < 1 || std::size_t(grid.count_u) * std::size_t(grid.count_v) != cells.size())
    return std::nullopt;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (cells[k].u - cells.front().u != int(k) % grid.count_u) return std::nullopt;
    if (cells[k].v - cells.front().v != int(k) / grid.count_u) return std::nullopt;
    found.order.push_back(cells[k].index);
  }
  // Steps from the far ends: the rounding of one tile's edges must not add up over the grid.
  const auto at = [&](int u, int v) {
    return centre(tiles[found.order[std::size_t(v) * std::size_t(grid.count_u) + std::size_t(u)]]);
  };
  const int last_u = grid.count_u - 1, last_v = grid.count_v - 1;
  grid.step_u = last_u > 0 ? (at(last_u, 0) - at(0, 0)) / double(last_u) : first.step_u;
  grid.step_v = last_v > 0 ? (at(0, last_v) - at(0, 0)) / double(last_v) : first.step_v;
  grid.origin = at(0, 0) - 0.5 * (grid.step_u + grid.step_v);
  for (int v = 0; v < grid.count_v; ++v)
    for (int u = 0; u < grid.count_u; ++u) {
      const Vec3 expected = grid.origin + (u + 0.5) * grid.step_u + (v + 0.5) * grid.step_v;
      if (!close(at(u, v), expected, kFileRounding * size)) return std::nullopt;
    }
  return found;
}

Polygon grid_patch(const Grid& grid, int u, int v) {
  const auto corner = [&](int i, int j) {
    return grid.origin + double(u + i) * grid.step_u + double(v + j) * grid.step_v;
  };
  return {{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, {}};
}

Polygon grid_outline(const Grid& grid) {
  const Vec3 u = double(grid.count_u) * grid.step_u;
  const Vec3 v = double(grid.count_v) * grid.step_v;
  return {{grid.origin, grid.origin + u, grid.origin + u + v, grid.origin + v}, {}};
}

}  // namespace host
