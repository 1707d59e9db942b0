// A camera for scenes that bring none.
#pragma once
#include <vector>

#include "scene/scene.hpp"

namespace host {

/// Looks through the side of the bounding box from which most lit faces show (an open front, or a
/// room whose near wall shows its unlit back and is not drawn); a closed scene is seen from inside.
/// Sides are tried -z, +z, -x, +x, -y, +y and the first of equals wins.
Camera default_camera(const std::vector<Blocker>& polygons, bool closed);

}  // namespace host
