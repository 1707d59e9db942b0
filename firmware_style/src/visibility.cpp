#include "urad/visibility.hpp"

#include "urad/log2.hpp"
#include "urad/pair.hpp"
#include "urad/ratio.hpp"
#include "urad/vec.hpp"
#include "visibility_rays.hpp"

namespace urad {

namespace {

constexpr int kFactorTries = 8;  // rays by the cosine law per ray asked for, where they do

/// (tr M_i + tr M_j) / 2 with 31 bits, whatever its size.
uint64_t half_spread_sum(const Patch& i, const Patch& j) noexcept {
  const int32_t log2_half_q24 = log2_spread_sum_q24(i, j) - (1 << 24);
  const int up = greatest(int32_t(shift_down(log2_half_q24, 24)) - 30, 0);
  return uint64_t{exp2_uq(log2_half_q24 - up * (1 << 24), 0)} << up;
}

/// log2 of the mean of the weights of pairs of points closer than the square root of `distance2`, open
/// and shut: pi F / A 2^60 2^-kNearBits, by rays from the smaller patch to the other. The mean itself
/// has no bounded variance where patches touch; this has.
struct NearMean {
  int32_t log2_open_q24, log2_shut_q24;
};
NearMean near_mean(const Patch& i, const PatchSampler& on_i, const Patch& j,
                   const PatchSampler& on_j, uint64_t distance2, int tries, Stop stop,
                   void* context) noexcept {
  const bool from_i = i.shape->log2_area_q24 <= j.shape->log2_area_q24;
  Sequence sequence(j.index, i.index);
  const NearRays rays =
      from_i ? near_rays(i, on_i, j, on_j, distance2, tries, &sequence, stop, context)
             : near_rays(j, on_j, i, on_i, distance2, tries, &sequence, stop, context);
  const int32_t log2_unit_q24 = kLog2Pi_q24 + ((60 - kNearBits) << 24) - log2_q24(rays.sent) -
                                (from_i ? j : i).shape->log2_area_q24;
  const auto mean = [=](uint32_t hits) { return hits ? log2_unit_q24 + log2_q24(hits) : kNoHit; };
  return {mean(rays.open), mean(rays.shut)};
}

}  // namespace

Scaled weight_of(const urad_shape& i, const urad_shape& j, const urad_point& r) noexcept {
  const int64_t p = sparse_dot(i.normal_q30, r), q = -sparse_dot(j.normal_q30, r);
  if (p <= 0 || q <= 0) return {0, 0};
  const uint32_t x = magnitude(r.x), y = magnitude(r.y), z = magnitude(r.z);
  const int drop = greatest(top_bit(x | y | z) - 14, 1);
  const auto square = [drop](uint32_t length) {
    const uint32_t l = (length + (1u << (drop - 1))) >> drop;
    return l * l;
  };
  const int32_t log2_r2_q24 = log2_q24(square(x) + square(y) + square(z)) + drop * (2 << 24);
  const int32_t log2_w_q24 =
      log2_q24(uint64_t(p)) - log2_r2_q24 + (log2_q24(uint64_t(q)) - log2_r2_q24);
  const int32_t whole = shift_down(log2_w_q24, 24);
  return {exp2_uq(log2_w_q24 - whole * (1 << 24), 31), int(whole) - 31};
}

bool faces(const urad_shape& i, const urad_shape& j, const urad_point& r) noexcept {
  return sign_of_dot(i.normal_q30, r) > 0 && sign_of_dot(j.normal_q30, r) < 0;
}

int32_t log2_spread_sum_q24(const Patch& i, const Patch& j) noexcept {
  const int32_t a_q24 = i.shape->log2_spread_q24, b_q24 = j.shape->log2_spread_q24;
  return greatest(a_q24, b_q24) +
         log2_1p_q24(exp2_uq(least(a_q24, b_q24) - greatest(a_q24, b_q24), 24), 24);
}

bool closer_than(const Patch& i, const Patch& j, uint32_t rho_uq16) noexcept {
  const urad_point r = j.centroid - i.centroid;
  return log2_spread_sum_q24(i, j) - log2_q24(uint64_t(dot(r, r))) >
         log2_q24(rho_uq16) - (16 << 24);
}

uint32_t without_rays(const Candidates& candidates, uint32_t rays,
                      urad_counters* counters) noexcept {
  candidates.count(counters);
  if (!candidates.shut() && !candidates.empty()) return kAskRays;
  counters->rays_spared += rays;
  if (!candidates.shut()) return kAllVisible_uq16;
  ++counters->blocked;
  ++counters->shut_unseen;
  return 0;
}

uint32_t without_a_ray(const urad_scene& scene, const Patch& i, const Patch& j) noexcept {
  uint16_t last = 0;
  RunBlockers run(scene, i, nullptr, 0, &last);
  const Candidates candidates(run, j);
  return candidates.empty() && !candidates.shut() ? kAllVisible_uq16 : 0;
}

uint32_t agreed_uq16(const RayPlan& plan, const urad_scene& scene,
                     const Brought& brought) noexcept {
  if (brought.open) return kAllVisible_uq16;
  const uint32_t seen_uq16 = brought.weighed ? 0 : without_a_ray(scene, plan.i, plan.j);
  plan.counters->blocked += seen_uq16 == 0;
  return seen_uq16;
}

uint32_t visible_fraction_uq16(RunBlockers& run, const Patch& receiver, uint16_t rays,
                               bool weighted, urad_counters* counters) noexcept {
  const urad_scene& scene = run.scene();
  const bool turned = run.shooter().index > receiver.index;
  const Patch &i = turned ? receiver : run.shooter(), &j = turned ? run.shooter() : receiver;
  const uint16_t wanted = rays > kMaxRays ? kMaxRays : rays < 1 ? 1 : rays;
  Candidates candidates(run, receiver);
  const uint32_t known = without_rays(candidates, wanted, counters);
  if (known != kAskRays) return known;

  // Patches that may touch: weights of points closer than this are as great as they like.
  const bool touching = weighted && closer_than(i, j, kTouching_uq16);
  const uint64_t near2 = touching ? half_spread_sum(i, j) : 0;
  const PatchSampler on_i(scene, i), on_j(scene, j);
  Sequence sequence(i.index, j.index);
  const auto make = [&](Sequence* from, urad_point* a, urad_point* b) {
    return on_i.point(from->uq31(0), from->uq31(1), a) &&
           on_j.point(from->uq31(2), from->uq31(3), b);
  };
  // More tries than rays: for polygons that are sampled by rejection, and for patches of which only
  // a corner faces the other.
  const RayPlan plan{i, j, &candidates, counters, turned, weighted, near2, wanted, 16 * wanted};
  Brought brought = bring(plan, false, &sequence, make);
  counters->rays += wanted;
  if (brought.agree) return agreed_uq16(plan, scene, brought);
  if (touching) {
    struct Asked {
      Candidates* candidates;
      bool turned;
      urad_counters* counters;
    } asked{&candidates, turned, counters};
    // Rays of near_mean() leave the smaller patch, which may be either.
    if (i.shape->log2_area_q24 > j.shape->log2_area_q24) asked.turned = !turned;
    const Stop stop = [](void* context, const urad_point& a, const urad_point& b) {
      const Asked& to = *static_cast<Asked*>(context);
      return to.candidates->stop(a, b, to.turned, to.counters);
    };
    const NearMean mean = near_mean(i, on_i, j, on_j, near2, kFactorTries * wanted, stop, &asked);
    const int32_t log2_made_q24 = log2_q24(uint32_t(brought.made));
    const auto all = [=](int32_t x) { return x == kNoHit ? kNoHit : x + log2_made_q24; };
    brought.sums.add_near(all(mean.log2_open_q24), all(mean.log2_shut_q24));
  }
  return brought.sums.fraction_uq16();
}

uint32_t visible_fraction_uq16(const urad_scene& scene, const Patch& i, const Patch& j,
                               uint16_t rays, bool weighted, urad_counters* counters,
                               bool reject) noexcept {
  uint16_t last = 0;
  RunBlockers run(scene, i, nullptr, reject ? 0u : uint32_t{skip_off_blockers}, &last);
  return visible_fraction_uq16(run, j, rays, weighted, counters);
}

}  // namespace urad
