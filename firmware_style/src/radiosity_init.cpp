#include "radiosity_power.hpp"
#include "urad/radiosity.hpp"

namespace urad {

namespace {

/// Sums over all patches that do not depend on memory: areas relative to the largest.
struct Areas {
  int32_t log2_largest_q24 = INT32_MIN;
  uint64_t sum_uq31 = 0;
  uint64_t reflecting_uq16[3] = {
      0, 0, 0};  // sum of relative area (UQ0.31) times reflectance (UQ1.15), in 2^-30

  /// Share of the total as UQ16.16.
  uint32_t mean_uq16(int channel) const noexcept {
    if (reflecting_uq16[channel] == 0) return 0;
    const uint32_t mean =
        exp2_uq(log2_q24(reflecting_uq16[channel]) - log2_q24(sum_uq31), 31 - 30 + 16);
    return mean > 65536u ? 65536u : mean;
  }
};

template <typename Visit>
void for_each_patch(const urad_scene& scene, Visit visit) noexcept {
  for (uint32_t k = 0; k < scene.surface_count; ++k) {
    const urad_surface& surface = scene.surface[k];
    for (uint32_t place = 0; place < surface.patch_count; ++place) visit(surface, place);
  }
}

Areas areas_of(const urad_scene& scene) noexcept {
  Areas areas;
  for_each_patch(scene, [&](const urad_surface& surface, uint32_t place) {
    const int32_t log2_area = log2_area_of(surface, place);
    if (log2_area > areas.log2_largest_q24) areas.log2_largest_q24 = log2_area;
  });
  for_each_patch(scene, [&](const urad_surface& surface, uint32_t place) {
    const uint32_t area_uq31 = exp2_uq(log2_area_of(surface, place) - areas.log2_largest_q24, 31);
    areas.sum_uq31 += area_uq31;
    for (int c = 0; c < 3; ++c) {
      const uint16_t rho = scene.material[surface.material].reflectance_uq15[c];
      areas.reflecting_uq16[c] += wide_umul(area_uq31, rho) >> 16;
    }
  });
  return areas;
}

/// Emitted power of a patch, and its magnitude over all channels.
struct Emission {
  int64_t power[3];
  uint64_t key;
};

[[gnu::noinline]] Emission emission_of(const urad_scene& scene, const urad_surface& surface,
                                       uint32_t place) noexcept {
  Emission e{{0, 0, 0}, 0};
  for (int c = 0; c < 3; ++c) {
    e.power[c] =
        power_of(scene, scene.material[surface.material].exitance[c], log2_area_of(surface, place));
    e.key += magnitude(e.power[c]);
  }
  return e;
}

bool emissions_fit(const urad_scene& scene) noexcept {
  bool fit = true;
  for_each_patch(scene, [&](const urad_surface& surface, uint32_t place) {
    fit = fit && emission_of(scene, surface, place).key < URAD_POWER_LIMIT;
  });
  return fit;
}

}  // namespace

uint16_t longest_run(const urad_scene& scene) noexcept {
  uint16_t longest = 1;
  for (uint32_t k = 0; k < scene.surface_count; ++k) {
    if (scene.surface[k].patch_count > longest) longest = scene.surface[k].patch_count;
  }
  return longest;
}

void measure_scene(urad_radiosity* state) noexcept {
  const Areas areas = areas_of(*state->scene);
  state->log2_area_q24 = areas.log2_largest_q24 + log2_q24(areas.sum_uq31) - (31 << 24);
  for (int c = 0; c < 3; ++c) state->reflectance_uq16[c] = areas.mean_uq16(c);
}

Status radiosity_init(Radiosity* state, const urad_scene* scene, const urad_source& source,
                      unsigned flags, uint16_t run, void* memory, size_t bytes) noexcept {
  if (!state || !scene || !source.fill || !memory || run == 0 ||
      flags > 2u * URAD_SKIP_OFF_UNSHOT - 1) {
    return Status::bad_argument;
  }
  if (scene->patch_count == 0 || scene->surface_count == 0) return Status::bad_scene;
  const uint32_t n = scene->patch_count;
  if (bytes < radiosity_bytes(uint16_t(n), run) || reinterpret_cast<uintptr_t>(memory) % 4 != 0) {
    return Status::out_of_memory;
  }
  if (!emissions_fit(*scene)) return Status::overflow;

  *state = {};
  state->scene = scene;
  state->source = source;
  state->unshot = static_cast<int32_t*>(memory);
  state->shot = state->unshot + 3 * n;
  state->factors = static_cast<uint32_t*>(memory) + 6 * n;
  state->longest_run = run;
  state->flags = uint8_t(flags);

  measure_scene(state);
  state->closure_uq16 = 65536;
  uint64_t most = 0;
  for_each_patch(*scene, [&](const urad_surface& surface, uint32_t place) {
    const Emission emission = emission_of(*scene, surface, place);
    const uint32_t k = surface.first_patch + place;
    for (uint32_t c = 0; c < 3; ++c) {
      state->unshot[3 * k + c] = int32_t(emission.power[c]);
      state->shot[3 * k + c] = 0;
      state->ledger.emitted[c] += emission.power[c];
      state->ledger.unshot[c] += emission.power[c];
    }
    state->remaining += emission.key;
    if (emission.key > most) most = emission.key, state->shooter = uint16_t(k);
  });
  state->window_remaining = state->remaining;
  return Status::ok;
}

}  // namespace urad
