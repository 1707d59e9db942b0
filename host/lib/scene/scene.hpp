// A scene on the host: patches in double, grouped into surfaces, with materials and blockers.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "geometry/polygon.hpp"

namespace host {

struct Material {
  std::string name;
  Vec3 reflectance{0};  ///< per channel, 0 .. 1
  Vec3 exitance{0};     ///< emitted, in the file's unit
};

/// Emission of a channel that every later sum and unit can hold.
inline bool emission_in_range(double exitance) {
  return exitance == 0 || (exitance >= 1e-30 && exitance <= 1e30);
}

/// Patch (u, v) of a grid is the parallelogram at origin + u step_u + v step_v; number first_patch
/// + v * count_u + u.
struct Grid {
  Vec3 origin, step_u, step_v;
  int count_u = 1, count_v = 1;
};

struct Surface {
  std::string name;
  int material = 0;
  int first_patch = 0, patch_count = 0;
  bool planar = true;        ///< all patches in one plane, facing one way
  std::optional<Grid> grid;  ///< else a list of polygons
};

struct ScenePatch {
  Polygon polygon;
  Moments moments;
  int surface = 0;
};

struct Camera {
  Vec3 eye{0}, target{0}, up{0, 1, 0};
  double field_of_view = 60;  ///< vertical, degrees
  bool mirrored =
      false;  ///< left and right exchanged: scenes with x right, y up, z into the picture
};

struct Blocker {
  Polygon polygon;
  int surface = -1;
};

struct Scene {
  std::string name;
  std::vector<Material> materials;
  std::vector<Surface> surfaces;
  std::vector<ScenePatch> patches;  ///< ordered by surface
  std::vector<Blocker> blockers;    ///< only polygons that can stand between patches
  bool convex = false;              ///< facing pairs always see each other
  bool closed = false;              ///< no light leaves
  Camera camera;
  /// Row k of a table about this scene is patch output_order[k]: the order of the file. Empty: 0,
  /// 1, 2, ...
  std::vector<int> output_order;
  std::vector<std::string>
      patch_names;  ///< by patch: the file's own label. Empty: the row's number

  /// Which patch stands in row `row` of a table, and what the first column calls it.
  std::size_t patch_of_row(std::size_t row) const {
    return output_order.empty() ? row : std::size_t(output_order[row]);
  }
  std::string label_of_row(std::size_t row) const {
    return patch_names.empty() ? std::to_string(row) : patch_names[patch_of_row(row)];
  }
  const Material& material_of(std::size_t patch) const {
    return materials[std::size_t(surfaces[std::size_t(patches[patch].surface)].material)];
  }
};

}  // namespace host
