// All-or-nothing rays: where rays between two patches disagree, smaller parts are asked.
#include "urad/vec.hpp"
#include "visibility_rays.hpp"

namespace urad {

namespace {

/// A part of the one patch as seen from a part of the other: cells of 2^-level in x and y.
struct Part {
  uint8_t level[2];
  uint8_t x[2], y[2];
  uint8_t cuts() const noexcept { return uint8_t(level[0] + level[1]); }
};

constexpr uint32_t within(uint32_t u_uq31, uint8_t cell, uint8_t level) noexcept {
  return (uint32_t{cell} << (31 - level)) + (u_uq31 >> level);
}

struct Pieces {
  const Patch* patch[2];
  const PatchSampler* sampler[2];

  bool point(int side, const Part& part, uint32_t x_uq31, uint32_t y_uq31,
             urad_point* p) const noexcept {
    return sampler[side]->point(within(x_uq31, part.x[side], part.level[side]),
                                within(y_uq31, part.y[side], part.level[side]), p);
  }

  /// The side whose part is the larger.
  int larger(const Part& part) const noexcept {
    const auto log2_size_q24 = [&](int side) {
      return patch[side]->shape->log2_spread_q24 - part.level[side] * (2 << 24);
    };
    return log2_size_q24(0) >= log2_size_q24(1) ? 0 : 1;
  }
};

/// Adds the mean of a part's rays, times its share of both areas. Points beside a polygon that is no
/// parallelogram bring nothing, which is their share.
void collect(const Part& part, const Brought& from, Sums* to) noexcept {
  for (int k = 0; k < 2; ++k) {
    const bool open = k != 0;
    Scaled share = from.sums.total(open) / scaled(uint64_t(from.tried));
    share.exponent -= 2 * part.cuts();
    to->add(share, open, false);
  }
}

constexpr int kMostRays = 256;

constexpr int clamped(int x, int low, int high) noexcept {
  return x < low ? low : x > high ? high : x;
}

}  // namespace

uint32_t adaptive_fraction_uq16(const urad_scene& scene, const Patch& i, const Patch& j,
                                const AdaptiveRays& plan, uint32_t f_uq32, urad_counters* counters,
                                bool reject) noexcept {
  uint16_t last = 0;
  RunBlockers run(scene, i, nullptr, reject ? 0u : uint32_t{skip_off_blockers}, &last);
  return adaptive_fraction_uq16(run, j, plan, f_uq32, counters);
}

uint32_t adaptive_fraction_uq16(RunBlockers& run, const Patch& receiver, const AdaptiveRays& plan,
                                uint32_t f_uq32, urad_counters* counters) noexcept {
  int rays = clamped(plan.rays, 4, kMostRays);
  const int depth = clamped(plan.depth, 0, kMaxDepth);
  if (closer_than(run.shooter(), receiver, kTouching_uq16)) {
    // Not cut, since the rays of touching parts have no bounded worth: more rays where more is lost.
    for (uint64_t e = uint64_t{plan.error_uq32} << 4; rays < kMostRays && f_uq32 > e; e <<= 1)
      rays = least(2 * rays, kMostRays);
    return visible_fraction_uq16(run, receiver, uint16_t(rays), true, counters);
  }
  const urad_scene& scene = run.scene();
  const bool turned = run.shooter().index > receiver.index;
  const Patch &i = turned ? receiver : run.shooter(), &j = turned ? run.shooter() : receiver;
  Candidates candidates(run, receiver);
  const uint32_t known = without_rays(candidates, uint32_t(rays), counters);
  if (known != kAskRays) return known;
  const PatchSampler on_i(scene, i), on_j(scene, j);
  const Pieces pieces{{&i, &j}, {&on_i, &on_j}};
  Sequence sequence(i.index, j.index);
  Sums sums;
  Part stack[3 * kMaxDepth + 1];
  int parts = 0;
  stack[parts++] = {{0, 0}, {0, 0}, {0, 0}};
  // The error of n rays falls by half when n is doubled
  // and a bit more: pairs with a quarter of the factor can do with half the rays.
  int log2_first = top_bit(uint32_t(rays));
  for (uint32_t e = plan.error_uq32; log2_first > 2 && f_uq32 <= e; e >>= 2) --log2_first;
  const int log2_later = greatest(3, log2_first > 5 ? log2_first - 1 : log2_first);
  while (parts > 0) {
    const Part part = stack[--parts];
    const int log2_rays = part.cuts() ? log2_later : log2_first;
    const int wanted = 1 << log2_rays;
    const RayPlan plan_of_part{
        i, j, &candidates, counters, turned, true, 0, wanted, (part.cuts() ? 4 : 16) * wanted};
    const auto make = [&](Sequence* from, urad_point* a, urad_point* b) {
      return pieces.point(0, part, from->uq31(0), from->uq31(1), a) &&
             pieces.point(1, part, from->uq31(2), from->uq31(3), b);
    };
    const Brought brought = bring(plan_of_part, part.cuts() > 0, &sequence, make);
    counters->rays += uint32_t(wanted);
    if (brought.agree && part.cuts() == 0) return agreed_uq16(plan_of_part, scene, brought);
    if (brought.agree || part.cuts() == depth || f_uq32 >> (2 * part.cuts()) <= plan.error_uq32) {
      collect(part, brought, &sums);
      continue;
    }
    const int side = pieces.larger(part);
    for (int quarter = 0; quarter < 4; ++quarter) {
      Part& next = stack[parts++];
      next = part;
      ++next.level[side];
      next.x[side] = uint8_t(2 * part.x[side] + (quarter & 1));
      next.y[side] = uint8_t(2 * part.y[side] + (quarter >> 1));
    }
  }
  const uint32_t seen_uq16 = sums.none() ? without_a_ray(scene, i, j) : 0;
  if (sums.all_shut()) {
    counters->blocked += seen_uq16 == 0;
    return seen_uq16;
  }
  if (sums.all_open()) return kAllVisible_uq16;
  return sums.fraction_uq16();
}

}  // namespace urad
