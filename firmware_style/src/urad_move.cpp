// urad_move.cpp -- the C interface of move.hpp.
#include "urad/move.hpp"

extern "C" {

urad_status urad_radiosity_move_begin(urad_radiosity* state, urad_move* move) {
  return urad_status(urad::radiosity_move_begin(state, move));
}

urad_status urad_radiosity_move_end(urad_radiosity* state, urad_move* move, const urad_scene* scene,
                                    const urad_source* source) {
  return urad_status(urad::radiosity_move_end(state, move, scene, source));
}

urad_status urad_blocker_make(const urad_grid* grid, urad_point* vertex, urad_blocker* blocker) {
  if (!grid || !vertex || !blocker) return URAD_BAD_ARGUMENT;
  urad::blocker_make(*grid, vertex, blocker);
  return URAD_OK;
}

urad_status urad_bounds_fit(urad_bounds* bounds, uint16_t count, const urad_blocker* blocker) {
  if (!bounds || !blocker) return URAD_BAD_ARGUMENT;
  urad::bounds_fit(bounds, count, blocker);
  return URAD_OK;
}

}  // extern "C"
