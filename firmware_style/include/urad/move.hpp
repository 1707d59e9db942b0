// move.hpp -- geometry that moves during a solve: only the factors of touched pairs are made again.
//
// What patch i has reflected is rho_i sum_j F_ji S_j, S_j the power that j has shot. When F changes,
//
//   unshot_i += rho_i sum_j (F'_ji - F_ji) S_j      over touched pairs only
//
// turns the present state into one of the new geometry, as signed shots do for light that changes
// [Chen 1990]; no light is lost, and the steps that follow shoot the difference. A pair is touched
// when one end has moved, or when the hull of its two bounding boxes meets the box of a moved
// blocker, where it was or where it is. F_ij A_i = F_ji A_j: each pair is asked for once a look.
#pragma once
#include "urad/move.h"
#include "urad/status.hpp"

namespace urad {

using Move = urad_move;
using Box = urad_box;

/// Takes the light between touched patches away, in the geometry as it is. urad/move.h has the whole
/// contract.
///
/// What is not reflected leaves or joins `absorbed` in the ledger, and all of it joins or leaves
/// `escaped`: in a closed scene that holds in the end what old and new row sums differ by. Rows that a
/// solve divides by their sum (by at most 2^-8) are taken as they are.
///
/// Cost: a factor and 1,000 instructions a touched pair, 200 for any other.
Status radiosity_move_begin(urad_radiosity* state, Move* move) noexcept;

/// Gives it back in the geometry as it is then. scene, source: may be null.
Status radiosity_move_end(urad_radiosity* state, Move* move, const urad_scene* scene,
                          const urad_source* source) noexcept;

/// *blocker becomes the outline of the grid; vertex: the scene's list.
void blocker_make(const urad_grid& grid, urad_point* vertex, urad_blocker* blocker) noexcept;

/// Boxes of a hierarchy about blockers that have moved.
void bounds_fit(urad_bounds* bounds, uint16_t count, const urad_blocker* blocker) noexcept;

}  // namespace urad
