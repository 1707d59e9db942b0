#include "radiosity_power.hpp"
#include "urad/patch.hpp"
#include "urad/radiosity.hpp"

namespace urad {

namespace {

/// r g as UQ16.16, of the channel where it is largest: no channel is thought done too early.
uint64_t bounces_uq16(const Radiosity& s) noexcept {
  uint64_t most = 0;
  for (int c = 0; c < 3; ++c) {
    const uint32_t r_uq16 = effective_reflectance_uq16(s, c);
    const uint64_t bounces = wide_umul(r_uq16, gain_uq16(r_uq16)) >> 16;
    if (bounces > most) most = bounces;
  }
  return most;
}

/// Power over area as exitance. The power may be a sum of two 32-bit values.
[[gnu::noinline]] int64_t exitance_of(const Radiosity& s, int64_t power,
                                      int32_t log2_area_q24) noexcept {
  return times_exp2(power, -(int64_t{log2_area_q24} + s.scene->log2_power_q24));
}

[[gnu::noinline]] int64_t ambient_of(const Radiosity& s, int channel) noexcept {
  // |unshot| of all patches may pass 32 bits on hostile states; such an ambient term saturates
  // anyway.
  const int64_t unshot = saturate_i32(s.ledger.unshot[channel]);
  const int64_t mean = exitance_of(s, unshot, s.log2_area_q24);
  const uint32_t gain = gain_uq16(effective_reflectance_uq16(s, channel));
  return round_shift(int64_t{saturate_i32(mean)} * gain, 16);
}

[[gnu::noinline]] int64_t radiosity_of(const Radiosity& s, uint16_t patch, int channel) noexcept {
  const urad_surface& surface = s.scene->surface[surface_of(*s.scene, patch)];
  const uint32_t at = 3u * patch + uint32_t(channel);
  return exitance_of(s, int64_t{s.shot[at]} + s.unshot[at],
                     log2_area_of(surface, uint32_t(patch - surface.first_patch)));
}

}  // namespace

int64_t times_exp2(int64_t value, int64_t x_q24) noexcept {
  constexpr int64_t kMost = int64_t{1} << 62;
  const uint64_t product = magnitude(value) * exp2_uq(int32_t(x_q24 & 0xFFFFFF), 30);
  const int64_t down = 30 - shift_down(x_q24, 24);
  uint64_t scaled = 0;
  if (down > 0) {
    if (down < 64) scaled = (product + (uint64_t{1} << (down - 1))) >> down;
  } else if (product != 0) {
    scaled = top_bit(product) - down >= 62 ? uint64_t(kMost) : product << -down;
  }
  return value < 0 ? -int64_t(scaled) : int64_t(scaled);
}

uint32_t radiosity_error_uq32(const Radiosity& s) noexcept {
  uint64_t one_way = 0, reflected = 0;
  for (int c = 0; c < 3; ++c) {
    one_way += magnitude(s.ledger.unshot[c]);
    reflected += magnitude(s.reflected[c]);
  }
  const uint64_t unshot = one_way + (3 * (s.remaining - one_way) >> 3);
  // unshot < 2^48 and bounces < 2^26; once it passes 2^37 its low bits do not matter to a ratio.
  const int drop = unshot >> 37 ? 16 : 0;
  const uint64_t to_come = (((unshot >> drop) * bounces_uq16(s)) >> 16) << drop;
  const uint64_t safe = to_come + (to_come >> 1);
  return safe ? exp2_uq(log2_q24(safe) - log2_q24(reflected + to_come), 32) : 0;
}

bool radiosity_done(const Radiosity& s, uint32_t error_uq32) noexcept {
  return s.status != URAD_OK || (s.flags & kMoving) || radiosity_error_uq32(s) <= error_uq32;
}

int32_t radiosity_get(const Radiosity& s, uint16_t patch, int channel) noexcept {
  return saturate_i32(radiosity_of(s, patch, channel));
}

int32_t radiosity_ambient(const Radiosity& s, int channel) noexcept {
  return saturate_i32(ambient_of(s, channel));
}

int32_t radiosity_display(const Radiosity& s, uint16_t patch, int channel) noexcept {
  const urad_surface& surface = s.scene->surface[surface_of(*s.scene, patch)];
  const int64_t reflectance_uq15 = s.scene->material[surface.material].reflectance_uq15[channel];
  const int64_t ambient = saturate_i32(ambient_of(s, channel));
  return saturate_i32(radiosity_of(s, patch, channel) +
                      round_shift(reflectance_uq15 * ambient, 15));
}

bool radiosity_audit(const Radiosity& s, Ledger* ledger) noexcept {
  const uint32_t n = s.scene->patch_count;
  Ledger recount = s.ledger;
  bool holds = true;
  for (uint32_t c = 0; c < 3; ++c) {
    recount.unshot[c] = 0;
    for (uint32_t k = 0; k < n; ++k) recount.unshot[c] += s.unshot[3 * k + c];
    holds = holds && recount.unshot[c] == s.ledger.unshot[c] &&
            recount.emitted[c] == recount.absorbed[c] + recount.unshot[c] + recount.escaped[c];
  }
  if (ledger) *ledger = recount;
  return holds;
}

}  // namespace urad
