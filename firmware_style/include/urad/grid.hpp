// grid.hpp -- a grid of patches from three vectors, on the chip: no exporter needed for simple or
// moving geometry.
#pragma once
#include "urad/scene.h"
#include "urad/status.hpp"

namespace urad {

/// Fills *grid: patch (u, v) has its corner at origin + u step_u + v step_v, lit side along step_u
/// x step_v.
///   Range    every corner within URAD_COORDINATE_MAX, counts at least 1, steps not parallel
///   Error    normal 2^-26, log2 of area and spread 3e-6, spread 2^-15
///   Failure  bad_argument; *grid is then untouched
Status grid_make(const urad_point& origin, const urad_point& step_u, const urad_point& step_v,
                 uint16_t count_u, uint16_t count_v, urad_grid* grid) noexcept;

}  // namespace urad
