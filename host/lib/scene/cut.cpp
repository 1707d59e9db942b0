#include "scene/cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "geometry/triangulate.hpp"
#include "geometry/validate.hpp"
#include "scene/grid_detect.hpp"

namespace host {
namespace {

constexpr double kExact = 1e-14;  // of the size: planar already, keep the file's own bits
constexpr double kPlanar = 1e-4;  // of the size: further off is no rounding of the file

int cuts(double length, double patch_size) {
  return int(std::clamp(std::ceil(length / patch_size * (1 - 1e-9)), 1.0, 1e6));
}

// Cuts along the first and the last edge of a quad; for triangles only the larger counts.
std::array<int, 2> counts_of(const Face& face, const MeshOptions& options) {
  if (options.subdivide > 0) return {options.subdivide, options.subdivide};
  if (options.patch_size <= 0) return face.counts;
  const Loop& p = face.polygon.outer;
  const auto edge = [&](std::size_t a, std::size_t b) { return glm::length(p[b] - p[a]); };
  if (p.size() == 4)
    return {cuts(std::max(edge(0, 1), edge(3, 2)), options.patch_size),
            cuts(std::max(edge(0, 3), edge(1, 2)), options.patch_size)};
  double longest = 0;
  if (p.size() == 3)
    longest = std::max({edge(0, 1), edge(1, 2), edge(2, 0)});
  else
    longest = size_of(p);
  const int n = cuts(longest, options.patch_size);
  return {n, n};
}

void cut_triangle(const Triangle& t, int n, std::vector<Polygon>* out) {
  const auto at = [&](int i, int j) {
    return t[0] + (double(i) / n) * (t[1] - t[0]) + (double(j) / n) * (t[2] - t[0]);
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i + j < n; ++i) {
      out->push_back({{at(i, j), at(i + 1, j), at(i, j + 1)}, {}});
      if (i + j < n - 1) out->push_back({{at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, {}});
    }
}

void cut_quad(const Loop& p, int count_u, int count_v, std::vector<Polygon>* out) {
  const auto at = [&](int i, int j) {
    const double u = double(i) / count_u, v = double(j) / count_v;
    return (1 - v) * ((1 - u) * p[0] + u * p[1]) + v * ((1 - u) * p[3] + u * p[2]);
  };
  for (int j = 0; j < count_v; ++j)
    for (int i = 0; i < count_u; ++i)
      out->push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, {}});
}

}  // namespace

double size_of(const Loop& loop) {
  Vec3 low = loop.front(), high = low;
  for (const Vec3& x : loop) low = glm::min(low, x), high = glm::max(high, x);
  return glm::length(high - low);
}

Piece cut_face(const Face& face, const MeshOptions& options, std::size_t* total) {
  const auto [count_u, count_v] = counts_of(face, options);
  const int n = std::max(count_u, count_v);
  const Loop& p = face.polygon.outer;
  const bool triangle = p.size() == 3 && face.polygon.holes.empty();
  const bool quad = is_convex_quad(face.polygon);
  std::vector<Triangle> triangles;
  if (triangle) triangles = {{p[0], p[1], p[2]}};
  if (!triangle && !quad && n > 1) triangles = triangulate(face.polygon);

  const double here = quad                ? double(count_u) * count_v
                      : triangles.empty() ? 1
                                          : double(triangles.size()) * n * n;
  if (here + double(*total) > kMaxPatches)
    throw Error(fmt::format(
        "{}: with this face the scene has more than {} patches; take a smaller --subdivide or a "
        "larger --patch-size",
        face.where, kMaxPatches));
  *total += std::size_t(here);
  Piece piece;
  piece.grid = parallelogram(face.polygon);
  if (piece.grid) {
    piece.grid->count_u = count_u, piece.grid->count_v = count_v;
    piece.grid->step_u /= double(count_u), piece.grid->step_v /= double(count_v);
  } else if (quad) {
    cut_quad(p, count_u, count_v, &piece.patches);
  } else if (!triangles.empty()) {
    for (const Triangle& t : triangles) cut_triangle(t, n, &piece.patches);
  } else {
    piece.patches.push_back(face.polygon);
  }
  return piece;
}

Polygon checked_polygon(const Polygon& polygon, const std::string& where) {
  const std::size_t vertices = polygon.outer.size();
  if (vertices > kMaxPolygonVertices)
    throw Error(fmt::format("{}: a face with {} vertices; {} is the most, cut it into smaller ones",
                            where, vertices, kMaxPolygonVertices));
  const auto fail = [&](const char* what) { throw Error(where + ": " + what); };
  const auto explain = [&](PolygonStatus status) {
    switch (status) {
      case PolygonStatus::ok:
        return;
      case PolygonStatus::invalid_syntax:
        return fail("the polygon is not of the form 'x y z;x y z;x y z'");
      case PolygonStatus::invalid_nan:
        return fail("the face has a coordinate that is not a number (nan)");
      case PolygonStatus::invalid_infinite:
        return fail("the face has an infinite coordinate");
      case PolygonStatus::invalid_too_few_vertices:
        return fail("the face has fewer than 3 vertices");
      case PolygonStatus::invalid_repeated_vertex:
        return fail("the face has two equal vertices in a row; leave one out");
      case PolygonStatus::invalid_zero_area:
        return fail("the face has zero area; remove it");
      case PolygonStatus::invalid_non_planar:
        return fail("the face is not planar; cut it into triangles");
      case PolygonStatus::invalid_self_crossing:
        return fail("the edges of the face cross each other");
    }
  };
  const PolygonStatus given = validate(polygon);
  if (given != PolygonStatus::ok && given != PolygonStatus::invalid_non_planar) explain(given);

  const Moments plane = moments(polygon);
  Polygon flat = polygon;
  const double limit = kPlanar * size_of(polygon.outer);
  double worst = 0;
  const auto flatten = [&](Loop* loop) {
    for (Vec3& x : *loop) {
      const double height = glm::dot(plane.normal, x - plane.centroid);
      worst = std::max(worst, std::abs(height));
      x -= height * plane.normal;
    }
  };
  flatten(&flat.outer);
  for (Loop& hole : flat.holes) flatten(&hole);
  if (!(worst <= limit))
    throw Error(fmt::format(
        "{}: the face is not planar: a vertex lies {:.3g} from its plane; cut it into triangles",
        where, worst));
  if (worst <= kExact * size_of(polygon.outer)) return polygon;
  explain(validate(flat));
  return flat;
}

}  // namespace host
