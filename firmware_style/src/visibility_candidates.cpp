#include "visibility_candidates.hpp"

#include "visibility_walk.hpp"

namespace urad {

namespace {

constexpr bool astride(const PlaneSide& a, const PlaneSide& b) noexcept {
  return (a.front && b.behind) || (a.behind && b.front);
}

/// From which end of a pair the shadow of a blocker is told: one that lies on one side of its plane,
/// with a distance to it at one end. turn 0: from none.
struct View {
  int8_t turn;
  bool from_receiver;
};
constexpr View view_of(int8_t turn, const PlaneSide& from, const PlaneSide& to) noexcept {
  const int8_t front = from.side(), back = to.side();
  if (front && (from.far || (back && to.far))) return {int8_t(turn * front), false};
  if (back && to.far) return {int8_t(turn * back), true};
  return {0, false};
}

/// What the blocker does to all that goes between two patches.
Shadow shadow_between(const urad_scene& scene, uint16_t blocker, const View& view,
                      const Reach& from, const Reach& to, Edges* edges, uint8_t* first) noexcept {
  if (view.turn == 0) return Shadow::part;
  return shadow(scene, scene.blocker[blocker], view.turn, view.from_receiver ? to : from,
                view.from_receiver ? from : to, edges, first);
}

}  // namespace

RunBlockers::RunBlockers(const urad_scene& scene, const Patch& shooter, const urad_grid* run,
                         uint32_t skips_off, uint16_t* last) noexcept
    : scene_(scene),
      shooter_(shooter),
      reach_(reach_of(scene, shooter)),
      last_(last),
      reject_(!(skips_off & skip_off_blockers)),
      unseen_(!(skips_off & skip_off_unseen)),
      order_(!(skips_off & skip_off_order)),
      known_(false) {
  if (!reject_ || !run) return;
  known_ = true;
  const Reach to = reach_of(*run);
  urad_point low = reach_.low, high = reach_.high;
  stretch(to.low, to.high, &low, &high);
  const auto missed = [&](const urad_point& box_low, const urad_point& box_high) {
    return boxes_apart(low, high, box_low, box_high);
  };
  walk_blockers(scene, missed, [&](uint16_t blocker) {
    if (missed(scene.blocker[blocker].low, scene.blocker[blocker].high)) return true;
    known_ = list(blocker, to);
    return known_;
  });
}

bool RunBlockers::list(uint16_t number, const Reach& run) noexcept {
  const urad_blocker& blocker = scene_.blocker[number];
  Listed listed{
      number, {}, plane_side(scene_, shooter_, reach_, blocker), plane_side(scene_, run, blocker),
      0,      0};
  if (!astride(listed.side, listed.run)) return true;
  listed.turn = turn_of(scene_, blocker);
  // Seen from the same end, whatever receiver of the run is the other.
  const View view = view_of(listed.turn, listed.side, listed.run);
  if (shadow_between(scene_, number, view, reach_, run, &listed.edges, &listed.edge) ==
      Shadow::none)
    return true;
  if (count_ == kListed) return false;
  listed_[count_++] = listed;
  return true;
}

Candidates::Candidates(RunBlockers& run, const Patch& receiver) noexcept
    : run_(run),
      receiver_(receiver),
      blocker_count_(run.scene_.blocker_count),
      rest_(run.scene_.blocker_count) {
  if (run.known_ && run.count_ == 0) return;
  const urad_scene& scene = run.scene_;
  const Reach to = reach_of(scene, receiver);
  urad_point low = run.reach_.low, high = run.reach_.high;
  stretch(to.low, to.high, &low, &high);
  const auto missed = [&](const urad_point& box_low, const urad_point& box_high) {
    return run.reject_ && boxes_apart(low, high, box_low, box_high);
  };
  const auto out_of_reach = [&](uint16_t blocker) {
    return missed(scene.blocker[blocker].low, scene.blocker[blocker].high);
  };
  if (run.known_) {
    for (int k = 0; k < run.count_; ++k) {
      if (!out_of_reach(run.listed_[k].blocker) && !list(&run.listed_[k], to)) break;
    }
  } else {
    walk_blockers(scene, missed, [&](uint16_t blocker) {
      if (out_of_reach(blocker)) return true;
      const urad_blocker& b = scene.blocker[blocker];
      RunBlockers::Listed listed{blocker,
                                 {},
                                 plane_side(scene, run.shooter_, run.reach_, b),
                                 {false, false, false},
                                 run.reject_ ? turn_of(scene, b) : int8_t{0},
                                 0};
      const bool more = list(&listed, to);
      if (!more && !shut_) rest_ = blocker;
      return more;
    });
  }
  if (!run.order_) return;
  for (int k = 1; k < count_; ++k) {
    if (asked_[k].blocker != *run.last_) continue;
    const Asked first = asked_[0];
    asked_[0] = asked_[k];
    asked_[k] = first;
  }
}

bool Candidates::list(RunBlockers::Listed* listed, const Reach& to) noexcept {
  const urad_blocker& blocker = run_.scene_.blocker[listed->blocker];
  const PlaneSide from = listed->side;
  const PlaneSide side =
      listed->run.holds_for_parts() ? listed->run : plane_side(run_.scene_, receiver_, to, blocker);
  const View view = view_of(listed->turn, from, side);
  Asked asked{listed->blocker,    from.side(),   side.side(), run_.reject_ ? view.turn : int8_t{0},
              view.from_receiver, listed->edges, {0, ~0u}};
  // On one side of it as a whole, though a patch may lie in its plane: nothing is stopped.
  if (!astride(from, side)) {
    if (run_.reject_) return true;
    asked.side_from = asked.side_to = 1;
  } else if (run_.reject_) {
    const Shadow cast = shadow_between(run_.scene_, listed->blocker, view, run_.reach_, to,
                                       &asked.edges, &listed->edge);
    if (cast == Shadow::none) return true;
    shut_ = cast == Shadow::all && from.side() && side.side();
    if (shut_) return false;
    asked.scale = coarse_scale(blocker, run_.reach_, to);
  }
  if (count_ == kListed) return false;
  asked_[count_++] = asked;
  return true;
}

void Candidates::count(urad_counters* counters) const noexcept {
  const uint32_t kept = shut_ ? 0 : uint32_t(count_) + blocker_count_ - rest_;
  counters->blockers_kept += kept;
  counters->blockers_rejected += blocker_count_ - kept;
}

bool Candidates::across(const Asked& asked, const urad_point& from, const urad_point& to,
                        const urad_point& coarse_from, const urad_point& coarse_to,
                        urad_counters* counters) const noexcept {
  const urad_scene& scene = run_.scene_;
  const urad_blocker& blocker = scene.blocker[asked.blocker];
  if (run_.unseen_) {
    ++counters->tests_unseen;
    if (boxes_apart(from, to, blocker.low, blocker.high)) return false;
    if (asked.turn) {
      const bool back = asked.from_receiver;
      const Shadow cast =
          ray_shadow(scene, blocker, asked.turn, asked.scale, asked.edges,
                     back ? coarse_to : coarse_from, back ? coarse_from : coarse_to);
      if (cast == Shadow::none) return false;
      if (cast == Shadow::all && asked.side_from && asked.side_to) return true;
    }
    --counters->tests_unseen;
  }
  return stands_across(scene, blocker, from, to, asked.side_from, asked.side_to);
}

bool Candidates::stop(const urad_point& a, const urad_point& b, bool turned,
                      urad_counters* counters) noexcept {
  const urad_scene& scene = run_.scene_;
  const urad_point &from = turned ? b : a, &to = turned ? a : b;
  const urad_point coarse_from = coarse(from), coarse_to = coarse(to);
  for (int k = 0; k < count_; ++k) {
    ++counters->ray_tests;
    if (!across(asked_[k], from, to, coarse_from, coarse_to, counters)) continue;
    if (!run_.order_) return true;
    const Asked first = asked_[0];
    asked_[0] = asked_[k];
    asked_[k] = first;
    *run_.last_ = asked_[0].blocker;
    return true;
  }
  if (rest_ == blocker_count_) return false;
  bool stopped = false;
  const auto missed = [&](const urad_point& low, const urad_point& high) {
    return run_.reject_ && boxes_apart(a, b, low, high);
  };
  walk_blockers(scene, missed, [&](uint16_t number) {
    if (number < rest_) return true;
    const urad_blocker& blocker = scene.blocker[number];
    ++counters->ray_tests;
    if (run_.unseen_ && boxes_apart(a, b, blocker.low, blocker.high)) {
      ++counters->tests_unseen;
      return true;
    }
    const PlaneSide at_from = plane_side(scene, run_.shooter_, blocker),
                    at_to = plane_side(scene, receiver_, blocker);
    stopped = astride(at_from, at_to) &&
              stands_across(scene, blocker, from, to, at_from.side(), at_to.side());
    return !stopped;
  });
  return stopped;
}

}  // namespace urad
