// Which polygons can stand between patches, and whether light can leave the scene.
#pragma once
#include <vector>

#include "scene/scene.hpp"

namespace host {

/// Of `polygons`, those whose plane has patches (of scene.patches) on both sides. All others never
/// block: a segment between patches stays on one side of them. A room's wall is none; a scene
/// without any needs no visibility at all. Of two polygons back to back, a two-sided sheet, only the
/// first is kept. "On a side" is further from the plane than 1e-5 of the
/// distance to the polygon's centre.
std::vector<Blocker> find_blockers(const Scene& scene, const std::vector<Blocker>& polygons);

/// Whether every one of a fixed set of rays from every patch (16 to 256 a patch, over patch and
/// hemisphere) meets the lit side of one of `polygons`: then each row of form factors sums to 1.
bool is_closed(const Scene& scene, const std::vector<Blocker>& polygons);

}  // namespace host
