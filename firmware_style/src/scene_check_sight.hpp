// scene_check_sight.hpp -- bounds of blockers and exported visibility, as bytes that are not trusted.
#pragma once
#include "urad/scene.h"

namespace urad {

/// Boxes that hold what they say, in an order that a walk past them ends in; rows of codes that end
/// with the last patch, inside the table.
bool good_sight(const urad_scene& scene) noexcept;

}  // namespace urad
