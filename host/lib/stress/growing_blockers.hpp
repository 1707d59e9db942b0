// A blocker between two patches that grows: what they exchange must fall.
#pragma once
#include "method/nets.hpp"
#include "network/general_pairs.hpp"
#include "stress/attack.hpp"

namespace host {

/// The unobstructed factor, then that past ever greater stars in the middle, by sampling, rays, item
/// buffer and both (which is shown, not held to it).
void check_growing_blockers(const PolygonPair& pair, const NetChoice& nets, Findings* findings);

}  // namespace host
