#include "urad/clip.hpp"
#include "urad/form_factor.hpp"
#include "urad/log2.hpp"
#include "urad/visibility.hpp"

namespace urad {

namespace {

urad_status no_light(uint32_t* f_uq32, uint16_t count) noexcept {
  for (uint16_t k = 0; k < count; ++k) f_uq32[k] = 0;
  return URAD_OK;
}

int32_t exchange_q24(const PairSource& source, const Patch& i, const Patch& j, Side side) noexcept {
  const urad_scene& scene = *source.scene;
  if (source.exchange) return source.exchange(source, i, j);
  if (source.points) return exchange_exact_q24(scene, i, j, source.points, source.counters);
  const auto exchange = side == Side::front ? exchange_in_front_q24 : exchange_log2_q24;
  return exchange(scene, i, j, source.kernel, source.net, source.skips_off, source.counters);
}

int32_t scale_q24(const urad_scene& scene, uint16_t patch) noexcept {
  return scene.log2_scale_q24 ? scene.log2_scale_q24[patch] : 0;
}

}  // namespace

urad_status pair_fill(void* pair_source, uint16_t shooter, uint16_t surface, uint16_t first,
                      uint16_t count, uint32_t* f_uq32) noexcept {
  if (!pair_source || !f_uq32) return URAD_BAD_ARGUMENT;
  const PairSource& source = *static_cast<const PairSource*>(pair_source);
  const urad_scene& scene = *source.scene;
  if (shooter >= scene.patch_count || surface >= scene.surface_count) return URAD_BAD_ARGUMENT;
  const urad_surface& to = scene.surface[surface];
  if (first < to.first_patch || first + count > to.first_patch + to.patch_count)
    return URAD_BAD_ARGUMENT;
  const Patch from = patch_at(scene, shooter);
  const bool same = from.surface == &to && (to.flags & URAD_SURFACE_PLANAR);
  if (same && !(source.skips_off & skip_off_same)) {
    const bool holds_shooter = shooter >= first && shooter - first < count;
    source.counters->skipped_same += uint32_t(count - holds_shooter);
    return no_light(f_uq32, count);
  }
  const Side side = same ? Side::both : side_of_run(scene, from, to);
  if (side == Side::behind && !(source.skips_off & skip_off_facing)) {
    source.counters->skipped_facing += count;
    return no_light(f_uq32, count);
  }
  Patch receiver = patch_at(scene, first);
  for (uint16_t k = 0; k < count; ++k) {
    f_uq32[k] = 0;
    if (receiver.index != shooter) {
      int32_t log2_g_q24 = exchange_q24(source, from, receiver, side);
      if (log2_g_q24 != kNoExchange) {
        log2_g_q24 += scale_q24(scene, shooter) + scale_q24(scene, receiver.index);
        f_uq32[k] = form_factor_uq32(log2_g_q24, from.shape->log2_area_q24);
        if (source.rays && !(scene.flags & URAD_SCENE_CONVEX)) {
          const uint32_t seen_uq16 =
              visible_fraction_uq16(scene, from, receiver, source.rays, true, source.counters);
          f_uq32[k] = uint32_t((uint64_t{f_uq32[k]} * seen_uq16 + 0x8000u) >> 16);
        }
      }
    }
    if (k + 1 < count) patch_advance(&receiver);
  }
  return URAD_OK;
}

}  // namespace urad
