// visibility_shadow.hpp -- what a blocker does to all segments between two patches at once.
//
// Segments from the corners a of the one to the corners b of the other meet the plane of a blocker in
// points whose convex hull is all that the patches send across. An edge p q of a convex blocker has all
// of it outside or inside when the volumes (p - a) x (q - a) . (b - a) have one sign: outside one edge,
// nothing is stopped, and that holds for any b; inside all edges, everything is.
#pragma once
#include "urad/patch.hpp"
#include "visibility_block.hpp"

namespace urad {

/// Corners count in units of 2^16 scene units: differences of them, and their products, fit 32 bits.
urad_point coarse(const urad_point& p) noexcept;

/// Box and corners of a patch or of a whole grid.
struct Reach {
  urad_point low, high;  ///< scene units
  urad_point vertex[4];  ///< of the corners, scene units
  urad_point corner[4];  ///< coarse
  uint8_t corners;       ///< 0: more than four; the box alone
};
Reach reach_of(const urad_scene& scene, const Patch& patch) noexcept;
Reach reach_of(const urad_grid& grid) noexcept;

/// Where corners lie to the plane of a blocker.
struct PlaneSide {
  bool front : 1, behind : 1;  ///< some corner does, by more than kPlaneTolerance
  bool far : 1;                ///< all keep a distance of kShadowGap
  /// The side that all lie on, to within kPlaneTolerance; 0: on both.
  constexpr int8_t side() const noexcept {
    return !behind ? int8_t{1} : !front ? int8_t{-1} : int8_t{0};
  }
  /// So does every part of what has these corners.
  constexpr bool holds_for_parts() const noexcept { return far && front != behind; }
};
PlaneSide plane_side(const urad_scene& scene, const Patch& patch,
                     const urad_blocker& blocker) noexcept;
/// reach: of the patch.
PlaneSide plane_side(const urad_scene& scene, const Patch& patch, const Reach& reach,
                     const urad_blocker& blocker) noexcept;
/// Of a grid.
PlaneSide plane_side(const urad_scene& scene, const Reach& grid,
                     const urad_blocker& blocker) noexcept;

/// One end keeps this distance, so that rays moved by kOutline meet the plane nearby.
inline constexpr int32_t kShadowGap = 1 << 18;

/// 1 when the loop is convex and runs counter-clockwise about the blocker's normal, -1 clockwise, 0
/// not convex.
int8_t turn_of(const urad_scene& scene, const urad_blocker& blocker) noexcept;

enum class Shadow : uint8_t { none, part, all };

/// What the longest side of the box around a blocker and two patches says of volumes in it.
struct CoarseScale {
  int exponent;     ///< bits of normals to drop
  uint32_t margin;  ///< volumes below it say nothing; all bits: none does, the box is small
};
CoarseScale coarse_scale(const urad_blocker& blocker, const Reach& i, const Reach& j) noexcept;

/// Edges of a blocker that segments may pass outside of, by number: the first 16, the others are always
/// among them.
class Edges {
 public:
  constexpr bool holds(uint16_t edge) const noexcept { return edge >= 16 || bits_ >> edge & 1u; }
  constexpr void remove(uint16_t edge) noexcept {
    if (edge < 16) bits_ = uint16_t(bits_ & ~(1u << edge));
  }

 private:
  uint16_t bits_ = 0xFFFF;
};

/// `from` lies on one side of the blocker's plane and is far, `to` may lie anywhere. turn: that of the
/// loop seen from the side of `from`, not 0. `part` when in doubt: volumes of coarse coordinates count only
/// where no rounding of theirs can change the sign. `all` only
/// means something when `to` lies on the other side.
///   edges  looked at; those that all segments pass inside of are removed. They need no look for parts
///          of `from` and `to`.
///   first  this edge is looked at first; where the answer is `none`, the one that says so
///   Cost   30 products of 32 bits a corner and edge, none of 64
Shadow shadow(const urad_scene& scene, const urad_blocker& blocker, int turn, const Reach& from,
              const Reach& to, Edges* edges, uint8_t* first) noexcept;

/// The same for one ray, by coarse points of the two patches; the scale is that of both and the
/// blocker. `none` and `all` are what stands_across() says.
Shadow ray_shadow(const urad_scene& scene, const urad_blocker& blocker, int turn,
                  const CoarseScale& scale, Edges edges, const urad_point& from,
                  const urad_point& to) noexcept;

}  // namespace urad
