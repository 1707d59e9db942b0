// radiosity_power.hpp -- between exitance and power, for the files of the solver.
#pragma once
#include "urad/log2.hpp"
#include "urad/radiosity.h"
#include "urad/scene.h"

namespace urad {

/// value * 2^x, rounded, for |value| < 2^33; saturates at 2^62. Relative error of 2^x: 1e-6.
int64_t times_exp2(int64_t value, int64_t x_q24) noexcept;

constexpr int32_t saturate_i32(int64_t x) noexcept {
  return x > INT32_MAX ? INT32_MAX : x < -INT32_MAX ? -INT32_MAX : int32_t(x);
}

/// Reflectance of the scene as light meets it: mean reflectance times the share that does not
/// escape. UQ16.16, <= 1.
constexpr uint32_t effective_reflectance_uq16(const urad_radiosity& s, int channel) noexcept {
  return uint32_t(wide_umul(s.reflectance_uq16[channel], s.closure_uq16) >> 16);
}

/// 1 / (1 - r) as UQ16.16, at most 1024: all bounces together.
constexpr uint32_t gain_uq16(uint32_t reflectance_uq16) noexcept {
  const uint32_t absorbing = reflectance_uq16 < 65536u - 64u ? 65536u - reflectance_uq16 : 64u;
  return exp2_uq((16 << 24) - log2_q24(absorbing), 16);
}

/// Total area and mean reflectances, from the scene as it is.
void measure_scene(urad_radiosity* state) noexcept;

/// In urad_radiosity.flags: `shooter` is out of date.
inline constexpr uint8_t kStale = 128;
/// The same: what changed last made as much darker as brighter.
inline constexpr uint8_t kTwoWays = 32;
/// The same: light between touched patches is taken away, radiosity_move_end() is to follow.
inline constexpr uint8_t kMoving = 64;

/// Power of an exitance on a patch.
inline int64_t power_of(const urad_scene& scene, int32_t exitance, int32_t log2_area_q24) noexcept {
  return times_exp2(exitance, int64_t{log2_area_q24} + scene.log2_power_q24);
}

inline int32_t log2_area_of(const urad_surface& surface, uint32_t place) noexcept {
  return surface.grid ? surface.grid->shape.log2_area_q24
                      : surface.polygon[place].shape.log2_area_q24;
}

}  // namespace urad
