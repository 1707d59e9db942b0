#include "urad/clip.hpp"
#include "urad/form_factor.hpp"
#include "urad/log2.hpp"
#include "urad/visibility.hpp"
#include "visibility_candidates.hpp"
#include "visibility_row.hpp"

namespace urad {

namespace {

urad_status no_light(uint32_t* f_uq32, uint16_t count) noexcept {
  for (uint16_t k = 0; k < count; ++k) f_uq32[k] = 0;
  return URAD_OK;
}

int32_t exchange_q24(const PairSource& source, const Patch& i, const Patch& j, Side side,
                     SmallExchange* limit) noexcept {
  const urad_scene& scene = *source.scene;
  if (source.exchange) return source.exchange(source, i, j, side);
  if (source.points) return exchange_exact_q24(scene, i, j, source.points, source.counters);
  const auto exchange = side == Side::front ? exchange_in_front_q24 : exchange_log2_q24;
  return exchange(scene, i, j, source.kernel, source.net, source.skips_off, source.counters, limit);
}

int32_t scale_q24(const urad_scene& scene, uint16_t patch) noexcept {
  return scene.log2_scale_q24 ? scene.log2_scale_q24[patch] : 0;
}

/// A matter of the scene, not of what skips are off: what is left out must not depend on those.
bool casts_rays(const PairSource& source) noexcept {
  const urad_scene& scene = *source.scene;
  return source.rays && !(scene.flags & URAD_SCENE_CONVEX) && !visibility_of(scene);
}

/// What a row may still leave out, kept from run to run. Without rays nothing: a kernel costs less
/// than to book every pair.
class Allowance {
 public:
  Allowance(PairSource* source, const Patch& from, uint32_t first, uint32_t count) noexcept
      : source_(*source), log2_area_q24_(from.shape->log2_area_q24) {
    if (source_.bound_uq32 == 0 || !casts_rays(source_)) return;
    const bool goes_on = source_.lost_shooter == from.index && first >= source_.lost_next;
    if (!goes_on) source_.lost_uq32 = 0;
    source_.lost_shooter = from.index;
    source_.lost_next = first + count;
    greatest_q24_ =
        log2_q24(source_.bound_uq32) + (3 << 24) - log2_q24(uint32_t{source_.scene->patch_count});
    look();
  }

  /// For the next pair, whose repair is d_i d_j = 2^scale.
  SmallExchange* limit(int32_t scale_q24) noexcept {
    if (least_q24_ == kNoExchange) return nullptr;
    limit_ = {least_q24_ - (32 << 24) + log2_area_q24_ - scale_q24, kNoExchange};
    return &limit_;
  }

  /// After a pair for which limit() was asked.
  void book(int32_t scale_q24) noexcept {
    if (least_q24_ == kNoExchange || limit_.left_out_q24 == kNoExchange) return;
    source_.lost_uq32 += form_factor_uq32(limit_.left_out_q24 + scale_q24, log2_area_q24_);
    look();
  }

 private:
  void look() noexcept {
    if (source_.lost_uq32 >= source_.bound_uq32) {
      least_q24_ = kNoExchange;
      return;
    }
    const int32_t left_q24 = log2_q24(source_.bound_uq32 - source_.lost_uq32);
    least_q24_ = left_q24 < greatest_q24_ ? left_q24 : greatest_q24_;
  }

  PairSource& source_;
  int32_t log2_area_q24_, greatest_q24_ = 0, least_q24_ = kNoExchange;  // log2 of F 2^32
  SmallExchange limit_{kNoExchange, kNoExchange};
};

/// Where the visible part of a run's pairs comes from; neither: everything is seen.
struct Sight {
  RunBlockers* blockers;
  VisibilityRow* exported;
};

uint32_t seen_by_rays_uq16(const PairSource& source, RunBlockers& run, const Patch& i,
                           const Patch& j, int32_t log2_g_q24) noexcept {
  if (source.error_uq32 == 0)
    return visible_fraction_uq16(run, j, source.rays, true, source.counters);
  const int32_t a_i = i.shape->log2_area_q24, a_j = j.shape->log2_area_q24;
  const uint32_t f_uq32 = form_factor_uq32(log2_g_q24, a_i < a_j ? a_i : a_j);
  return adaptive_fraction_uq16(run, j, {source.rays, source.depth, source.error_uq32}, f_uq32,
                                source.counters);
}

void fill_run(PairSource& source, const Patch& from, Side side, uint16_t first, uint16_t count,
              const Sight& sight, uint32_t* f_uq32) noexcept {
  const urad_scene& scene = *source.scene;
  Allowance allowance(&source, from, first, count);
  Patch receiver = patch_at(scene, first);
  for (uint16_t k = 0; k < count; ++k) {
    f_uq32[k] = 0;
    uint32_t seen_uq16 = sight.exported ? sight.exported->next_uq16() : kAllVisible_uq16;
    if (receiver.index != from.index) {
      const int32_t scale = scale_q24(scene, from.index) + scale_q24(scene, receiver.index);
      const int32_t log2_g_q24 = exchange_q24(source, from, receiver, side, allowance.limit(scale));
      allowance.book(scale);
      if (log2_g_q24 != kNoExchange) {
        const uint32_t f = form_factor_uq32(log2_g_q24 + scale, from.shape->log2_area_q24);
        if (sight.exported) {
          ++source.counters->sights;
          source.counters->blocked += seen_uq16 == 0;
        }
        if (sight.blockers)
          seen_uq16 = seen_by_rays_uq16(source, *sight.blockers, from, receiver, log2_g_q24);
        f_uq32[k] = uint32_t((wide_umul(f, seen_uq16) + 0x8000u) >> 16);
        source.counters->skipped_convex += !sight.exported && !sight.blockers && source.rays;
      }
    }
    if (k + 1 < count) patch_advance(&receiver);
  }
}

}  // namespace

urad_status pair_fill(void* pair_source, uint16_t shooter, uint16_t surface, uint16_t first,
                      uint16_t count, uint32_t* f_uq32) noexcept {
  if (!pair_source || !f_uq32) return URAD_BAD_ARGUMENT;
  PairSource& source = *static_cast<PairSource*>(pair_source);
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
  if (side == Side::behind && !(source.skips_off & skip_off_behind)) {
    source.counters->skipped_facing += count;
    source.counters->skipped_behind += count;
    return no_light(f_uq32, count);
  }
  const bool convex = (scene.flags & URAD_SCENE_CONVEX) && !(source.skips_off & skip_off_convex);
  const urad_visibility* const exported = visibility_of(scene);
  if (convex || (!exported && source.rays == 0)) {
    fill_run(source, from, side, first, count, {nullptr, nullptr}, f_uq32);
  } else if (exported) {
    VisibilityRow row(*exported, shooter, first);
    fill_run(source, from, side, first, count, {nullptr, &row}, f_uq32);
  } else {
    RunBlockers run(scene, from, to.grid, source.skips_off, &source.last_blocker);
    fill_run(source, from, side, first, count, {&run, nullptr}, f_uq32);
  }
  return URAD_OK;
}

}  // namespace urad
