#include "visibility_shadow.hpp"

#include "urad/vec.hpp"
#include "visibility_sample.hpp"

namespace urad {

namespace {

constexpr int kCoarse = 16;  // bits dropped: |coordinate| <= 2^13

void add(const urad_point& p, Reach* reach) noexcept { stretch(p, p, &reach->low, &reach->high); }

void add(int32_t distance, PlaneSide* side) noexcept {
  side->front = side->front || distance > kPlaneTolerance;
  side->behind = side->behind || distance < -kPlaneTolerance;
  side->far = side->far && magnitude(distance) >= uint32_t(kShadowGap);
}

/// The plane through an edge and a corner: normal of 15 bits, times 2^exponent.
struct EdgePlane {
  urad_point normal;

  EdgePlane(const urad_point& u, const urad_point& v, int exponent) noexcept
      : normal{shift_down(u.y * v.z - u.z * v.y, exponent),
               shift_down(u.z * v.x - u.x * v.z, exponent),
               shift_down(u.x * v.y - u.y * v.x, exponent)} {}
  int32_t height(const urad_point& w) const noexcept {
    return normal.x * w.x + normal.y * w.y + normal.z * w.z;
  }
};

constexpr int kMargin = 3;  // bits: 24 l^2 = 3 l^2 2^3
constexpr uint32_t kLeastSize = 64;

/// 1: all segments pass outside of the edge, -1: all inside, 0: neither is certain. l: no coordinate
/// of a difference is greater. Of a volume of three differences, each off by a unit an axis:
///   their rounding            3 x sqrt 3 x 3 l^2 = 15.6 l^2, and 32 l of higher order
///   the normal's dropped bits 3 l 2^exponent <= 6 l^2, as 2^exponent <= 2 l^2 / 2^14 and l <= 2^14
///   rays moved by kOutline    below l^2 where a side is far
/// together less than 24 l^2 for l >= 64.
int side_of_edge(const urad_point& p, const urad_point& q, const Reach& from, const Reach& to,
                 int turn, const CoarseScale& scale) noexcept {
  int all = 0;
  for (int m = 0; m < from.corners; ++m) {
    const urad_point& a = from.corner[m];
    const EdgePlane plane(p - a, q - a, scale.exponent);
    for (int n = 0; n < to.corners; ++n) {
      const int32_t height = plane.height(to.corner[n] - a);
      if (magnitude(height) <= scale.margin) return 0;
      const int side = (height > 0) == (turn > 0) ? 1 : -1;
      if (side == -all) return 0;
      all = side;
    }
  }
  return all;
}

}  // namespace

urad_point coarse(const urad_point& p) noexcept {
  constexpr int32_t half = 1 << (kCoarse - 1);
  return {shift_down(p.x + half, kCoarse), shift_down(p.y + half, kCoarse),
          shift_down(p.z + half, kCoarse)};
}

CoarseScale coarse_scale(const urad_blocker& blocker, const Reach& i, const Reach& j) noexcept {
  const auto along = [](int32_t low_b, int32_t high_b, int32_t low_i, int32_t high_i, int32_t low_j,
                        int32_t high_j) {
    return shift_down(greatest(high_b, greatest(high_i, high_j)), kCoarse) -
           shift_down(least(low_b, least(low_i, low_j)), kCoarse) + 1;
  };
  const urad_point &bl = blocker.low, &bh = blocker.high;
  const auto l =
      uint32_t(greatest(along(bl.x, bh.x, i.low.x, i.high.x, j.low.x, j.high.x),
                        greatest(along(bl.y, bh.y, i.low.y, i.high.y, j.low.y, j.high.y),
                                 along(bl.z, bh.z, i.low.z, i.high.z, j.low.z, j.high.z))));
  const int exponent = greatest(top_bit(2 * l * l) - 14, 0);
  if (l < kLeastSize || exponent < kMargin) return {0, ~0u};
  return {exponent, 3 * l * l >> (exponent - kMargin)};
}

Reach reach_of(const urad_scene& scene, const Patch& patch) noexcept {
  Reach reach;
  reach.low = reach.high = patch_vertex(scene, patch, 0);
  reach.corners = patch.vertex_count <= 4 ? uint8_t(patch.vertex_count) : uint8_t{0};
  for (uint16_t k = 0; k < patch.vertex_count; ++k) {
    const urad_point p = patch_vertex(scene, patch, k);
    if (k < reach.corners) reach.vertex[k] = p, reach.corner[k] = coarse(p);
    add(p, &reach);
  }
  return reach;
}

Reach reach_of(const urad_grid& grid) noexcept {
  Reach reach;
  reach.low = reach.high = grid.origin;
  reach.corners = 4;
  for (int k = 0; k < 4; ++k) {
    const urad_point p = corner_of(grid, k);
    reach.vertex[k] = p, reach.corner[k] = coarse(p);
    add(p, &reach);
  }
  return reach;
}

PlaneSide plane_side(const urad_scene& scene, const Patch& patch,
                     const urad_blocker& blocker) noexcept {
  const urad_point& on = scene.vertex[blocker.first_vertex];
  PlaneSide side{false, false, true};
  for (uint16_t k = 0; k < patch.vertex_count; ++k)
    add(plane_distance(blocker.normal_q30, on, patch_vertex(scene, patch, k)), &side);
  return side;
}

PlaneSide plane_side(const urad_scene& scene, const Reach& grid,
                     const urad_blocker& blocker) noexcept {
  const urad_point& on = scene.vertex[blocker.first_vertex];
  PlaneSide side{false, false, true};
  for (int k = 0; k < grid.corners; ++k)
    add(plane_distance(blocker.normal_q30, on, grid.vertex[k]), &side);
  return side;
}

PlaneSide plane_side(const urad_scene& scene, const Patch& patch, const Reach& reach,
                     const urad_blocker& blocker) noexcept {
  return reach.corners ? plane_side(scene, reach, blocker) : plane_side(scene, patch, blocker);
}

int8_t turn_of(const urad_scene& scene, const urad_blocker& blocker) noexcept {
  const Flat flat(blocker.normal_q30);
  const urad_point* vertex = scene.vertex + blocker.first_vertex;
  const urad_point *p = vertex + blocker.vertex_count - 2, *q = p + 1;
  bool left = false, right = false;
  int reversals = 0, heading = 0, first_heading = 0;
  for (uint16_t k = 0; k < blocker.vertex_count; ++k) {
    const urad_point* const r = vertex + k;
    const int32_t du = flat.u(*r) - flat.u(*q), dv = flat.v(*r) - flat.v(*q);
    const int64_t turn =
        wide_mul(flat.u(*q) - flat.u(*p), dv) - wide_mul(flat.v(*q) - flat.v(*p), du);
    left = left || turn > 0;
    right = right || turn < 0;
    // A convex loop goes up once and down once; a star that turns one way only does so twice.
    const int now = dv > 0 || (dv == 0 && du > 0) ? 1 : dv < 0 || du < 0 ? -1 : heading;
    reversals += heading != 0 && now != heading;
    if (first_heading == 0) first_heading = now;
    heading = now;
    p = q, q = r;
  }
  reversals += heading != first_heading;
  if (left == right || reversals > 2) return 0;
  // Flat keeps the order of axes but for y dropped, which turns the plane over.
  const bool over = flat.is_mirror() != (flat.dropped(blocker.normal_q30) < 0);
  return left != over ? int8_t{1} : int8_t{-1};
}

Shadow shadow(const urad_scene& scene, const urad_blocker& blocker, int turn, const Reach& from,
              const Reach& to, Edges* edges, uint8_t* first) noexcept {
  if (from.corners == 0 || to.corners == 0) return Shadow::part;
  const CoarseScale scale = coarse_scale(blocker, from, to);
  if (scale.margin == ~0u) return Shadow::part;
  const urad_point* vertex = scene.vertex + blocker.first_vertex;
  bool all = true;
  uint16_t edge = *first;
  for (uint16_t k = 0; k < blocker.vertex_count; ++k) {
    if (edges->holds(edge)) {
      const uint16_t before = uint16_t((edge ? edge : blocker.vertex_count) - 1);
      const int side =
          side_of_edge(coarse(vertex[before]), coarse(vertex[edge]), from, to, turn, scale);
      if (side > 0) {
        *first = uint8_t(edge);
        return Shadow::none;
      }
      if (side < 0) edges->remove(edge);
      all = all && side < 0;
    }
    edge = uint16_t(edge + 1 == blocker.vertex_count ? 0 : edge + 1);
  }
  return all ? Shadow::all : Shadow::part;
}

Shadow ray_shadow(const urad_scene& scene, const urad_blocker& blocker, int turn,
                  const CoarseScale& scale, Edges edges, const urad_point& from,
                  const urad_point& to) noexcept {
  if (scale.margin == ~0u) return Shadow::part;
  const urad_point* vertex = scene.vertex + blocker.first_vertex;
  const urad_point ray = to - from;
  Shadow cast = Shadow::all;
  for (uint16_t k = 0; k < blocker.vertex_count; ++k) {
    if (!edges.holds(k)) continue;
    const uint16_t before = uint16_t((k ? k : blocker.vertex_count) - 1);
    const EdgePlane plane(coarse(vertex[before]) - from, coarse(vertex[k]) - from, scale.exponent);
    const int32_t height = plane.height(ray);
    if (magnitude(height) <= scale.margin)
      cast = Shadow::part;
    else if ((height > 0) == (turn > 0))
      return Shadow::none;
  }
  return cast;
}

}  // namespace urad
