// form_factor.hpp -- unoccluded form factors of patch pairs, by kernel or network, and their source.
//
//   F_ij = 1/A_i int_{A_i} int_{A_j} cos(t_i) cos(t_j) / (pi r^2) dA_j dA_i   [Martin 1996, Eq. 1.1]
//
// The exchange G = A_i F_ij = A_j F_ji is one integer per unordered pair: log2 G in Q7.24.
// Reciprocity is exact on it.
#pragma once
#include "urad/clip.hpp"
#include "urad/net.h"
#include "urad/pair.hpp"
#include "urad/source.h"

namespace urad {

enum class Kernel : uint8_t { centre, moment };

/// "No exchange": facing away, coplanar, or nothing left after the cut.
inline constexpr int32_t kNoExchange = INT32_MIN;

/// Which skips are switched OFF (for tests): the factors keep their bits, the counters change.
enum SkipOff : uint32_t {
  skip_off_far = 1,      ///< far pairs run the network, too: `networks` takes up far_pairs
  skip_off_facing = 2,   ///< pairs that look away go all the way: `evaluated` takes up the rest
  skip_off_same = 4,     ///< patches of one plane are looked at one by one, and found to look away
  skip_off_behind = 8,   ///< so are those of surfaces wholly behind
  skip_off_convex = 16,  ///< convex scenes ask for rays, too: rays_spared takes up skipped_convex
                         ///< times rays
  skip_off_blockers = 32,  ///< rays are made and tested against all blockers: `rays` takes up
                           ///< rays_spared, blockers_kept takes up blockers_rejected
  skip_off_unseen = 64,    ///< a ray looks at every polygon it is tested against, past its box and
                           ///< its shadow: such looks take up tests_unseen
  skip_off_order = 128  ///< a ray asks blockers in the order of the scene, not the one first that
                        ///< stopped the ray before: no skip but an order, without a counter
};

/// Invariants of two patches of the scene after each was cut to the other's front half-space.
/// *limit_q24: log2 of the smaller area left, which G cannot exceed. False when they exchange no
/// light; the outputs are then undefined.
bool clipped_pair(const urad_scene& scene, const Patch& i, const Patch& j, Pair* pair,
                  int32_t* limit_q24, bool* clipped) noexcept;

/// Which exchanges are small enough to be left out. Judged by twice the moment kernel, where that
/// is above the exchange: rho below 1/8, nothing cut.
struct SmallExchange {
  int32_t least_q24;     ///< log2 of the greatest
  int32_t left_out_q24;  ///< log2 of twice the kernel of the pair left out, or kNoExchange
};

/// log2 G of two patches of the scene (Q7.24, square scene units), or kNoExchange. net null: the
/// kernel alone; else the net's correction of it, or the exact sum (lambert.hpp) where the net
/// hands over. Repair is not applied. Counts the pair as evaluated or skipped_facing.
///
/// limit: exchanges of at most 2^least are left out, and counted as skipped_small; null: none.
int32_t exchange_log2_q24(const urad_scene& scene, const Patch& i, const Patch& j, Kernel kernel,
                          const urad_net* net, uint32_t skips_off, urad_counters* counters,
                          SmallExchange* limit = nullptr) noexcept;

/// The same for two patches known to lie wholly in front of each other's plane: the looks at every
/// vertex are saved.
int32_t exchange_in_front_q24(const urad_scene& scene, const Patch& i, const Patch& j,
                              Kernel kernel, const urad_net* net, uint32_t skips_off,
                              urad_counters* counters, SmallExchange* limit = nullptr) noexcept;

/// log2 G by the exact sum at points x points of one of the two. Counted like the others.
int32_t exchange_exact_q24(const urad_scene& scene, const Patch& i, const Patch& j, int points,
                           urad_counters* counters) noexcept;

/// F = G / A as UQ0.32, rounded, saturating at 2^32 - 1.
uint32_t form_factor_uq32(int32_t log2_exchange_q24, int32_t log2_area_q24) noexcept;

struct PairSource;
/// log2 G of a pair for a source that has a way of its own, as exchange_log2_q24(). side: what
/// side_of_run() says of i and the surface of j, or both.
using PairExchange = int32_t (*)(const PairSource& source, const Patch& i, const Patch& j,
                                 Side side) noexcept;

/// A source (source.h) that evaluates pairs, times the visible fraction where the scene is not
/// convex: the exported one, or by rays.
struct PairSource {
  const urad_scene* scene;
  const urad_net* net;  ///< null: kernel alone
  Kernel kernel;
  uint16_t rays;            ///< visibility rays per pair; 0: ignore blockers. None with exported
                            ///< visibility, which is read whatever stands here
  uint32_t skips_off;       ///< SkipOff bits
  urad_counters* counters;  ///< never null
  uint8_t points = 0;  ///< 1 .. 4: every pair by the exact sum at so many points squared; 0: none
  int16_t log2_error_q8 = 0;        ///< for `exchange`: log2 of the relative error to stay below
  PairExchange exchange = nullptr;  ///< not null: every pair by this, as by cheapest_of_source()
  uint32_t* ways = nullptr;         ///< for `exchange`: counts of ways taken, or null

  /// Not 0: rays by the worth of a pair, with `depth` cuts where they disagree (visibility.hpp,
  /// AdaptiveRays; `rays` the most at a time). 0: `rays` for every pair.
  uint32_t error_uq32 = 0;
  uint8_t depth = 0;
  uint16_t last_blocker = 0;  ///< that stopped a ray: the first to be asked about the next

  /// Bounded contribution, the one skip that changes light: where pairs are asked for rays, factors
  /// of at most 8 bound / patch_count are taken as 0 before network and rays, as long as those of
  /// the row together (each as twice its kernel) stay within `bound`, UQ0.32. All B together,
  /// weighted by area, then lose at most bound rho / (1 - rho) of themselves, rho the largest
  /// reflectance. A row is to be asked for in order, in runs of any length. Convex scenes, exported
  /// visibility and rays == 0 leave nothing out: they would pay more than they save. 0: none.
  uint32_t bound_uq32 = 0;
  uint32_t lost_uq32 = 0;                    ///< of the row being filled
  uint32_t lost_shooter = 0, lost_next = 0;  ///< whose row, and the patch it has come to
};

/// urad_fill for a PairSource: bad_argument on a bad index, else ok.
urad_status pair_fill(void* pair_source, uint16_t shooter, uint16_t surface, uint16_t first,
                      uint16_t count, uint32_t* f_uq32) noexcept;

}  // namespace urad
