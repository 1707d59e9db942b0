// From the faces of a file to a scene.
#pragma once
#include <string>
#include <vector>

#include "scene/cut.hpp"

namespace host {

struct Meshed {
  Scene scene;
  std::vector<std::size_t> face_of_patch;
};

/// Cuts every face (cut.hpp), groups the patches into planar surfaces (planes.hpp; a grid where
/// they tile one), and finds blockers, flags and a camera. Tables keep the order of the faces.
/// Throws Error: both options set or out of range; a bad polygon; no face that emits light; fewer
/// than 2 or more than kMaxPatches patches.
Meshed mesh_faces(const std::string& name, std::vector<Material> materials,
                  const std::vector<Face>& faces, const MeshOptions& options);

}  // namespace host
