// Light that changes, by the engine's signed shots, with the dense solution beside it.
#pragma once
#include <Eigen/LU>
#include <vector>

#include "method/engine_source.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/radiosity.h"

namespace host {

/// One solve that goes on while lamps and walls change. Factors are stored rows, as a pose table
/// would give them.
class Relighting {
 public:
  /// rows: after repair, of a FixedScene of `scene`. The scene must outlive this.
  Relighting(const Scene& scene, EngineRows rows, bool overshoot);
  Relighting(const Relighting&) = delete;

  /// Changes one patch's exitance or one material's reflectance. Throws Error when the engine
  /// refuses.
  void emit(std::size_t patch, const Vec3& exitance);
  void paint(int material, const Vec3& reflectance);

  /// At most `shots` more; returns how many were made. Throws Error when the engine stops.
  int step(int shots);

  std::vector<Vec3> radiosity() const;
  /// With the ambient term: what to show before the light has settled.
  std::vector<Vec3> display() const;
  /// What the same factors converge to with lamps and walls as they are now.
  std::vector<Vec3> converged() const;
  /// Relative rms error of radiosity() against `truth`, lamps' own exitance left out.
  double error(const std::vector<Vec3>& truth) const;

  const urad_radiosity& state() const { return state_; }

 private:
  const Scene& scene_;
  FixedScene fixed_;
  EngineRows rows_;
  std::vector<urad_material> material_;  // in RAM, so that it can change
  urad_scene pod_;
  std::vector<std::uint32_t> memory_;
  std::vector<std::int32_t> emitted_;
  std::vector<Vec3> exitance_;  // by patch
  urad_radiosity state_{};
};

}  // namespace host
