// A hierarchy of boxes around blockers, as the engine walks it (urad_bounds).
#pragma once
#include <vector>

#include "urad/scene.h"

namespace host {

/// Puts the blockers into an order in which neighbours are near each other, and boxes around ranges of
/// them, whole before part: split where the sum of surface times count is least. Ranges of fewer than
/// three blockers have no box of their own. Empty for so few blockers.
std::vector<urad_bounds> make_bounds(std::vector<urad_blocker>* blockers);

}  // namespace host
