// The engine's factor sources by name, on the host: the same integers as on a chip.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "method/nets.hpp"
#include "method/spec.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"
#include "urad/form_factor.hpp"
#include "urad/pose_table.h"
#include "urad/source.h"

namespace host {

struct EngineOptions {
  int rays = 64;            ///< visibility rays a pair, where the scene is not convex
  std::uint32_t skips = 0;  ///< urad::SkipOff bits: skips switched off
  double ray_error = 0;     ///< pairs: fewer rays for factors below this; 0: `rays` for all
  int cuts = 0;             ///< with it: cuts of patches where rays disagree
  bool all_rows = false;    ///< the hemicube sums faces and rows that nothing touched, too
  double bound = 0;         ///< pairs: no row may lose more by leaving out small factors; 0: none
  const urad_pose_table* poses = nullptr;  ///< what `table` loads from; must outlive the source
};

/// True for the methods that run in the engine's integers.
bool is_engine_method(const MethodSpec& spec);

/// The ERROR of auto[:ERROR] as the engine wants it, log2 in Q7.8, rounded down. Throws Error.
std::int16_t auto_error_q8(const MethodSpec& spec);

/// A source over one scene, with all its memory. One per thread; `scene` and `nets` must outlive
/// it.
///   fixed-kernel, fixed-moment,      pairs, times the visible fraction by rays
///   fixed-lambert:N, net[:NAME],
///   auto[:ERROR]
///   hemicube:R                       turned; without item buffer in a convex scene
///   hybrid[:R]                       occluded: the network's factor times the visible fraction of the
///                                    hemicube; convex: the network's for pairs closer than three
///                                    patches, else the hemicube's
///   table                            a load per pair from options.poses
class EngineSource {
 public:
  /// Throws Error for an unknown method or a value out of range.
  EngineSource(const FixedScene& scene, const MethodSpec& spec, const NetChoice& nets,
               const EngineOptions& options);
  ~EngineSource();
  EngineSource(EngineSource&&) noexcept;

  urad_source source() const;
  const urad_counters& counters() const;
  /// The engine's own source, where it goes pair by pair; else null.
  const urad::PairSource* pairs() const;
  /// Pairs by the way that auto took (urad::Way); zeros for other methods.
  const std::array<std::uint32_t, urad::kWays>& ways() const;
  /// Memory the source itself needs on a chip, without the solver's.
  std::size_t ram_bytes() const;
  /// Row of factors of one shooter. Throws Error when the engine refuses.
  void row(std::uint16_t shooter, std::uint32_t* f_uq32) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The engine's visible fractions on their own: hemicube masks, rays for what covers no cell.
class EngineVisibility {
 public:
  EngineVisibility(const FixedScene& scene, int resolution, int rays);
  ~EngineVisibility();
  /// Fraction of patch `receiver` that `shooter` sees, 0 .. 1. Not thread-safe: renders when the
  /// shooter changes.
  double fraction(std::uint16_t shooter, std::uint16_t receiver) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// All rows, [N][N] UQ0.32, and what was counted on the way (one sweep).
struct EngineRows {
  std::size_t patches = 0;
  std::vector<std::uint32_t> f_uq32;
  urad_counters counters{};
  std::array<std::uint32_t, urad::kWays> ways{};  ///< of auto
  std::size_t ram_bytes = 0;
  double seconds = 0;  ///< of all threads together

  double operator()(std::size_t i, std::size_t j) const {
    return f_uq32[i * patches + j] / 4294967296.0;
  }
};

/// Pairs of convex scenes are done once for both directions, by kernel or network in SIMD lanes
/// (lanes/lane_rows.hpp), with the same bits.
EngineRows engine_rows(const FixedScene& scene, const MethodSpec& spec, const NetChoice& nets,
                       const EngineOptions& options, int threads);

}  // namespace host
