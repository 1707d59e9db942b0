// Small scenes built by hand, for tests of what a person sees.
#pragma once
#include <array>

#include "scene/scene.hpp"

namespace test {

using host::Vec3;

/// Appends a wall of count x count patches spanned by `u` and `v` from `origin`, lit side along u x
/// v.
inline void add_wall(host::Scene* scene, const char* name, const Vec3& origin, const Vec3& u,
                     const Vec3& v, int count, const Vec3& reflectance, const Vec3& exitance) {
  host::Surface wall;
  wall.name = name;
  wall.material = int(scene->materials.size());
  wall.first_patch = int(scene->patches.size());
  wall.patch_count = count * count;
  const host::Grid grid{origin, u / double(count), v / double(count), count, count};
  wall.grid = grid;
  scene->materials.push_back({name, reflectance, exitance});
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const Vec3 a = origin + double(i) * grid.step_u + double(j) * grid.step_v;
      host::ScenePatch patch;
      patch.polygon.outer = {a, a + grid.step_u, a + grid.step_u + grid.step_v, a + grid.step_v};
      patch.moments = host::moments(patch.polygon);
      patch.surface = int(scene->surfaces.size());
      scene->patches.push_back(patch);
    }
  scene->surfaces.push_back(wall);
}

/// The unit cube, seen from behind its luminous wall at z = 0: red to the left, blue to the right.
inline host::Scene cube(int count) {
  host::Scene scene;
  scene.name = "cube";
  const Vec3 white(0.75), red(0.75, 0.1, 0.1), blue(0.1, 0.1, 0.75), dark(0);
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0);
  add_wall(&scene, "floor", o, z, x, count, white, dark);
  add_wall(&scene, "ceiling", y, x, z, count, white, dark);
  add_wall(&scene, "red", x, z, y, count, red, dark);
  add_wall(&scene, "blue", o, y, z, count, blue, dark);
  add_wall(&scene, "back", z, y, x, count, white, dark);
  add_wall(&scene, "lamp", o, x, y, count, dark, Vec3(1));
  scene.convex = scene.closed = true;
  // Looking along +z with y up, +x is to the left.
  scene.camera = {{0.5, 0.5, -1.25}, {0.5, 0.5, 1}, {0, 1, 0}, 46};
  return scene;
}

/// The surface a patch lies on, by name.
inline const std::string& wall_of(const host::Scene& scene, std::size_t patch) {
  return scene.surfaces[std::size_t(scene.patches[patch].surface)].name;
}

}  // namespace test
