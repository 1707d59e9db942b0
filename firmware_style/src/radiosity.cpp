#include "urad/radiosity.hpp"

#include "radiosity_beam.hpp"
#include "radiosity_power.hpp"
#include "radiosity_two_ways.hpp"
#include "urad/patch.hpp"

namespace urad {

namespace {

constexpr uint64_t kOne_uq32 = uint64_t{1} << 32;
constexpr uint64_t kRowMost_uq32 = 3 * (kOne_uq32 / 2) - 65536;  // 1.5, and a little less
constexpr uint64_t kRowSlack_uq32 = kOne_uq32 >> 8;

// Beyond this gain the debts of overshooting grow faster than they are paid back (reflectance 0.99:
// measured).
constexpr uint32_t kOvershootMost_uq16 = 16u << 16;

/// Which unshot power makes a patch the next shooter.
enum class Wanted { any, positive, negative };

template <Wanted kWanted>
[[gnu::always_inline]] inline uint32_t part(int32_t unshot) noexcept {
  if (kWanted == Wanted::any) return magnitude(unshot);
  if (kWanted == Wanted::negative) unshot = -unshot;
  return uint32_t(unshot & ~shift_down(unshot, 31));
}

/// Finds the first patch with the largest part of unshot power; returns the sum of the parts.
template <Wanted kWanted>
[[gnu::noinline]] uint64_t survey_parts(Radiosity* s, uint32_t* largest) noexcept {
  const int32_t* unshot = s->unshot;
  const int32_t* const end = unshot + 3u * s->scene->patch_count;
  const int32_t* at = unshot + 3;
  WideSum sum;
  uint32_t most = 0;
  do {
    const uint32_t key =
        part<kWanted>(unshot[0]) + part<kWanted>(unshot[1]) + part<kWanted>(unshot[2]);
    unshot += 3;
    sum.add(key);
    if (key > most) most = key, at = unshot;
  } while (unshot != end);
  // `at` is one patch on; words / 3 as a product with the inverse of 3 modulo 2^32, exact for
  // multiples of 3.
  s->shooter = uint16_t(uint32_t(at - s->unshot) * 0xAAAAAAABu - 1);
  *largest = most;
  return sum.value();
}

/// Finds the next shooter and the sum of |unshot|. A patch that has overshot waits with unshot
/// power of the other sign for what comes back: it is no candidate as long as the sum over the
/// scene keeps its sign. After a change that goes two ways debts are small beside what is left, and
/// the largest goes first.
void survey(Radiosity* s) noexcept {
  uint32_t most = 0;
  const int64_t all = s->ledger.unshot[0] + s->ledger.unshot[1] + s->ledger.unshot[2];
  if (!(s->flags & URAD_OVERSHOOT) || mostly_nearby(*s)) {
    s->remaining = survey_parts<Wanted::any>(s, &most);
  } else {
    const uint64_t parts = all >= 0 ? survey_parts<Wanted::positive>(s, &most)
                                    : survey_parts<Wanted::negative>(s, &most);
    s->remaining = 2 * parts - magnitude(all);
    // Powers of the other sign are only known by their sum: look closer if that could hide one
    // beyond the limit.
    if (s->remaining - parts >= URAD_POWER_LIMIT) {
      const uint16_t shooter = s->shooter;
      survey_parts<Wanted::any>(s, &most);
      s->shooter = shooter;
    }
  }
  if (most >= URAD_POWER_LIMIT) s->status = URAD_OVERFLOW;
}

/// Unshot power plus, if asked for, the share of the ambient power that will come back to this
/// patch.
[[gnu::noinline]] int32_t shot_power(const Radiosity& s, const urad_surface& surface,
                                     int channel) noexcept {
  const int32_t unshot = s.unshot[3u * s.shooter + uint32_t(channel)];
  if (!(s.flags & URAD_OVERSHOOT)) return unshot;
  const int64_t others = s.ledger.unshot[channel] - unshot;
  const uint64_t all = magnitude(others);
  if (all >> 32) return unshot;
  const int32_t log2_share_q24 =
      log2_area_of(surface, uint32_t(s.shooter - surface.first_patch)) - s.log2_area_q24;
  // Light comes to this patch once: what it sends on again is in the shot already. A patch that is
  // a large part of the scene would else be promised its returns many times.
  const uint32_t rho_uq16 = effective_reflectance_uq16(s, channel);
  const uint32_t own_uq16 = uint32_t(wide_umul(rho_uq16, exp2_uq(log2_share_q24, 16)) >> 16);
  uint32_t gain = gain_uq16(rho_uq16 > own_uq16 ? rho_uq16 - own_uq16 : 0);
  if (s.flags & kTwoWays) gain = two_ways_gain_uq16(s, gain);
  if (gain > kOvershootMost_uq16) gain = kOvershootMost_uq16;
  const uint64_t ambient = (all * gain) >> 16;  // below 2^36
  const uint64_t returns = (ambient * exp2_uq(log2_share_q24, 23)) >> 23;
  const uint64_t share =
      (returns * s.scene->material[surface.material].reflectance_uq15[channel]) >> 15;
  // Within these limits no sum of the shot can leave 32 bits: |unshot - 1.5 shot| < 2^31.
  if (share > URAD_POWER_LIMIT / 2) return unshot;
  const int32_t power = others < 0 ? unshot - int32_t(share) : unshot + int32_t(share);
  return magnitude(power) < URAD_POWER_LIMIT ? power : unshot;
}

/// p * sum / 2^32, rounded.
int64_t handed_out(const Beam& beam, uint64_t sum_uq32) noexcept {
  const uint64_t product = sum_uq32 * beam.mantissa;
  const int down = 32 - beam.exponent;
  return int64_t((product + (uint64_t{1} << (down - 1))) >> down);
}

/// Books a shot whose factors added up to sum_uq32. `keep`: what was not handed out stays with the
/// shooter.
[[gnu::noinline]] void book(Radiosity* s, const Beam* beam, uint64_t sum_uq32, bool keep) noexcept {
  for (uint32_t c = 0; c < 3; ++c) {
    const int64_t power = int64_t{beam[c].mantissa} << beam[c].exponent;
    const int64_t handed = handed_out(beam[c], sum_uq32), taken = keep ? handed : power;
    const int32_t sign = beam[c].negative ? -1 : 1;
    const uint32_t at = 3u * s->shooter + c;
    s->unshot[at] -= sign * int32_t(taken);
    s->shot[at] += sign * int32_t(taken);
    s->reflected[c] += sign * beam[c].reflected;
    s->ledger.unshot[c] += sign * (beam[c].reflected - taken);
    s->ledger.absorbed[c] += sign * (handed - beam[c].reflected);
    s->ledger.escaped[c] += sign * (taken - handed);
  }
}

/// True if the row's remainder stays with the shooter; counts rows that are off.
bool judge_row(Radiosity* s, uint64_t sum_uq32, bool cut) noexcept {
  const bool over = sum_uq32 > kOne_uq32, closed = s->scene->flags & URAD_SCENE_CLOSED;
  const uint64_t off = over ? sum_uq32 - kOne_uq32 : closed ? kOne_uq32 - sum_uq32 : 0;
  urad_radiosity_counters& count = s->counters;
  if ((off >> 16) > count.worst_row_uq16) count.worst_row_uq16 = uint32_t(off >> 16);
  count.rows_over += over;
  count.rows_cut += cut;
  const uint32_t row_uq16 = over ? 65536u : uint32_t(sum_uq32 >> 16);
  s->closure_uq16 = s->closure_uq16 - (s->closure_uq16 >> 4) + (row_uq16 >> 4);
  if (!closed) return over;
  const bool slight = off <= kRowSlack_uq32;
  count.rows_off += !slight;
  return slight;
}

/// Sends one run of factors to its receivers.
void reflect_run(Radiosity* s, Beam* beam, Reflection* to, uint32_t first, uint32_t count,
                 bool dark) noexcept {
  for (uint32_t c = 0; c < 3; ++c) {
    if (beam[c].mantissa == 0 && !(s->flags & URAD_SKIP_OFF_CHANNEL)) {
      s->counters.skipped_channel += count;
    } else if (to[c].mantissa == 0 && beam[c].mantissa != 0 && !(s->flags & URAD_SKIP_OFF_BLACK)) {
      s->counters.skipped_black += count;
    } else if (dark && !(s->flags & URAD_SKIP_OFF_DARK)) {
      s->counters.skipped_dark += count;
    } else {
      int32_t* const unshot = s->unshot + 3u * first + c;
      beam[c].reflected += beam[c].negative ? reflect<true>(s->factors, count, unshot, &to[c])
                                            : reflect<false>(s->factors, count, unshot, &to[c]);
      s->counters.updates += count;
    }
  }
}

/// All runs of the shooter's row. *sum_uq32 counts what was handed out even if the source fails
/// half way.
urad_status shoot(Radiosity* s, const urad_surface& from, Beam* beam, uint64_t* sum_uq32,
                  bool* cut) noexcept {
  const urad_scene& scene = *s->scene;
  const uint32_t receivers = uint32_t{scene.patch_count} - from.patch_count;
  for (uint32_t k = 0; k < scene.surface_count; ++k) {
    const urad_surface& surface = scene.surface[k];
    const urad_material& material = scene.material[surface.material];
    Reflection to[3];
    for (int c = 0; c < 3; ++c) {
      to[c] = reflection_of(beam[c], material.reflectance_uq15[c], s->counters.shots, receivers);
    }
    const uint32_t end = uint32_t{surface.first_patch} + surface.patch_count;
    for (uint32_t first = surface.first_patch, count; first < end; first += count) {
      count = end - first < s->longest_run ? end - first : s->longest_run;
      const urad_status status = s->source.fill(s->source.context, s->shooter, uint16_t(k),
                                                uint16_t(first), uint16_t(count), s->factors);
      if (status != URAD_OK) return status;
      if (s->shooter - first < count) s->factors[s->shooter - first] = 0;
      uint64_t sum = sum_run(s->factors, count);
      if (*sum_uq32 + sum > kRowMost_uq32) {
        *cut = true;
        sum = kRowMost_uq32 - *sum_uq32;
        cut_run(s->factors, count, sum);
      }
      *sum_uq32 += sum;
      reflect_run(s, beam, to, first, count, sum == 0);
    }
  }
  return URAD_OK;
}

/// Every patch_count shots |unshot| has to fall by 1/4096 at least. Overshooting may raise it
/// first, where all patches emit, and makes it swing in a scene of few: it is looked at every 64
/// shots at the earliest, and fails only after four times in a row. The last few units of every
/// patch fall by chance as much as by absorption: they fail after sixteen times.
void guard(Radiosity* s) noexcept {
  constexpr uint32_t kFewUnits = 3 * 256;  // of a patch
  constexpr uint16_t kSwing = 64;
  if (s->status != URAD_OK) return;
  const uint16_t patches = s->scene->patch_count;
  const bool swings = (s->flags & URAD_OVERSHOOT) && patches < kSwing;
  if (++s->window_shots < (swings ? kSwing : patches)) return;
  const uint64_t before = s->window_remaining;
  const bool falls = s->remaining + (before >> 12) < before;
  s->window_shots = 0;
  s->window_remaining = s->remaining;
  s->window_strikes = falls ? 0 : uint8_t(s->window_strikes + 1);
  const bool few = s->remaining < uint64_t{kFewUnits} * patches;
  const int strikes = few ? 16 : s->flags & URAD_OVERSHOOT ? 4 : 1;
  if (s->window_strikes >= strikes) s->status = URAD_DIVERGES;
}

}  // namespace

Status radiosity_step(Radiosity* s) noexcept {
  if (s->status != URAD_OK) return Status(s->status);
  if (s->flags & kMoving) return Status::bad_argument;
  if (s->flags & kStale) {
    s->flags = uint8_t(s->flags & ~(kStale | kTwoWays));
    survey(s);
    if ((s->flags & URAD_OVERSHOOT) && s->remaining / 2 > one_way(*s)) {
      s->flags |= kTwoWays;
      survey(s);
    }
  }
  const bool empty = s->remaining == 0;
  s->counters.shots_empty += empty;
  if (empty && !(s->flags & URAD_SKIP_OFF_UNSHOT)) return Status::ok;

  const urad_surface& surface = s->scene->surface[surface_of(*s->scene, s->shooter)];
  Beam beam[3];
  uint32_t any = 0;
  for (int c = 0; c < 3; ++c) {
    beam[c] = beam_of(shot_power(*s, surface, c));
    any |= beam[c].mantissa;
  }
  for (uint32_t c = 0; c < 3; ++c) {
    const uint32_t at = 3u * s->shooter + c;
    if (any == 0) beam[c] = beam_of(s->unshot[at]);  // overshooting has cancelled it: shoot plainly
    const uint32_t power = beam[c].mantissa << beam[c].exponent;
    if (magnitude(s->shot[at]) + power + power / 2 > uint32_t{INT32_MAX}) {
      s->status = URAD_OVERFLOW;
      return Status::overflow;
    }
  }

  uint64_t sum_uq32 = 0;
  bool cut = false;
  const urad_status status = shoot(s, surface, beam, &sum_uq32, &cut);
  const bool keep = status != URAD_OK || judge_row(s, sum_uq32, cut);
  book(s, beam, sum_uq32, keep);
  survey(s);
  if (status != URAD_OK) return Status(status);
  if (!empty) {
    ++s->counters.shots;
    guard(s);
  }
  return Status(s->status);
}

Status radiosity_steps(Radiosity* s, uint32_t budget, uint32_t error_uq32,
                       uint32_t* shots) noexcept {
  Status status = Status(s->status);
  const uint32_t before = s->counters.shots;
  while (status == Status::ok && s->counters.shots - before < budget &&
         !radiosity_done(*s, error_uq32)) {
    status = radiosity_step(s);
  }
  if (shots) *shots = s->counters.shots - before;
  return status;
}

}  // namespace urad
