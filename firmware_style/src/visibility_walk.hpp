// visibility_walk.hpp -- blockers of a scene, past the boxes that are out of reach.
#pragma once
#include "urad/scene.h"

namespace urad {

/// Calls visit(number) for the blockers in order, until it says false. missed(low, high) tells of a box
/// that nothing in it matters. No stack: a box that is missed names the one to go on with. Scenes
/// without boxes are walked one by one.
template <class Missed, class Visit>
void walk_blockers(const urad_scene& scene, Missed missed, Visit visit) noexcept {
  const uint16_t boxes = scene.abi >= URAD_SCENE_ABI_SIGHT ? scene.bounds_count : uint16_t{0};
  uint16_t box = 0, blocker = 0;
  while (blocker < scene.blocker_count) {
    if (box < boxes && scene.bounds[box].first <= blocker) {
      const urad_bounds& bounds = scene.bounds[box];
      const bool past = missed(bounds.low, bounds.high);
      box = past ? bounds.next : uint16_t(box + 1);
      if (past) blocker = bounds.end;
      continue;
    }
    if (!visit(blocker)) return;
    ++blocker;
  }
}

}  // namespace urad
