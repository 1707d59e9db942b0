// Which faces share a plane.
#pragma once
#include <vector>

#include "scene/cut.hpp"

namespace host {

/// Faces that become one surface, as indices.
struct FaceGroup {
  int material = 0;
  std::vector<std::size_t> faces;
};

/// Faces of one plane, looking the same way, and of one material form one group, wherever in the
/// plane they are: no light passes between them. Faces cut into grids of several patches stay
/// alone: a grid is stored in a few bytes. Groups and the faces in them are in the order of the
/// file. One piece per face; at least one face.
std::vector<FaceGroup> group_faces(const std::vector<Face>& faces,
                                   const std::vector<Piece>& pieces);

}  // namespace host
