// Light that changes: signed differences become unshot power [Chen 1990], or lights are mixed.
#include "radiosity_change.hpp"
#include "urad/patch.hpp"
#include "urad/radiosity.hpp"
#include "urad/ratio.hpp"

namespace urad {

namespace {

/// Power that has met a patch so far, gathered over what all others have shot: a patch that reflects
/// nothing has kept no other trace of it. A_k F_kj = A_j F_jk, so that one row of factors will do.
Status gather_met(Radiosity* s, uint16_t patch, int64_t* met) noexcept {
  const urad_scene& scene = *s->scene;
  const urad_surface& own = scene.surface[surface_of(scene, patch)];
  const int32_t log2_own_q24 = log2_area_of(own, uint32_t(patch - own.first_patch));
  met[0] = met[1] = met[2] = 0;
  for (uint32_t k = 0; k < scene.surface_count; ++k) {
    const urad_surface& surface = scene.surface[k];
    const uint32_t end = uint32_t{surface.first_patch} + surface.patch_count;
    for (uint32_t first = surface.first_patch, count; first < end; first += count) {
      count = end - first < s->longest_run ? end - first : s->longest_run;
      const urad_status status = s->source.fill(s->source.context, patch, uint16_t(k),
                                                uint16_t(first), uint16_t(count), s->factors);
      if (status != URAD_OK) return Status(status);
      for (uint32_t n = 0; n < count; ++n) {
        const uint32_t j = first + n;
        if (j == patch || s->factors[n] == 0) continue;
        const int32_t log2_ratio_q24 =
            log2_own_q24 - log2_area_of(surface, j - surface.first_patch);
        // F < 2^32 and |shot| < 2^31: the product fits, and what is left of it times 2^33.
        for (uint32_t c = 0; c < 3; ++c) {
          const int64_t part = round_shift(int64_t{s->factors[n]} * s->shot[3 * j + c], 31);
          met[c] += times_exp2(part, log2_ratio_q24);
        }
      }
    }
  }
  // Each was kept with a bit more than a unit.
  for (int c = 0; c < 3; ++c) met[c] = round_shift(met[c], 1);
  return Status::ok;
}

/// What a patch has reflected so far.
int64_t reflected_by(const Radiosity& s, uint32_t patch, uint32_t channel) noexcept {
  const uint32_t at = 3 * patch + channel;
  return int64_t{s.shot[at]} + s.unshot[at] - s.emitted[at];
}

/// A material's reflectance, before and after.
struct Paint {
  const uint16_t *from_uq15, *to_uq15;

  /// Nothing that the patches have kept tells what they will reflect.
  bool on_black(uint32_t c) const noexcept { return from_uq15[c] == 0 && to_uq15[c] != 0; }

  /// What is reflected more than it was. Painted black, a patch keeps no unit of it.
  int64_t more(int64_t reflected, uint32_t c) const noexcept {
    if (to_uq15[c] == 0) return -reflected;
    const uint32_t old = from_uq15[c];
    const int32_t rise = int32_t(to_uq15[c]) - from_uq15[c];
    // |reflected| < 2^33 and |rise| <= 2^15; rounded by adding half the divisor.
    const uint64_t product = magnitude(reflected) * magnitude(rise) + old / 2;
    const int64_t size = ratio_q(int64_t(product), old, 0);
    return (reflected < 0) == (rise < 0) ? size : -size;
  }
};

/// A patch reflects so much more: unshot now, and absorbed no longer.
void reflect_more(Radiosity* s, uint32_t patch, const int64_t* more) noexcept {
  write(s, patch, changed(*s, patch, more));
  for (int c = 0; c < 3; ++c) {
    s->reflected[c] += more[c];
    s->ledger.absorbed[c] -= more[c];
  }
}

/// Looks whether all that a patch reflects more fits; writes what it reflects in channels that were
/// black.
Status paint_black(Radiosity* s, uint32_t patch, const Paint& paint) noexcept {
  int64_t met[3] = {0, 0, 0}, more[3];
  if (paint.on_black(0) || paint.on_black(1) || paint.on_black(2)) {
    const Status status = gather_met(s, uint16_t(patch), met);
    if (status != Status::ok) return status;
  }
  for (uint32_t c = 0; c < 3; ++c)
    more[c] = paint.on_black(c) ? round_shift(met[c] * paint.to_uq15[c], 15)
                                : paint.more(reflected_by(*s, patch, c), c);
  if (!changed(*s, patch, more).fits) return Status::overflow;
  for (uint32_t c = 0; c < 3; ++c)
    if (!paint.on_black(c)) more[c] = 0;
  reflect_more(s, patch, more);
  return Status::ok;
}

/// The rest of it; or, to undo the above, what black channels have reflected is taken from them.
void paint_rest(Radiosity* s, uint32_t patch, const Paint& paint, bool undo) noexcept {
  int64_t more[3] = {0, 0, 0};
  for (uint32_t c = 0; c < 3; ++c) {
    if (paint.on_black(c) != undo) continue;
    const int64_t reflected = reflected_by(*s, patch, c);
    more[c] = undo ? -reflected : paint.more(reflected, c);
  }
  reflect_more(s, patch, more);
}

template <typename Visit>
void for_each_patch_of(const urad_scene& scene, uint32_t material, Visit visit) noexcept {
  for (uint32_t k = 0; k < scene.surface_count; ++k) {
    const urad_surface& surface = scene.surface[k];
    if (surface.material != material) continue;
    for (uint32_t place = 0; place < surface.patch_count; ++place)
      visit(surface.first_patch + place);
  }
}

}  // namespace

Status radiosity_relight_init(Radiosity* s, void* memory, size_t bytes) noexcept {
  if (!s || !memory) return Status::bad_argument;
  const urad_scene& scene = *s->scene;
  if (bytes < URAD_RELIGHT_BYTES(scene.patch_count) || reinterpret_cast<uintptr_t>(memory) % 4) {
    return Status::out_of_memory;
  }
  s->emitted = static_cast<int32_t*>(memory);
  for (uint32_t k = 0; k < scene.surface_count; ++k) {
    const urad_surface& surface = scene.surface[k];
    const urad_material& material = scene.material[surface.material];
    for (uint32_t place = 0; place < surface.patch_count; ++place) {
      int32_t* const emitted = s->emitted + 3 * (surface.first_patch + place);
      for (int c = 0; c < 3; ++c) {
        // Fits: radiosity_init() has looked.
        emitted[c] = int32_t(power_of(scene, material.exitance[c], log2_area_of(surface, place)));
      }
    }
  }
  return Status::ok;
}

Status radiosity_set_emission(Radiosity* s, uint16_t patch, const int32_t* exitance) noexcept {
  if (!s || !s->emitted || !exitance || patch >= s->scene->patch_count) {
    return Status::bad_argument;
  }
  const urad_surface& surface = s->scene->surface[surface_of(*s->scene, patch)];
  const int32_t log2_area_q24 = log2_area_of(surface, uint32_t(patch - surface.first_patch));
  int32_t* const emitted = s->emitted + 3 * patch;
  int64_t power[3], delta[3];
  uint64_t key = 0;
  for (int c = 0; c < 3; ++c) {
    if (exitance[c] < 0 || exitance[c] > 1 << 30) return Status::bad_argument;
    power[c] = power_of(*s->scene, exitance[c], log2_area_q24);
    delta[c] = power[c] - emitted[c];
    key += magnitude(power[c]);
  }
  const Changed to = changed(*s, patch, delta);
  if (key >= URAD_POWER_LIMIT || !to.fits) return Status::overflow;
  write(s, patch, to);
  for (int c = 0; c < 3; ++c) {
    emitted[c] = int32_t(power[c]);
    s->ledger.emitted[c] += delta[c];
  }
  begin_again(s);
  return Status::ok;
}

Status radiosity_set_reflectance(Radiosity* s, urad_material* material,
                                 const uint16_t* reflectance_uq15) noexcept {
  if (!s || !s->emitted || !material || !reflectance_uq15) return Status::bad_argument;
  if (s->flags & kMoving) return Status::bad_argument;
  const urad_scene& scene = *s->scene;
  uint32_t number = 0;
  while (number < scene.material_count && scene.material + number != material) ++number;
  if (number == scene.material_count) return Status::bad_argument;
  for (int c = 0; c < 3; ++c) {
    if (reflectance_uq15[c] > 32768) return Status::bad_argument;
  }
  // The source is asked once, and may fail at any patch: until then all that has been written is
  // known from what it was written to.
  const Paint paint{material->reflectance_uq15, reflectance_uq15};
  Status status = Status::ok;
  for_each_patch_of(scene, number, [&](uint32_t patch) {
    if (status == Status::ok) status = paint_black(s, patch, paint);
  });
  const bool undo = status != Status::ok;
  for_each_patch_of(scene, number, [&](uint32_t patch) { paint_rest(s, patch, paint, undo); });
  if (status != Status::ok) return status;
  for (int c = 0; c < 3; ++c) material->reflectance_uq15[c] = reflectance_uq15[c];
  measure_scene(s);
  begin_again(s);
  return Status::ok;
}

void light_mix(const urad_light* light, uint16_t lights, uint16_t patches,
               uint32_t* radiosity) noexcept {
  for (uint32_t c = 0; c < 3; ++c) {
    uint32_t* out = radiosity + c;
    const uint32_t* const end = out + 3u * patches;
    for (; out != end; out += 3) *out = 0;
    for (uint32_t k = 0; k < lights; ++k) {
      const uint32_t colour = light[k].colour_uq15[c];
      if (colour == 0) continue;
      const uint16_t* basis = light[k].basis + c;
      const auto add = [=](uint32_t* to, uint32_t b) { *to += (b * colour + 0x4000u) >> 15; };
      out = radiosity + c;
      if (patches & 1u) {
        add(out, *basis);
        out += 3, basis += 3;
      }
      for (; out != end; out += 6, basis += 6) {  // two at a time, as reflect()
        add(out, basis[0]);
        add(out + 3, basis[3]);
      }
    }
  }
}

}  // namespace urad
