#include "scene/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "scene/blockers.hpp"
#include "scene/camera.hpp"
#include "scene/grid_detect.hpp"
#include "scene/planes.hpp"

namespace host {
namespace {

class Builder {
 public:
  Builder(const std::vector<Face>& faces, const std::vector<Piece>& pieces)
      : faces_(faces), pieces_(pieces) {}

  void add(const FaceGroup& group) {
    Surface surface;
    surface.material = group.material;
    surface.first_patch = int(scene.patches.size());
    if (group.faces.size() == 1 && pieces_[group.faces[0]].grid) {
      surface.grid = pieces_[group.faces[0]].grid;
      add_grid(*surface.grid, [&](std::size_t) { return group.faces[0]; });
    } else if (const auto found = detect(group)) {
      surface.grid = found->grid;
      add_grid(*surface.grid, [&](std::size_t k) { return group.faces[found->order[k]]; });
    } else {
      for (const std::size_t face : group.faces) add_list(face);
    }
    surface.patch_count = int(scene.patches.size()) - surface.first_patch;
    surface.name = fmt::format("{}_{}", material_name(group.material), scene.surfaces.size());
    scene.surfaces.push_back(surface);
  }

  Scene scene;
  std::vector<std::size_t> face_of_patch;
  std::vector<Blocker> outlines;  // every opaque polygon, whole

 private:
  std::string material_name(int material) const {
    return scene.materials[std::size_t(material)].name;
  }

  std::optional<DetectedGrid> detect(const FaceGroup& group) const {
    std::vector<Polygon> polygons;
    for (const std::size_t face : group.faces) {
      if (!pieces_[face].grid) return std::nullopt;
      polygons.push_back(faces_[face].polygon);
    }
    return detect_grid(polygons);
  }

  void add_patch(const Polygon& polygon, std::size_t face) {
    ScenePatch patch;
    patch.polygon = polygon;
    patch.moments = moments(polygon);
    patch.surface = int(scene.surfaces.size());
    if (!(patch.moments.area > 0))
      throw Error(fmt::format("{}: a patch of this face has no area; cut it less finely",
                              faces_[face].where));
    scene.patches.push_back(patch);
    face_of_patch.push_back(face);
  }

  template <class FaceOf>
  void add_grid(const Grid& grid, const FaceOf& face_of) {
    for (int v = 0; v < grid.count_v; ++v)
      for (int u = 0; u < grid.count_u; ++u)
        add_patch(grid_patch(grid, u, v),
                  face_of(std::size_t(v) * std::size_t(grid.count_u) + std::size_t(u)));
    outlines.push_back({grid_outline(grid), int(scene.surfaces.size())});
  }

  void add_list(std::size_t face) {
    if (const auto& grid = pieces_[face].grid)
      add_patch(grid_patch(*grid, 0, 0), face);
    else
      for (const Polygon& polygon : pieces_[face].patches) add_patch(polygon, face);
    outlines.push_back({faces_[face].polygon, int(scene.surfaces.size())});
  }

  const std::vector<Face>& faces_;
  const std::vector<Piece>& pieces_;
};

// Tables follow the faces of the file, whatever the grouping did.
std::vector<int> file_order(const std::vector<std::size_t>& face_of_patch) {
  std::vector<int> order(face_of_patch.size());
  std::iota(order.begin(), order.end(), 0);
  if (std::is_sorted(face_of_patch.begin(), face_of_patch.end())) return {};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return face_of_patch[std::size_t(a)] < face_of_patch[std::size_t(b)];
  });
  return order;
}

void check_options(const MeshOptions& options) {
  if (options.subdivide != 0 && options.patch_size != 0)
    throw Error("--subdivide and --patch-size exclude each other: give one of them");
  if (options.subdivide < 0 || options.subdivide > 255)
    throw Error(fmt::format("--subdivide must be 1 to 255, not {}", options.subdivide));
  if (!(options.patch_size >= 0) || std::isinf(options.patch_size))
    throw Error(fmt::format("--patch-size must be a positive length, not {}", options.patch_size));
}

}  // namespace

Meshed mesh_faces(const std::string& name, std::vector<Material> materials,
                  const std::vector<Face>& given, const MeshOptions& options) {
  check_options(options);
  if (given.empty()) throw Error(name + ": no faces; a scene needs at least two patches");
  std::vector<Face> faces = given;
  std::vector<Piece> pieces;
  std::size_t total = 0;
  bool light = false;
  for (Face& face : faces) {
    face.polygon = checked_polygon(face.polygon, face.where);
    pieces.push_back(cut_face(face, options, &total));
    light = light || materials[std::size_t(face.material)].exitance != Vec3(0);
  }
  if (total < 2)
    throw Error(faces[0].where +
                ": one patch only in the whole scene; light needs a second one to go to (add a "
                "face or --subdivide)");
  if (!light)
    throw Error(faces[0].where +
                ": no light: neither this face nor any other emits; give one a material with Ke "
                "(emit) > 0");

  Builder builder(faces, pieces);
  builder.scene.name = name;
  builder.scene.materials = std::move(materials);
  for (const FaceGroup& group : group_faces(faces, pieces)) builder.add(group);
  Scene scene = std::move(builder.scene);
  scene.output_order = file_order(builder.face_of_patch);
  scene.blockers = find_blockers(scene, builder.outlines);
  scene.convex = scene.blockers.empty();
  scene.closed = is_closed(scene, builder.outlines);
  scene.camera = default_camera(builder.outlines, scene.closed);
  return {std::move(scene), std::move(builder.face_of_patch)};
}

}  // namespace host
