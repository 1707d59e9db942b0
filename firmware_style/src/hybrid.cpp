#include "urad/hybrid.hpp"

#include "urad/clip.hpp"
#include "urad/log2.hpp"
#include "urad/ratio.hpp"
#include "urad/visibility.hpp"

namespace urad {

namespace {

/// a * b / 2^bits to nearest, saturating at 2^32 - 1.
constexpr uint32_t times(uint32_t a, uint32_t b_uq, int bits) noexcept {
  const uint64_t product = (wide_umul(a, b_uq) + (uint64_t{1} << (bits - 1))) >> bits;
  return product > 0xFFFFFFFFu ? 0xFFFFFFFFu : uint32_t(product);
}

uint32_t factor_uq32(const HybridSource& source, const Patch& i, const Patch& j,
                     urad_counters* counters) noexcept {
  const HemicubeSource& hemicube = *source.hemicube;
  const urad_scene& scene = *hemicube.scene;
  const bool convex = scene.flags & URAD_SCENE_CONVEX;
  uint32_t covered = convex ? 0 : hemicube.coverage_uq32[j.index];
  const uint32_t seen = covered ? hemicube.visible_uq32[j.index] : 0;
  // A hair of a patch may be a seam between rounded walls: rays, which slip through none, decide.
  if (seen != 0 && seen < covered >> 4) covered = 0;
  if (covered && !seen) {  // no need to know of how much nothing is seen
    ++counters->evaluated;
    ++counters->blocked;
    return 0;
  }
  int32_t log2_g_q24 =
      exchange_log2_q24(scene, i, j, source.kernel, source.net, source.skips_off, counters);
  if (log2_g_q24 == kNoExchange) return 0;
  if (scene.log2_scale_q24)
    log2_g_q24 += scene.log2_scale_q24[i.index] + scene.log2_scale_q24[j.index];
  const uint32_t f_uq32 = form_factor_uq32(log2_g_q24, i.shape->log2_area_q24);
  if (convex) {
    ++counters->skipped_convex;
    return f_uq32;
  }
  if (!covered)
    return times(f_uq32, visible_fraction_uq16(scene, i, j, source.rays, true, counters), 16);
  if (seen >= covered) return f_uq32;
  return times(f_uq32, uint32_t(round_shift(ratio_q(seen, covered, 24), 8)), 16);
}

/// A factor from the centre of the shooter, made the mean over the shooter to second order.
uint32_t over_shooter_uq32(uint32_t f_uq32, const Patch& from, const Patch& to) noexcept {
  PairKernel kernel;
  if (f_uq32 == 0 || !pair_kernel(*from.shape, from.centroid, *to.shape, to.centroid, &kernel)) {
    return f_uq32;
  }
  return times(f_uq32, exp2_uq(log2_extent_q24(kernel), 24), 24);
}

/// Calls visit(patch) for every patch that may exchange light with `from`.
template <class Visit>
void for_each_receiver(const urad_scene& scene, const Patch& from, Visit visit) noexcept {
  for (uint16_t s = 0; s < scene.surface_count; ++s) {
    const urad_surface& surface = scene.surface[s];
    if (&surface == from.surface && (surface.flags & URAD_SURFACE_PLANAR)) continue;
    Patch to = patch_at(scene, surface.first_patch);
    for (uint16_t k = 0; k < surface.patch_count; ++k) {
      if (to.index != from.index) visit(to);
      if (k + 1 < surface.patch_count) patch_advance(&to);
    }
  }
}

/// Replaces the near pairs of a hemicube row, turns the far ones from factors of the shooter's
/// centre into means over the shooter, and scales these so that the row keeps its sum. The sum is
/// what a hemicube has right (it is 1 less the sky, whatever the receivers); the shares are what
/// it has wrong. Near pairs that would take more than the whole row leave nothing to the far ones.
void correct_row(const HybridSource& source, const Patch& from) noexcept {
  const HemicubeSource& hemicube = *source.hemicube;
  uint32_t* row = hemicube.visible_uq32;
  uint64_t seen = 0, near = 0, far = 0;
  urad_counters* counters = hemicube.counters;
  const urad_counters before = *counters;
  for_each_receiver(*hemicube.scene, from, [&](const Patch& to) {
    uint32_t& f_uq32 = row[to.index];
    seen += f_uq32;
    if (closer_than(from, to, source.near_rho_uq16)) {
      f_uq32 = factor_uq32(source, from, to, counters);
      near += f_uq32;
    } else {
      f_uq32 = over_shooter_uq32(f_uq32, from, to);
      far += f_uq32;
    }
  });
  // Runs count pairs, not this walk.
  counters->evaluated = before.evaluated;
  counters->skipped_facing = before.skipped_facing;
  if (far == 0) return;

  const int64_t scale_uq30 = ratio_q(int64_t(seen > near ? seen - near : 0), int64_t(far), 30);
  const uint32_t limited_uq30 = scale_uq30 > 0xFFFFFFFF ? 0xFFFFFFFFu : uint32_t(scale_uq30);
  for_each_receiver(*hemicube.scene, from, [&](const Patch& to) {
    if (!closer_than(from, to, source.near_rho_uq16))
      row[to.index] = times(row[to.index], limited_uq30, 30);
  });
}

}  // namespace

Status hybrid_init(HybridSource* source, HemicubeSource* hemicube, Kernel kernel,
                   const urad_net* net, uint16_t rays, uint32_t near_rho_uq16) noexcept {
  if (!source || !hemicube || rays < 1 || rays > kMaxRays) return Status::bad_argument;
  const bool convex = hemicube->scene->flags & URAD_SCENE_CONVEX;
  if (!convex && !hemicube->coverage_uq32) return Status::bad_argument;
  *source = {hemicube, net, kernel, rays, near_rho_uq16, -1};
  return Status::ok;
}

urad_status hybrid_fill(void* hybrid_source, uint16_t shooter, uint16_t surface, uint16_t first,
                        uint16_t count, uint32_t* f_uq32) noexcept {
  HybridSource* source = static_cast<HybridSource*>(hybrid_source);
  if (!source || !f_uq32) return URAD_BAD_ARGUMENT;
  HemicubeSource& hemicube = *source->hemicube;
  const urad_scene& scene = *hemicube.scene;
  if (shooter >= scene.patch_count || surface >= scene.surface_count) return URAD_BAD_ARGUMENT;
  const urad_surface& receivers = scene.surface[surface];
  if (first < receivers.first_patch ||
      first + count > receivers.first_patch + receivers.patch_count) {
    return URAD_BAD_ARGUMENT;
  }

  const Patch from = patch_at(scene, shooter);
  const bool by_cells = source->near_rho_uq16 != 0 || !(scene.flags & URAD_SCENE_CONVEX);
  if (by_cells && source->shooter != shooter) {
    hemicube.shooter = -1;
    source->shooter = -1;
    const Status status = hemicube_render(&hemicube, shooter);
    if (status != Status::ok) return urad_status(status);
    if (source->near_rho_uq16 != 0) correct_row(*source, from);
    source->shooter = shooter;
  }

  if (source->near_rho_uq16 != 0)
    return hemicube_fill(&hemicube, shooter, surface, first, count, f_uq32);
  const bool same = from.surface == &receivers && (receivers.flags & URAD_SURFACE_PLANAR);
  if (!same && !(source->skips_off & skip_off_behind) &&
      side_of_run(scene, from, receivers) == Side::behind) {
    for (uint16_t k = 0; k < count; ++k) f_uq32[k] = 0;
    hemicube.counters->skipped_facing += count;
    hemicube.counters->skipped_behind += count;
    return URAD_OK;
  }
  Patch to = patch_at(scene, first);
  for (uint16_t k = 0; k < count; ++k) {
    f_uq32[k] = 0;
    if (to.index != shooter) {
      if (same)
        ++hemicube.counters->skipped_same;
      else
        f_uq32[k] = factor_uq32(*source, from, to, hemicube.counters);
    }
    if (k + 1 < count) patch_advance(&to);
  }
  return URAD_OK;
}

}  // namespace urad
