// Whether a blocker stands across a ray.
#include "visibility_block.hpp"

#include "urad/ratio.hpp"
#include "urad/vec.hpp"
#include "urad/visibility.hpp"
#include "visibility_sample.hpp"

namespace urad {

namespace {

constexpr int32_t kOutlineMax = 1 << 28;

/// Distance from a plane, rounded, so that kPlaneTolerance means the same here and elsewhere.
constexpr bool on_plane(int64_t distance_q30) noexcept {
  return magnitude(round_shift(distance_q30, 30)) <= uint32_t(kPlaneTolerance);
}

enum class Hit : uint8_t { outside, near, inside };

/// Even-odd on the two axes the plane lies along most; `near`: outside, and within `outline` (2^28 at
/// most) of an edge.
Hit hit_at(const urad_scene& scene, const urad_blocker& blocker, const Flat& flat, int32_t u,
           int32_t v, int32_t outline) noexcept {
  bool inside = false, beside = false;
  const urad_point* vertex = scene.vertex + blocker.first_vertex;
  const urad_point* p = vertex + blocker.vertex_count - 1;
  for (uint16_t k = 0; k < blocker.vertex_count; ++k) {
    const urad_point* const q = vertex + k;
    const int32_t pu = flat.u(*p), pv = flat.v(*p), qu = flat.u(*q), qv = flat.v(*q);
    p = q;
    const bool crosses = (pv > v) != (qv > v), before = crosses && u < least(pu, qu);
    const bool near = !apart(pu, qu, u, u, outline) && !apart(pv, qv, v, v, outline);
    if (before) inside = !inside;
    if (!near && (before || !crosses || u > greatest(pu, qu))) continue;
    const int64_t cross = wide_mul(qu - pu, v - pv) - wide_mul(qv - pv, u - pu);
    const uint64_t reach = uint64_t{magnitude(qu - pu)} + magnitude(qv - pv);
    beside = beside || (near && magnitude(cross) <= uint64_t(outline) * reach);
    if (crosses && !before && (qv > pv ? cross > 0 : cross < 0)) inside = !inside;
  }
  return inside ? Hit::inside : beside ? Hit::near : Hit::outside;
}

}  // namespace

bool stands_across(const urad_scene& scene, const urad_blocker& blocker, const urad_point& a,
                   const urad_point& b, int side_a, int side_b) noexcept {
  const urad_point& on = scene.vertex[blocker.first_vertex];
  const int64_t d_a = sparse_dot(blocker.normal_q30, a - on),
                d_b = sparse_dot(blocker.normal_q30, b - on);
  if ((side_a == 0 && on_plane(d_a)) || (side_b == 0 && on_plane(d_b))) return false;
  const auto away = [](int64_t d, int side) {
    return side == 0 || (d < 0) == (side < 0) ? int64_t(magnitude(d)) : 0;
  };
  const bool behind_a = side_a ? side_a < 0 : d_a < 0, behind_b = side_b ? side_b < 0 : d_b < 0;
  if (behind_a == behind_b) return false;
  const int64_t share = away(d_a, side_a), whole = share + away(d_b, side_b);
  // Along the plane, from one side to the other.
  if (whole >> 30 == 0) return !boxes_apart(a, b, blocker.low, blocker.high);
  const int64_t along_q31 = ratio_q(share, whole, 31);
  const auto at = [=](int32_t p, int32_t q) {
    return p == q ? p : p + int32_t(round_shift((q - p) * along_q31, 31));
  };
  const Flat flat(blocker.normal_q30);
  const int32_t u = at(flat.u(a), flat.u(b)), v = at(flat.v(a), flat.v(b));
  // A ray moved by kOutline across the plane meets it this much elsewhere: more where it grazes. Most
  // rays are judged by a bound of that, the next power of two.
  const int64_t length =
      int64_t{magnitude(b.x - a.x)} + magnitude(b.y - a.y) + magnitude(b.z - a.z);
  const int log2_bound = top_bit(uint64_t(length)) + 3 - top_bit(uint64_t(whole >> 30));
  const auto within = [](int64_t outline) {
    return outline < kOutlineMax ? int32_t(outline) : kOutlineMax;
  };
  const int64_t bound = (int64_t{1} << greatest(log2_bound, 0)) + kOutline;
  const Hit hit = hit_at(scene, blocker, flat, u, v, within(bound));
  if (hit == Hit::outside || boxes_apart(a, b, blocker.low, blocker.high)) return false;
  if (hit == Hit::inside) return true;
  const int64_t outline = ratio_q(length * kOutline, whole >> 30, 0) + kOutline;
  return hit_at(scene, blocker, flat, u, v, within(outline)) != Hit::outside;
}

bool blocks(const urad_scene& scene, const urad_blocker& blocker, const urad_point& a,
            const urad_point& b) noexcept {
  return stands_across(scene, blocker, a, b, 0, 0);
}

}  // namespace urad
