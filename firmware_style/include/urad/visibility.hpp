// visibility.hpp -- which part of what two patches would exchange gets past the blockers, by rays.
#pragma once
#include "urad/patch.hpp"
#include "urad/source.h"

namespace urad {

inline constexpr uint16_t kMaxRays = 1024;
inline constexpr uint32_t kAllVisible_uq16 = 65536;

/// True when the blocker stands across the segment from a to b. A blocker whose plane contains an
/// end point to within kPlaneTolerance never does, so that neither a patch's own surface nor a wall
/// it touches blocks it. A ray that would be blocked if it were moved by two scene units is
/// blocked: none slips between polygons that share an edge.
///   Precision   sides exact in 64 bits; the point of crossing to one scene unit (30-bit quotient)
bool blocks(const urad_scene& scene, const urad_blocker& blocker, const urad_point& a,
            const urad_point& b) noexcept;

/// rho = (tr M_i + tr M_j) / R^2 above this (UQ16.16, not 0), by log2 to 1e-5. Patches with one
/// centre are close.
bool closer_than(const Patch& i, const Patch& j, uint32_t rho_uq16) noexcept;

/// Fraction of the light exchanged by patches i and j that passes all blockers, UQ16.16: 0 exactly
/// when every ray is blocked, 65536 when none is. `rays` (1 .. kMaxRays, clamped) segments join
/// points of Sobol's sequence in four dimensions, moved by an offset that depends
/// on the pair; the same for (i, j) and (j, i). `weighted` weighs a ray by cos cos / r^2: the
/// fraction of the form factor, not of the rays. Where patches may touch (rho > 1/16) the sum of
/// all weights has no bounded variance: its part below the distance sqrt(S/2), S the sum of the two
/// tr M, then comes from 8 more rays each that leave by the cosine law.
/// Segments that leave or meet a patch from behind count for nothing, and others are made in their
/// place, 16 tries a ray at most; 0 when none is found.
/// Blockers that cannot reach between the patches are left out beforehand; when none remains, or one
/// shuts off everything between them, no ray is made, and the rays asked for count as spared. reject =
/// false keeps all blockers, for tests: the same fraction.
uint32_t visible_fraction_uq16(const urad_scene& scene, const Patch& i, const Patch& j,
                               uint16_t rays, bool weighted, urad_counters* counters,
                               bool reject = true) noexcept;

/// The same for a receiver of a run, whose blockers were looked up together.
class RunBlockers;
uint32_t visible_fraction_uq16(RunBlockers& run, const Patch& receiver, uint16_t rays, bool weighted,
                               urad_counters* counters) noexcept;

/// How many rays a pair is worth.
struct AdaptiveRays {
  uint16_t rays;  ///< most at a time, 4 .. 256; 2^k, or the next below it
  uint8_t depth;  ///< cuts of a patch into four, of both patches together, 0 .. 6
  /// F, UQ0.32: half the rays at or below it, a quarter at a quarter, and so on; parts of a pair
  /// that are worth no more are not cut.
  uint32_t error_uq32;
};
inline constexpr uint8_t kMaxDepth = 6;

/// The same fraction by all-or-nothing rays [Martin 1996, section 5.1]: `rays` of the sequence, fewer
/// for small factors; if they agree, that is the answer. Rays that disagree cut the patch that is
/// the larger by now into four, and each part is asked for itself, until its rays agree, `depth`
/// cuts lie behind it, or its part of the factor is within the error. f_uq32: the unobstructed
/// factor of the pair, the greater of F_ij and F_ji. Exactly 0 or 65536 when all rays are stopped or
/// none. Pairs that may touch are not cut: they get `rays`, and twice as many for each doubling of
/// the factor beyond 16 errors, 256 at most. No recursion: a stack of 3 depth + 1 parts, 6 bytes
/// each. Limits are clamped.
uint32_t adaptive_fraction_uq16(const urad_scene& scene, const Patch& i, const Patch& j,
                                const AdaptiveRays& plan, uint32_t f_uq32, urad_counters* counters,
                                bool reject = true) noexcept;
uint32_t adaptive_fraction_uq16(RunBlockers& run, const Patch& receiver, const AdaptiveRays& plan,
                                uint32_t f_uq32, urad_counters* counters) noexcept;

}  // namespace urad
