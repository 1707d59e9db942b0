// Sizes on a 32-bit chip of what the caller of the engine provides; the host's own are larger.
#pragma once
#include <cstddef>

#include "urad/scene.h"

namespace host {

// sizeof on a Cortex-M0; bench/plan/measure.sh has the chip say them, `urad_plan_fit check` compares.
inline constexpr std::size_t kStateBytes = 240;     ///< urad_radiosity
inline constexpr std::size_t kCountersBytes = 104;  ///< urad_counters
inline constexpr std::size_t kPairSourceBytes = 56;
inline constexpr std::size_t kPoseSourceBytes = 20;
inline constexpr std::size_t kHemicubeSourceBytes = 60;
inline constexpr std::size_t kHybridSourceBytes = 24;

/// Greatest vertex count of the scene's polygons and blockers, 4 at least.
std::size_t most_vertices(const urad_scene& scene);

/// Light, one run of factors of the longest surface, state and counters.
std::size_t solver_ram(const urad_scene& scene);

/// A hemicube source and its memory; rows: height of a band, 0 in a convex scene.
std::size_t hemicube_ram(const urad_scene& scene, int resolution, int rows, bool coverage);

/// Its delta form factors.
std::size_t hemicube_flash(int resolution);

/// A network of the shape `urad train` makes.
std::size_t net_flash(int inputs, int hidden, int bits);

}  // namespace host
