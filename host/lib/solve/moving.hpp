// Geometry that moves, by the engine's signed shots: what is made again, and what a solve from the
// start would take.
#pragma once
#include <memory>
#include <vector>

#include "method/engine_source.hpp"
#include "urad/move.h"

namespace host {

/// x -> turn x + by.
struct Motion {
  glm::dmat3 turn{1};
  Vec3 by{0};

  Vec3 operator()(const Vec3& x) const { return turn * x + by; }
};

/// The scene with some of its surfaces moved as one. What can stand between patches is looked for
/// again; closed stays closed.
Scene moved_scene(const Scene& scene, const std::vector<int>& surfaces, const Motion& motion);

/// Surfaces that hang together by corners and hold something that can stand between others, but emit
/// nothing: of all such objects the one with the fewest patches. Empty: none.
std::vector<int> smallest_object(const Scene& scene);

/// Half the way that an object can go before its box meets another surface, along one of the axes but
/// for the one that `up` is nearest to; the longest.
Vec3 free_way(const Scene& scene, const std::vector<int>& surfaces, const Vec3& up);

/// One solve that goes on while surfaces move. Factors come from an engine's source, row by row as
/// the solver asks for them.
class Moving {
 public:
  /// `nets` must outlive this. Throws Error as EngineSource does.
  Moving(const Scene& scene, const MethodSpec& method, const NetChoice& nets,
         const EngineOptions& options, bool overshoot);
  ~Moving();
  Moving(const Moving&) = delete;

  /// Throws Error when the engine refuses, or when the scene would leave the box it was made for.
  void move(const std::vector<int>& surfaces, const Motion& motion);

  /// At most `shots` more; returns how many were made. Throws Error when the engine stops.
  int step(int shots);

  std::vector<Vec3> radiosity() const;
  const Scene& scene() const;
  /// Pairs made again and left alone by the last move, both looks together.
  const urad_move& last() const { return last_; }
  const urad_radiosity& state() const { return state_; }

 private:
  struct Stage;  // a scene with its integers, its source and the rows it was asked for
  std::unique_ptr<Stage> stage(const Scene& scene) const;

  MethodSpec method_;
  const NetChoice& nets_;
  EngineOptions options_;
  std::unique_ptr<Stage> now_;
  std::vector<std::uint32_t> memory_;
  urad_radiosity state_{};
  urad_move last_{};
};

}  // namespace host
