// radiosity_change.hpp -- unshot power that is written from outside of a shot.
#pragma once
#include "radiosity_power.hpp"

namespace urad {

inline uint64_t key_of(const int32_t* unshot) noexcept {
  return uint64_t{magnitude(unshot[0])} + magnitude(unshot[1]) + magnitude(unshot[2]);
}

/// Unshot power of a patch with `delta` more of it.
struct Changed {
  int64_t unshot[3];
  bool fits;
};

inline Changed changed(const urad_radiosity& s, uint32_t patch, const int64_t* delta) noexcept {
  Changed result{{0, 0, 0}, true};
  uint64_t key = 0;
  for (uint32_t c = 0; c < 3; ++c) {
    result.unshot[c] = s.unshot[3 * patch + c] + delta[c];
    key += magnitude(result.unshot[c]);
  }
  result.fits = key < URAD_POWER_LIMIT;
  return result;
}

inline void write(urad_radiosity* s, uint32_t patch, const Changed& to) noexcept {
  int32_t* const unshot = s->unshot + 3 * patch;
  s->remaining -= key_of(unshot);
  for (uint32_t c = 0; c < 3; ++c) {
    s->ledger.unshot[c] += to.unshot[c] - unshot[c];
    unshot[c] = int32_t(to.unshot[c]);
  }
  s->remaining += key_of(unshot);
}

/// The guard looks at the new light from its start.
inline void begin_again(urad_radiosity* s) noexcept {
  s->flags |= kStale;
  s->window_shots = 0;
  s->window_strikes = 0;
  s->window_remaining = s->remaining;
}

}  // namespace urad
