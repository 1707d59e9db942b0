#include "urad/visibility.hpp"

#include "urad/log2.hpp"
#include "urad/pair.hpp"
#include "urad/ratio.hpp"
#include "urad/vec.hpp"
#include "visibility_sample.hpp"

namespace urad {

namespace {

constexpr int32_t kOutline = 2;  // scene units by which a ray may miss and still be blocked
constexpr int32_t kOutlineMax = 1 << 28;
constexpr uint32_t kTouching_uq16 = 4096;  // rho above which patches may touch
constexpr int kFactorTries = 8;  // rays by the cosine law per ray asked for, where they do

constexpr int32_t least(int32_t a, int32_t b) noexcept { return a < b ? a : b; }
constexpr int32_t greatest(int32_t a, int32_t b) noexcept { return a < b ? b : a; }

/// Distance from a plane, rounded, so that kPlaneTolerance means the same here and elsewhere.
constexpr bool on_plane(int64_t distance_q30) noexcept {
  return magnitude(round_shift(distance_q30, 30)) <= uint32_t(kPlaneTolerance);
}

constexpr bool apart(int32_t a, int32_t b, int32_t low, int32_t high, int32_t slack) noexcept {
  return greatest(a, b) < low - slack || least(a, b) > high + slack;
}

bool boxes_apart(const urad_point& a, const urad_point& b, const urad_blocker& blocker) noexcept {
  return apart(a.x, b.x, blocker.low.x, blocker.high.x, kOutline) ||
         apart(a.y, b.y, blocker.low.y, blocker.high.y, kOutline) ||
         apart(a.z, b.z, blocker.low.z, blocker.high.z, kOutline);
}

/// Even-odd on the two axes the plane lies along most; within `outline` (2^28 at most) of an edge
/// is inside.
bool holds(const urad_scene& scene, const urad_blocker& blocker, const urad_point& hit,
           int32_t outline) noexcept {
  const Flat flat(blocker.normal_q30);
  const int32_t u = flat.u(hit), v = flat.v(hit);
  bool inside = false;
  const urad_point* vertex = scene.vertex + blocker.first_vertex;
  const urad_point* p = vertex + blocker.vertex_count - 1;
  for (uint16_t k = 0; k < blocker.vertex_count; ++k) {
    const urad_point* const q = vertex + k;
    const int32_t pu = flat.u(*p), pv = flat.v(*p), qu = flat.u(*q), qv = flat.v(*q);
    p = q;
    const bool crosses = (pv > v) != (qv > v);
    const bool near = !apart(pu, qu, u, u, outline) && !apart(pv, qv, v, v, outline);
    if (!crosses && !near) continue;
    const int64_t cross = int64_t{qu - pu} * (v - pv) - int64_t{qv - pv} * (u - pu);
    const uint64_t reach = uint64_t{magnitude(qu - pu)} + magnitude(qv - pv);
    if (near && magnitude(cross) <= uint64_t(outline) * reach) return true;
    if (crosses && (qv > pv ? cross > 0 : cross < 0)) inside = !inside;
  }
  return inside;
}

/// Greatest and least distance of a patch from a blocker's plane.
struct Extent {
  int32_t low, high;
};
Extent extent(const urad_scene& scene, const Patch& patch, const urad_blocker& blocker) noexcept {
  const urad_point& on = scene.vertex[blocker.first_vertex];
  Extent e{INT32_MAX, INT32_MIN};
  for (uint16_t k = 0; k < patch.vertex_count; ++k) {
    const int32_t d = plane_distance(blocker.normal_q30, on, patch_vertex(scene, patch, k));
    e = {least(e.low, d), greatest(e.high, d)};
  }
  return e;
}

void grow(const urad_scene& scene, const Patch& patch, urad_point* low, urad_point* high) noexcept {
  for (uint16_t k = 0; k < patch.vertex_count; ++k) {
    const urad_point p = patch_vertex(scene, patch, k);
    *low = {least(low->x, p.x), least(low->y, p.y), least(low->z, p.z)};
    *high = {greatest(high->x, p.x), greatest(high->y, p.y), greatest(high->z, p.z)};
  }
}

/// Blockers that may stand between two patches: the first few by number, any others from `rest` on.
class Candidates {
 public:
  Candidates(const urad_scene& scene, const Patch& i, const Patch& j, bool reject,
             urad_counters* counters) noexcept
      : scene_(scene), rest_(reject ? scene.blocker_count : uint16_t{0}), any_(!reject) {
    list(i, j);
    const uint32_t kept = uint32_t(count_) + scene.blocker_count - rest_;
    counters->blockers_kept += kept;
    counters->blockers_rejected += scene.blocker_count - kept;
  }

  bool empty() const noexcept { return count_ == 0 && !any_; }

  /// The blocker that stopped a ray is asked first about the next.
  bool stop(const urad_point& a, const urad_point& b, urad_counters* counters) noexcept {
    for (int k = 0; k < count_; ++k) {
      ++counters->ray_tests;
      if (!blocks(scene_, scene_.blocker[listed_[k]], a, b)) continue;
      const uint16_t first = listed_[0];
      listed_[0] = listed_[k];
      listed_[k] = first;
      return true;
    }
    for (uint16_t k = rest_; k < scene_.blocker_count; ++k) {
      ++counters->ray_tests;
      if (blocks(scene_, scene_.blocker[k], a, b)) return true;
    }
    return false;
  }

 private:
  /// Leaves out those beside the common box, and those whose plane the patches do not lie astride.
  void list(const Patch& i, const Patch& j) noexcept {
    const urad_scene& scene = scene_;
    if (rest_ == 0) return;
    urad_point low = patch_vertex(scene, i, 0), high = low;
    grow(scene, i, &low, &high);
    grow(scene, j, &low, &high);
    for (uint16_t b = 0; b < scene.blocker_count; ++b) {
      const urad_blocker& blocker = scene.blocker[b];
      if (boxes_apart(low, high, blocker)) continue;
      const Extent ei = extent(scene, i, blocker), ej = extent(scene, j, blocker);
      constexpr int32_t t = kPlaneTolerance;
      if (!(ei.high > t && ej.low < -t) && !(ei.low < -t && ej.high > t)) continue;
      if (count_ == kListed) {
        rest_ = b;
        return;
      }
      listed_[count_++] = b;
    }
  }

  static constexpr int kListed = 24;
  const urad_scene& scene_;
  uint16_t rest_;
  bool any_;  // rays are made whatever the bounds say
  int count_ = 0;
  uint16_t listed_[kListed];
};

/// Sums of weights of any size: 64 bits over the exponent of the greatest so far.
class Sums {
 public:
  void add(const Scaled& weight, bool open, bool near) noexcept {
    if (weight.mantissa == 0) return;
    if (open_count_ + shut_count_ == 0) exponent_ = weight.exponent;
    if (weight.exponent > exponent_) {
      const int up = weight.exponent - exponent_ < 63 ? weight.exponent - exponent_ : 63;
      open_ >>= up, shut_ >>= up, near_ >>= up;
      exponent_ = weight.exponent;
    }
    const int down = exponent_ - weight.exponent;
    const uint32_t share = down < 32 ? weight.mantissa >> down : 0;
    (open ? open_ : shut_) += share;
    ++(open ? open_count_ : shut_count_);
    if (near) near_ += share;
  }

  bool all_open() const noexcept { return shut_count_ == 0; }
  bool all_shut() const noexcept { return open_count_ == 0; }

  /// Puts a value known otherwise, log2 in Q7.24, in the place of the near weights.
  void replace_near(int32_t log2_near_q24) noexcept {
    const uint64_t near =
        log2_near_q24 == kNoHit ? 0 : uint64_t{exp2_uq(log2_near_q24, -exponent_ - 12)} << 12;
    all_ = open_ + shut_ - near_ + near;
  }

  /// The lesser of open and shut over all weights.
  uint32_t fraction_uq16() const noexcept {
    const uint64_t lesser = open_ < shut_ ? open_ : shut_, all = all_ ? all_ : open_ + shut_;
    const int64_t part_uq24 = all ? ratio_q(int64_t(lesser), int64_t(all), 24) : 0;
    const uint32_t part_uq16 =
        part_uq24 < 1 << 24 ? uint32_t(round_shift(part_uq24, 8)) : kAllVisible_uq16;
    const uint32_t f_uq16 = open_ < shut_ ? part_uq16 : kAllVisible_uq16 - part_uq16;
    return f_uq16 < 1 ? 1 : f_uq16 >= kAllVisible_uq16 ? kAllVisible_uq16 - 1 : f_uq16;
  }

 private:
  uint64_t open_ = 0, shut_ = 0, near_ = 0, all_ = 0;
  int exponent_ = 0;
  uint32_t open_count_ = 0, shut_count_ = 0;
};

/// cos cos / r^2 times 2^60: (n_i . r)(-n_j . r) / r^4. Nothing when one end looks away.
Scaled weight_of(const urad_shape& i, const urad_shape& j, const urad_point& r) noexcept {
  const int64_t p = dot(i.normal_q30, r), q = -dot(j.normal_q30, r);
  if (p <= 0 || q <= 0) return {0, 0};
  const Scaled r2 = scaled(uint64_t(dot(r, r)));
  return scaled(uint64_t(p)) / r2 * (scaled(uint64_t(q)) / r2);
}

int32_t log2_spread_sum_q24(const Patch& i, const Patch& j) noexcept {
  const int32_t a_q24 = i.shape->log2_spread_q24, b_q24 = j.shape->log2_spread_q24;
  return greatest(a_q24, b_q24) +
         log2_1p_q24(exp2_uq(least(a_q24, b_q24) - greatest(a_q24, b_q24), 24), 24);
}

/// (tr M_i + tr M_j) / 2 with 31 bits, whatever its size.
uint64_t half_spread_sum(const Patch& i, const Patch& j) noexcept {
  const int32_t log2_half_q24 = log2_spread_sum_q24(i, j) - (1 << 24);
  const int up = greatest(int32_t(shift_down(log2_half_q24, 24)) - 30, 0);
  return uint64_t{exp2_uq(log2_half_q24 - up * (1 << 24), 0)} << up;
}

/// log2 of the mean of the weights of pairs of points closer than the square root of `distance2`:
/// pi F / A 2^60, by rays from the smaller patch to the other. The mean itself has no bounded
/// variance where patches touch; this has.
int32_t log2_near_mean_q24(const Patch& i, const PatchSampler& on_i, const Patch& j,
                           const PatchSampler& on_j, uint64_t distance2, int tries) noexcept {
  const bool from_i = i.shape->log2_area_q24 <= j.shape->log2_area_q24;
  Sequence sequence(j.index, i.index);
  const int32_t log2_f_q24 =
      from_i ? log2_factor_by_rays_q24(i, on_i, j, on_j, distance2, tries, &sequence)
             : log2_factor_by_rays_q24(j, on_j, i, on_i, distance2, tries, &sequence);
  if (log2_f_q24 == kNoHit) return kNoHit;
  return kLog2Pi_q24 + (60 << 24) + log2_f_q24 - (from_i ? j : i).shape->log2_area_q24;
}

}  // namespace

bool blocks(const urad_scene& scene, const urad_blocker& blocker, const urad_point& a,
            const urad_point& b) noexcept {
  if (boxes_apart(a, b, blocker)) return false;
  const urad_point& on = scene.vertex[blocker.first_vertex];
  const int64_t side_a = dot(blocker.normal_q30, a - on), side_b = dot(blocker.normal_q30, b - on);
  if ((side_a < 0) == (side_b < 0) || on_plane(side_a) || on_plane(side_b)) return false;
  const int64_t share = int64_t(magnitude(side_a)), whole = share + int64_t(magnitude(side_b));
  const int64_t along_q31 = ratio_q(share, whole, 31);
  // A ray moved by kOutline across the plane meets it this much elsewhere: more where it grazes.
  const int64_t length =
      int64_t{magnitude(b.x - a.x)} + magnitude(b.y - a.y) + magnitude(b.z - a.z);
  const int64_t outline = ratio_q(length * kOutline, whole >> 30, 0) + kOutline;
  const auto at = [=](int32_t p, int32_t q) {
    return p + int32_t(round_shift((q - p) * along_q31, 31));
  };
  return holds(scene, blocker, {at(a.x, b.x), at(a.y, b.y), at(a.z, b.z)},
               outline < kOutlineMax ? int32_t(outline) : kOutlineMax);
}

bool closer_than(const Patch& i, const Patch& j, uint32_t rho_uq16) noexcept {
  const urad_point r = j.centroid - i.centroid;
  return log2_spread_sum_q24(i, j) - log2_q24(uint64_t(dot(r, r))) >
         log2_q24(rho_uq16) - (16 << 24);
}

uint32_t visible_fraction_uq16(const urad_scene& scene, const Patch& one, const Patch& other,
                               uint16_t rays, bool weighted, urad_counters* counters,
                               bool reject) noexcept {
  const bool in_order = one.index <= other.index;
  const Patch &i = in_order ? one : other, &j = in_order ? other : one;
  const uint16_t wanted = rays < 1 ? 1 : rays > kMaxRays ? kMaxRays : rays;
  Candidates candidates(scene, i, j, reject, counters);
  if (candidates.empty()) {
    counters->rays_spared += wanted;
    return kAllVisible_uq16;
  }

  // Patches that may touch: weights of points closer than this are as great as they like.
  const bool touching = weighted && closer_than(i, j, kTouching_uq16);
  const uint64_t near2 = touching ? half_spread_sum(i, j) : 0;
  const PatchSampler on_i(scene, i), on_j(scene, j);
  Sequence sequence(i.index, j.index);
  Sums sums;
  int made = 0;
  // Only polygons that are sampled by rejection ever use up the tries.
  for (int tries = 16 * wanted; made < wanted && tries > 0; --tries) {
    urad_point a, b;
    sequence.advance();
    if (!on_i.point(sequence.uq31(0), sequence.uq31(1), &a)) continue;
    if (!on_j.point(sequence.uq31(2), sequence.uq31(3), &b)) continue;
    ++made;
    const urad_point r = b - a;
    Scaled weight = weight_of(*i.shape, *j.shape, r);
    if (weight.mantissa == 0) continue;
    if (!weighted) weight = {0x80000000u, 0};
    sums.add(weight, !candidates.stop(a, b, counters), uint64_t(dot(r, r)) < near2);
  }
  counters->rays += uint32_t(made);
  if (sums.all_open()) return kAllVisible_uq16;
  if (sums.all_shut()) {
    ++counters->blocked;
    return 0;
  }
  if (touching) {
    const int32_t log2_mean_q24 =
        log2_near_mean_q24(i, on_i, j, on_j, near2, kFactorTries * wanted);
    sums.replace_near(log2_mean_q24 == kNoHit ? kNoHit : log2_mean_q24 + log2_q24(uint32_t(made)));
  }
  return sums.fraction_uq16();
}

}  // namespace urad
