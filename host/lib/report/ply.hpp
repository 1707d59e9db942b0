// Vertex-coloured PLY: a solved scene for mesh viewers and game tools.
#pragma once
#include <string>

#include "report/smooth.hpp"

namespace host {

/// Binary little-endian PLY of the smooth colours. Per vertex: float x, y, z (the file's unit);
/// uchar red, green, blue (sRGB, `white` as from white_level() = 255); float radiosity_red,
/// radiosity_green, radiosity_blue (unclamped). Per face: its corners (quad or triangle),
/// counter-clockwise from the lit side, and int patch.
std::string ply(const Scene& scene, const CornerMesh& mesh, const std::vector<Vec3>& radiosity,
                double white);

}  // namespace host
