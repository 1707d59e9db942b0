// visibility_candidates.hpp -- blockers worth asking about a pair, found in two looks: once for a
// shooter and a run of receivers, then for each pair of it.
#pragma once
#include "urad/form_factor.hpp"
#include "urad/visibility.hpp"
#include "visibility_shadow.hpp"

namespace urad {

inline constexpr int kListed = 32;  ///< blockers that a list holds; more are asked ray by ray

/// Blockers that may stand between a shooter and any patch of a run.
class RunBlockers {
 public:
  /// `run` null: nothing is known of the receivers, and every pair looks at all blockers. skips_off:
  /// SkipOff bits, of which those of blockers matter. *last: the blocker that stopped the ray
  /// before; kept up to date.
  RunBlockers(const urad_scene& scene, const Patch& shooter, const urad_grid* run,
              uint32_t skips_off, uint16_t* last) noexcept;

  const urad_scene& scene() const noexcept { return scene_; }
  const Patch& shooter() const noexcept { return shooter_; }

 private:
  friend class Candidates;
  struct Listed {
    uint16_t blocker;
    Edges edges;          // that segments to the run may pass outside of
    PlaneSide side, run;  // of shooter and run; `run` matters if it holds for parts
    int8_t turn;          // of the loop
    uint8_t edge;         // that left out the blocker for the receiver before
  };
  /// False when the list is full.
  bool list(uint16_t blocker, const Reach& run) noexcept;

  const urad_scene& scene_;
  const Patch& shooter_;
  Reach reach_;
  uint16_t* last_;
  bool reject_;  // blockers before any ray
  bool unseen_;  // and, ray by ray, those that its box or shadow tells of
  bool order_;   // the last to stop a ray goes first
  bool known_;   // the list holds all that matter
  int count_ = 0;
  Listed listed_[kListed];
};

/// Blockers that may stand between the shooter of a run and one receiver: the first few by number,
/// any others from `rest` on.
class Candidates {
 public:
  Candidates(RunBlockers& run, const Patch& receiver) noexcept;

  bool empty() const noexcept { return count_ == 0; }  // others wait for a full list only
  bool shut() const noexcept { return shut_; }
  void count(urad_counters* counters) const noexcept;

  /// Whether any stands between a point a of the shooter and b of the receiver, or the other way
  /// round if `turned`. The blocker that stopped a ray is asked first about the next.
  bool stop(const urad_point& a, const urad_point& b, bool turned,
            urad_counters* counters) noexcept;

 private:
  struct Asked {
    uint16_t blocker;
    int8_t side_from, side_to;  // of its plane that the whole patch lies on; 0: both
    int8_t turn;                // of the loop from the end that is looked from; 0: no look
    bool from_receiver;         // which end that is
    Edges edges;                // for ray_shadow()
    CoarseScale scale;          // the same
  };
  /// Whether the blocker stands between a point of the shooter and one of the receiver.
  bool across(const Asked& asked, const urad_point& from, const urad_point& to,
              const urad_point& coarse_from, const urad_point& coarse_to,
              urad_counters* counters) const noexcept;
  /// False when nothing more need be asked: the list is full, or the blocker shuts off everything.
  bool list(RunBlockers::Listed* listed, const Reach& to) noexcept;

  RunBlockers& run_;
  const Patch& receiver_;
  uint16_t blocker_count_, rest_;
  bool shut_ = false;
  int count_ = 0;
  Asked asked_[kListed];
};

}  // namespace urad
