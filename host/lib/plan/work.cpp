#include "plan/work.hpp"

#include "urad/clip.hpp"
#include "urad/form_factor.hpp"

namespace host {

int looked_pairs(const urad_scene& scene, std::uint16_t shooter) {
  const urad::Patch from = urad::patch_at(scene, shooter);
  int looked = 0;
  for (std::uint16_t s = 0; s < scene.surface_count; ++s) {
    const urad_surface& to = scene.surface[s];
    const bool planar = to.flags & URAD_SURFACE_PLANAR;
    if (from.surface == &to && planar) continue;
    const urad::Side side = urad::side_of_plane(scene, to, from.centroid, from.shape->normal_q30);
    if (side == urad::Side::behind) continue;
    urad::Side back = urad::Side::both;
    if (planar) {
      const urad::Patch first = urad::patch_at(scene, to.first_patch);
      back = urad::side_of_plane(scene, from, first.centroid, first.shape->normal_q30);
      if (back == urad::Side::behind) continue;
    }
    if (side == urad::Side::both || back == urad::Side::both) looked += to.patch_count;
  }
  return looked;
}

int traced_pairs(const urad_scene& scene, std::uint16_t shooter) {
  if (scene.flags & URAD_SCENE_CONVEX) return 0;
  int traced = 0;
  for (std::uint16_t s = 0; s < scene.surface_count; ++s) {
    const urad_surface& to = scene.surface[s];
    for (std::uint16_t k = 0; k < to.patch_count; ++k) {
      urad_counters counters{};
      urad::PairSource pairs{&scene, nullptr, urad::Kernel::centre, 1, 0, &counters, 0};
      std::uint32_t f_uq32 = 0;
      urad::pair_fill(&pairs, shooter, s, std::uint16_t(to.first_patch + k), 1, &f_uq32);
      traced += counters.ray_tests > 0;
    }
  }
  return traced;
}

}  // namespace host
