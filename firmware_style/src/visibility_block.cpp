// Which blockers can stand between two patches, and whether one stands across a ray.
#include "urad/ratio.hpp"
#include "urad/vec.hpp"
#include "visibility_rays.hpp"

namespace urad {

namespace {

constexpr int32_t kOutline = 2;  // scene units by which a ray may miss and still be blocked
constexpr int32_t kOutlineMax = 1 << 28;

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

/// Whether the blocker stands across the segment from a to b. side_a, side_b: the side of its plane
/// that the end is known to lie on, whatever the rounding of the point says; 0: what the point says,
/// and an end on the plane is not blocked.
bool stands_across(const urad_scene& scene, const urad_blocker& blocker, const urad_point& a,
                   const urad_point& b, int side_a, int side_b) noexcept {
  if (boxes_apart(a, b, blocker)) return false;
  const urad_point& on = scene.vertex[blocker.first_vertex];
  const int64_t d_a = dot(blocker.normal_q30, a - on), d_b = dot(blocker.normal_q30, b - on);
  if ((side_a == 0 && on_plane(d_a)) || (side_b == 0 && on_plane(d_b))) return false;
  const auto away = [](int64_t d, int side) {
    return side == 0 || (d < 0) == (side < 0) ? int64_t(magnitude(d)) : 0;
  };
  const bool behind_a = side_a ? side_a < 0 : d_a < 0, behind_b = side_b ? side_b < 0 : d_b < 0;
  if (behind_a == behind_b) return false;
  const int64_t share = away(d_a, side_a), whole = share + away(d_b, side_b);
  if (whole >> 30 == 0) return true;  // along the plane, from one side to the other
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

/// The side that a patch lies on as a whole, to within kPlaneTolerance.
constexpr int8_t side_of(const Extent& e) noexcept {
  return e.low >= -kPlaneTolerance ? int8_t{1} : e.high <= kPlaneTolerance ? int8_t{-1} : int8_t{0};
}

}  // namespace

bool blocks(const urad_scene& scene, const urad_blocker& blocker, const urad_point& a,
            const urad_point& b) noexcept {
  return stands_across(scene, blocker, a, b, 0, 0);
}

Candidates::Candidates(const urad_scene& scene, const Patch& i, const Patch& j, bool reject,
                       urad_counters* counters) noexcept
    : scene_(scene),
      i_(i),
      j_(j),
      rest_(reject ? scene.blocker_count : uint16_t{0}),
      any_(!reject) {
  list();
  const uint32_t kept = uint32_t(count_) + scene.blocker_count - rest_;
  counters->blockers_kept += kept;
  counters->blockers_rejected += scene.blocker_count - kept;
}

bool Candidates::astride(const urad_blocker& blocker, Listed* entry) const noexcept {
  const Extent ei = extent(scene_, i_, blocker), ej = extent(scene_, j_, blocker);
  constexpr int32_t t = kPlaneTolerance;
  entry->side_i = side_of(ei), entry->side_j = side_of(ej);
  return (ei.high > t && ej.low < -t) || (ei.low < -t && ej.high > t);
}

void Candidates::list() noexcept {
  const urad_scene& scene = scene_;
  if (rest_ == 0) return;
  urad_point low = patch_vertex(scene, i_, 0), high = low;
  grow(scene, i_, &low, &high);
  grow(scene, j_, &low, &high);
  for (uint16_t b = 0; b < scene.blocker_count; ++b) {
    const urad_blocker& blocker = scene.blocker[b];
    if (boxes_apart(low, high, blocker)) continue;
    Listed entry{b, 0, 0};
    if (!astride(blocker, &entry)) continue;
    if (count_ == kListed) {
      rest_ = b;
      return;
    }
    listed_[count_++] = entry;
  }
}

bool Candidates::stop(const urad_point& a, const urad_point& b, urad_counters* counters) noexcept {
  for (int k = 0; k < count_; ++k) {
    ++counters->ray_tests;
    const Listed& asked = listed_[k];
    if (!stands_across(scene_, scene_.blocker[asked.blocker], a, b, asked.side_i, asked.side_j)) {
      continue;
    }
    const Listed first = listed_[0];
    listed_[0] = listed_[k];
    listed_[k] = first;
    return true;
  }
  for (uint16_t k = rest_; k < scene_.blocker_count; ++k) {
    ++counters->ray_tests;
    const urad_blocker& blocker = scene_.blocker[k];
    Listed entry{k, 0, 0};
    if (boxes_apart(a, b, blocker) || !astride(blocker, &entry)) continue;
    if (stands_across(scene_, blocker, a, b, entry.side_i, entry.side_j)) return true;
  }
  return false;
}

}  // namespace urad
