// urad.cpp -- the C interface: null and range checks, then the C++ function of the same name.
#include "urad/urad.h"

#include "urad/grid.hpp"
#include "urad/hybrid.hpp"
#include "urad/network.hpp"
#include "urad/pose_table.hpp"
#include "urad/radiosity.hpp"
#include "urad/visibility.hpp"

namespace {

using urad::Kernel;
using urad::Status;

static_assert(URAD_RAYS_MAX == urad::kMaxRays);
static_assert(int(URAD_KERNEL_CENTRE) == int(Kernel::centre));
static_assert(int(URAD_KERNEL_MOMENT) == int(Kernel::moment));
static_assert(int(URAD_HEMICUBE_TURNED) == int(urad::hemicube_turned));
static_assert(int(URAD_HEMICUBE_FOUR_EYES) == int(urad::hemicube_four_eyes));
static_assert(int(URAD_HEMICUBE_COVERAGE) == int(urad::hemicube_coverage));

constexpr urad_status c_status(Status status) { return urad_status(status); }

bool pair_settings_fit(const urad_scene* scene, unsigned kernel, uint16_t rays) {
  return scene && kernel <= URAD_KERNEL_MOMENT && rays <= URAD_RAYS_MAX;
}

/// The inputs of another net would be read beyond those of a pair.
bool reads_pairs(const urad_net* net) { return !net || net->inputs == urad::kPairInputs; }

/// The object at the start of `memory`, or null if it does not fit there.
template <typename Object>
Object* place(void* memory, size_t bytes) {
  const bool fits =
      bytes >= sizeof(Object) && reinterpret_cast<uintptr_t>(memory) % alignof(Object) == 0;
  return fits ? static_cast<Object*>(memory) : nullptr;
}

uint16_t most_vertices(const urad_scene& scene) {
  uint16_t most = 4;
  for (uint32_t k = 0; k < scene.surface_count; ++k) {
    const urad_surface& surface = scene.surface[k];
    for (uint32_t place = 0; surface.polygon && place < surface.patch_count; ++place) {
      if (surface.polygon[place].vertex_count > most) most = surface.polygon[place].vertex_count;
    }
  }
  for (uint32_t k = 0; k < scene.blocker_count; ++k) {
    if (scene.blocker[k].vertex_count > most) most = scene.blocker[k].vertex_count;
  }
  return most;
}

}  // namespace

extern "C" {

urad_status urad_scene_check(const urad_scene* scene) { return c_status(urad::scene_check(scene)); }

urad_status urad_scene_crc32(const urad_scene* scene, uint32_t crc32[2]) {
  if (!scene || !crc32) return URAD_BAD_ARGUMENT;
  const urad::SceneCrc crc = urad::scene_crc32(*scene);
  crc32[0] = crc.fields, crc32[1] = crc.tables;
  return URAD_OK;
}

urad_status urad_scene_verify(const urad_scene* scene, const uint32_t crc32[2]) {
  if (!crc32) return URAD_BAD_ARGUMENT;
  return c_status(urad::scene_verify(scene, {crc32[0], crc32[1]}));
}

urad_status urad_net_check(const urad_net* net) { return c_status(urad::network_check(net)); }

urad_status urad_pose_table_check(const urad_pose_table* table, const urad_scene* scene) {
  return c_status(urad::pose_table_check(table, scene));
}

urad_status urad_grid_make(urad_point origin, urad_point step_u, urad_point step_v,
                           uint16_t count_u, uint16_t count_v, urad_grid* grid) {
  return c_status(urad::grid_make(origin, step_u, step_v, count_u, count_v, grid));
}

urad_status urad_form_factor(const urad_scene* scene, uint16_t from, uint16_t to, unsigned kernel,
                             const urad_net* net, uint16_t rays, uint32_t* f_uq32,
                             urad_counters* counters) {
  if (!pair_settings_fit(scene, kernel, rays) || !f_uq32) return URAD_BAD_ARGUMENT;
  if (from >= scene->patch_count || to >= scene->patch_count) return URAD_BAD_ARGUMENT;
  if (!reads_pairs(net)) return URAD_BAD_NET;
  urad_counters unread{};
  urad::PairSource pairs{scene, net, Kernel(kernel), rays, 0, counters ? counters : &unread};
  return urad::pair_fill(&pairs, from, urad::surface_of(*scene, to), to, 1, f_uq32);
}

size_t urad_pair_source_bytes(void) { return sizeof(urad::PairSource); }

urad_status urad_pair_source_init(urad_source* source, const urad_scene* scene, unsigned kernel,
                                  const urad_net* net, uint16_t rays, urad_counters* counters,
                                  void* memory, size_t bytes) {
  if (!pair_settings_fit(scene, kernel, rays) || !source || !counters || !memory) {
    return URAD_BAD_ARGUMENT;
  }
  if (!reads_pairs(net)) return URAD_BAD_NET;
  auto* const pairs = place<urad::PairSource>(memory, bytes);
  if (!pairs) return URAD_OUT_OF_MEMORY;
  *pairs = {scene, net, Kernel(kernel), rays, 0, counters};
  *source = {urad::pair_fill, pairs};
  return URAD_OK;
}

urad_status urad_pair_source_worth(const urad_source* source, uint32_t f_uq32, unsigned cuts) {
  if (!source || source->fill != urad::pair_fill || !source->context || cuts > urad::kMaxDepth) {
    return URAD_BAD_ARGUMENT;
  }
  auto* const pairs = static_cast<urad::PairSource*>(source->context);
  pairs->error_uq32 = f_uq32;
  pairs->depth = uint8_t(cuts);
  return URAD_OK;
}

size_t urad_pose_source_bytes(void) { return sizeof(urad::PoseSource); }

urad_status urad_pose_source_init(urad_source* source, const urad_scene* scene,
                                  const urad_pose_table* table, urad_counters* counters,
                                  void* memory, size_t bytes) {
  if (!source || !scene || !table || !counters || !memory) return URAD_BAD_ARGUMENT;
  auto* const poses = place<urad::PoseSource>(memory, bytes);
  if (!poses) return URAD_OUT_OF_MEMORY;
  *poses = {scene, table, counters};
  *source = {urad::pose_fill, poses};
  return URAD_OK;
}

size_t urad_hemicube_source_bytes(const urad_scene* scene, uint16_t resolution, uint16_t rows,
                                  unsigned flags) {
  if (!scene) return 0;
  return sizeof(urad::HemicubeSource) + urad::hemicube_bytes(resolution, rows, scene->patch_count,
                                                             flags & urad::hemicube_coverage,
                                                             most_vertices(*scene));
}

urad_status urad_hemicube_source_init(urad_source* source, const urad_scene* scene,
                                      const urad_hemicube_table* table, uint16_t rows,
                                      unsigned flags, urad_counters* counters, void* memory,
                                      size_t bytes) {
  if (!source || !scene || !table || !table->top || !table->side || !counters || !memory ||
      (flags &
       ~unsigned{URAD_HEMICUBE_TURNED | URAD_HEMICUBE_COVERAGE | URAD_HEMICUBE_FOUR_EYES})) {
    return URAD_BAD_ARGUMENT;
  }
  auto* const hemicube = place<urad::HemicubeSource>(memory, bytes);
  if (!hemicube) return URAD_OUT_OF_MEMORY;
  const Status status = urad::hemicube_init(
      hemicube, scene, {table->resolution, table->top, table->side}, rows, uint8_t(flags),
      hemicube + 1, bytes - sizeof(urad::HemicubeSource), counters);
  if (status == Status::ok) *source = {urad::hemicube_fill, hemicube};
  return c_status(status);
}

size_t urad_hybrid_source_bytes(void) { return sizeof(urad::HybridSource); }

urad_status urad_hybrid_source_init(urad_source* source, const urad_source* hemicube,
                                    unsigned kernel, const urad_net* net, uint16_t rays,
                                    uint32_t near_rho_uq16, void* memory, size_t bytes) {
  if (!source || !hemicube || hemicube->fill != urad::hemicube_fill ||
      kernel > URAD_KERNEL_MOMENT || !memory) {
    return URAD_BAD_ARGUMENT;
  }
  if (!reads_pairs(net)) return URAD_BAD_NET;
  auto* const hybrid = place<urad::HybridSource>(memory, bytes);
  if (!hybrid) return URAD_OUT_OF_MEMORY;
  const Status status =
      urad::hybrid_init(hybrid, static_cast<urad::HemicubeSource*>(hemicube->context),
                        Kernel(kernel), net, rays, near_rho_uq16);
  if (status == Status::ok) *source = {urad::hybrid_fill, hybrid};
  return c_status(status);
}

uint16_t urad_longest_run(const urad_scene* scene) {
  return scene ? urad::longest_run(*scene) : uint16_t{0};
}

urad_status urad_radiosity_init(urad_radiosity* state, const urad_scene* scene,
                                const urad_source* source, unsigned flags, uint16_t run,
                                void* memory, size_t bytes) {
  if (!source) return URAD_BAD_ARGUMENT;
  return c_status(urad::radiosity_init(state, scene, *source, flags, run, memory, bytes));
}

urad_status urad_radiosity_step(urad_radiosity* state) {
  return state ? c_status(urad::radiosity_step(state)) : URAD_BAD_ARGUMENT;
}

int urad_radiosity_done(const urad_radiosity* state, uint32_t error_uq32) {
  return !state || urad::radiosity_done(*state, error_uq32);
}

uint32_t urad_radiosity_error_uq32(const urad_radiosity* state) {
  return state ? urad::radiosity_error_uq32(*state) : 0;
}

urad_status urad_radiosity_get(const urad_radiosity* state, uint16_t patch, unsigned channel,
                               int32_t* exitance) {
  if (!state || !exitance || patch >= state->scene->patch_count || channel >= 3) {
    return URAD_BAD_ARGUMENT;
  }
  *exitance = urad::radiosity_get(*state, patch, int(channel));
  return URAD_OK;
}

urad_status urad_radiosity_display(const urad_radiosity* state, uint16_t patch, unsigned channel,
                                   int32_t* exitance) {
  if (!state || !exitance || patch >= state->scene->patch_count || channel >= 3) {
    return URAD_BAD_ARGUMENT;
  }
  *exitance = urad::radiosity_display(*state, patch, int(channel));
  return URAD_OK;
}

urad_status urad_radiosity_steps(urad_radiosity* state, uint32_t budget, uint32_t error_uq32,
                                 uint32_t* shots) {
  return state ? c_status(urad::radiosity_steps(state, budget, error_uq32, shots))
               : URAD_BAD_ARGUMENT;
}

urad_status urad_radiosity_relight_init(urad_radiosity* state, void* memory, size_t bytes) {
  return c_status(urad::radiosity_relight_init(state, memory, bytes));
}

urad_status urad_radiosity_set_emission(urad_radiosity* state, uint16_t patch,
                                        const int32_t* exitance) {
  return c_status(urad::radiosity_set_emission(state, patch, exitance));
}

urad_status urad_radiosity_set_reflectance(urad_radiosity* state, urad_material* material,
                                           const uint16_t* reflectance_uq15) {
  return c_status(urad::radiosity_set_reflectance(state, material, reflectance_uq15));
}

urad_status urad_light_mix(const urad_light* light, uint16_t lights, uint16_t patches,
                           uint32_t* radiosity) {
  if (!light || !radiosity || lights > 32767) return URAD_BAD_ARGUMENT;
  for (uint32_t k = 0; k < lights; ++k) {
    if (!light[k].basis) return URAD_BAD_ARGUMENT;
  }
  urad::light_mix(light, lights, patches, radiosity);
  return URAD_OK;
}

int urad_radiosity_audit(const urad_radiosity* state, urad_ledger* ledger) {
  return state && urad::radiosity_audit(*state, ledger);
}

}  // extern "C"
