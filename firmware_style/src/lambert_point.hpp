// lambert_point.hpp -- Lambert's sum at one point, in the frame of a pair.
#pragma once
#include "lambert_outline.hpp"

namespace urad {

/// Factor (UQ2.30, 0 .. 2^30) from the element at x with this normal to what the outline holds, all
/// of it above the element's horizon.
uint32_t lambert_sum_uq30(const urad_point& x, const urad_point& normal_q30,
                          const Outline& outline) noexcept;

/// The shift that brings every vertex of the patch, less `origin`, below 2^29.
int frame_shift(const urad_scene& scene, const Patch& patch, const urad_point& origin) noexcept;

}  // namespace urad
