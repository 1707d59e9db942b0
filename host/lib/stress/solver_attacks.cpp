#include <algorithm>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

#include "base/error.hpp"
#include "stress/attacks.hpp"
#include "stress/table_room.hpp"

namespace host {
namespace {

constexpr int kManyShots = 20000, kMillion = 1000000;

/// A solve with memory of its own.
struct Solve {
  Solve(TableRoom& room, unsigned flags)
      : memory(URAD_RADIOSITY_BYTES(room.scene().patch_count, urad_longest_run(&room.scene())) /
               4) {
    const urad_source source = room.source();
    status = urad_radiosity_init(&state, &room.scene(), &source, flags,
                                 urad_longest_run(&room.scene()), memory.data(), memory.size() * 4);
  }
  Solve(const Solve&) = delete;
  Solve& operator=(const Solve&) = delete;

  std::vector<std::uint32_t> memory;
  urad_radiosity state{};
  urad_status status = URAD_OK;
};

struct Course {
  int shots = 0;
  bool converged = false;  ///< by the engine's own word
  double rise = 0;         ///< of |unshot| in a shot, over what is emitted
};

double emitted(const urad_radiosity& state) {
  double sum = 0;
  for (const std::int64_t e : state.ledger.emitted) sum += double(e);
  return sum;
}

/// Shots until done, the ledger audited at every one.
Course shoot(Solve* solve, std::uint32_t error_uq32, int most, Findings* findings) {
  Course course;
  urad_radiosity& state = solve->state;
  findings->expect("a solve can be started", solve->status == URAD_OK);
  if (solve->status != URAD_OK) return course;
  bool ledger = urad_radiosity_audit(&state, nullptr);
  const double all = emitted(state);
  for (; course.shots < most && !urad_radiosity_done(&state, error_uq32); ++course.shots) {
    const std::uint64_t before = state.remaining;
    solve->status = urad_radiosity_step(&state);
    ledger = ledger && urad_radiosity_audit(&state, nullptr);
    if (state.remaining > before && all > 0)
      course.rise = std::max(course.rise, double(state.remaining - before) / all);
    if (solve->status != URAD_OK) break;
  }
  course.converged = solve->status == URAD_OK && urad_radiosity_done(&state, error_uq32);
  findings->expect("ledger exact at every shot", ledger);
  findings->expect("converged, capped or guarded", solve->status == URAD_OK ||
                                                       solve->status == URAD_DIVERGES ||
                                                       solve->status == URAD_OVERFLOW);
  findings->measure("shots", course.shots);
  findings->measure(state.flags & URAD_OVERSHOOT ? "rise of |unshot| in a shot, overshooting"
                                                 : "rise of |unshot| in a shot",
                    course.rise);
  return course;
}

/// Areas may leave no exchanges with rows of 1; the engine then counts rows that are off.
bool truly_closed(const Solve& solve) { return solve.state.counters.rows_off == 0; }

/// Largest |B - dense| of a channel over the largest B of all.
double drift(const TableRoom& room, const urad_radiosity& state) {
  double off = 0, most = 0;
  for (int c = 0; c < 3; ++c) {
    const Eigen::VectorXd b = room.exact(c);
    for (int i = 0; i < room.patches(); ++i) {
      std::int32_t got = 0;
      urad_radiosity_get(&state, std::uint16_t(i), unsigned(c), &got);
      off = std::max(off, std::abs(got - b(i)));
      most = std::max(most, b(i));
    }
  }
  return most > 0 ? off / most : 0;
}

/// In half of the cases.
unsigned overshooting(Random& random) { return random.below(2) ? unsigned{URAD_OVERSHOOT} : 0u; }

unsigned any_flags(Random& random) {
  return overshooting(random) | unsigned(random.below(16) << 1);
}

/// Every surface reflects `reflectance`; the first one is the lamp.
void furnish(TableRoom* room, double reflectance, Random& random) {
  for (int s = 0; s < room->scene().surface_count; ++s) {
    const double shade = s == 0 ? 1 : random.uniform(0.999, 1);
    const double r = std::min(1.0, reflectance * (reflectance < 1 ? shade : 1));
    const std::int32_t e = s == 0 ? 1 << 20 : 0;
    room->set(s, {r, r, r}, {e, e / 2, random.below(2) ? 0 : e / 4});
  }
}

TableRoom closed_room(Random& random) {
  return TableRoom{3 + random.below(5), 1 + random.below(6), true};
}

void closed_bright(Random& random, Findings* findings) {
  TableRoom room = closed_room(random);
  const double reflectance[] = {0.9, 0.99, 0.999};
  room.spread_areas(4, random);
  room.fill_reciprocal(1, random);
  const double r = reflectance[random.below(3)];
  furnish(&room, r, random);
  room.emit_power((1 - r) * 0x1p29);
  Solve solve(room, any_flags(random));
  const Course course = shoot(&solve, URAD_PERCENT, kManyShots, findings);
  if (course.converged && truly_closed(solve))
    findings->measure("error of B where 1 % was said", drift(room, solve.state), 0.1);
}

void closed_mirror(Random& random, Findings* findings) {
  TableRoom room = closed_room(random);
  room.spread_areas(4, random);
  room.fill_reciprocal(1, random);
  furnish(&room, 1, random);
  room.emit_power(0x1p20);
  Solve solve(room, any_flags(random));
  const Course course = shoot(&solve, URAD_PERCENT, kManyShots, findings);
  if (truly_closed(solve)) findings->expect("says that it cannot converge", !course.converged);
}

void one_channel_mirror(Random& random, Findings* findings) {
  TableRoom room = closed_room(random);
  room.spread_areas(4, random);
  room.fill_reciprocal(1, random);
  for (int s = 0; s < room.scene().surface_count; ++s)
    room.set(s, {random.uniform(), 1, random.uniform()}, {s ? 0 : 1 << 20, s ? 0 : 1 << 20, 0});
  room.emit_power(0x1p20);
  Solve solve(room, any_flags(random));
  const Course course = shoot(&solve, URAD_PERCENT, kManyShots, findings);
  if (truly_closed(solve)) findings->expect("says that it cannot converge", !course.converged);
}

void black(Random& random, Findings* findings) {
  TableRoom room = closed_room(random);
  room.spread_areas(4, random);
  room.fill_reciprocal(random.uniform(0.1, 1), random);
  furnish(&room, 0, random);
  room.emit_power(0x1p24);
  Solve solve(room, any_flags(random));
  const Course course = shoot(&solve, 0, kManyShots, findings);
  findings->expect("done when the lamps have shot", course.converged);
  findings->measure("error of B", drift(room, solve.state), 1e-5);
}

void one_patch(Random& random, Findings* findings) {
  TableRoom room(1, 1, random.below(2));
  furnish(&room, random.uniform(), random);
  room.emit_power(random.log_uniform(1, 0x1p29));
  room.fill_anything(1, random);
  Solve solve(room, any_flags(random));
  shoot(&solve, URAD_PERCENT, kManyShots, findings);
}

void most_patches(Random& random, Findings* findings) {
  TableRoom room{random.below(2) ? 3 : 65535, 1, random.below(2) == 1};
  TableRoom full{5, 13107, random.below(2) == 1};
  TableRoom& chosen = random.below(4) ? full : room;
  furnish(&chosen, random.uniform(0.5, 0.999), random);
  chosen.emit_power(0x1p28);
  Solve solve(chosen, any_flags(random));
  shoot(&solve, 0, 12, findings);
}

void spread(Random& random, Findings* findings) {
  TableRoom room{3 + random.below(5), 2 + random.below(6), true};
  room.spread_areas(1e6, random);
  room.fill_reciprocal(1, random);
  furnish(&room, random.uniform(0.1, 0.95), random);
  room.emit_power(0x1p24);
  Solve solve(room, any_flags(random));
  shoot(&solve, URAD_PERCENT, kManyShots, findings);
}

void dim_lamp(Random& random, Findings* findings) {
  TableRoom room = closed_room(random);
  room.spread_areas(4, random);
  room.fill_reciprocal(1, random);
  for (int s = 0; s < room.scene().surface_count; ++s)
    room.set(s, {0.5, 0.9, 0.99}, {s ? 0 : 1, s ? 0 : 1, 0});
  room.emit_power(random.log_uniform(0.5, 64));
  Solve solve(room, any_flags(random));
  const Course course = shoot(&solve, 0, kManyShots, findings);
  findings->expect("the last of the light dies out", course.converged);
}

void full_lamp(Random& random, Findings* findings) {
  TableRoom room = closed_room(random);
  room.spread_areas(1 + 3 * random.uniform(), random);
  room.fill_reciprocal(1, random);
  for (int s = 0; s < room.scene().surface_count; ++s)
    room.set(s, {0.9, 0.9, 0.9}, {1 << 30, random.below(2) ? 1 << 30 : 0, 0});
  room.emit_power(random.log_uniform(0x1p28, 0x1.fp29));
  Solve solve(room, any_flags(random));
  shoot(&solve, URAD_PERCENT, kManyShots, findings);
}

void any_rows(Random& random, Findings* findings) {
  TableRoom room{1 + random.below(7), 1 + random.below(8), random.below(2) == 1};
  room.spread_areas(4, random);
  room.fill_anything(random.uniform(0.1, 4), random);
  for (int s = 0; s < room.scene().surface_count; ++s)
    room.set(s, {random.uniform(), random.uniform(), random.uniform()},
             {s ? random.below(1 << 20) : 1 << 20, 1 << 18, 0});
  room.emit_power(random.log_uniform(1, 0x1p29));
  Solve solve(room, any_flags(random));
  shoot(&solve, URAD_PERCENT, kManyShots, findings);
}

/// The bytes of a solve, as a power failure would find them saved.
struct Saved {
  explicit Saved(const Solve& solve) : state(solve.state), memory(solve.memory) {}
  void restore(Solve* solve) const {
    solve->state = state;
    std::copy(memory.begin(), memory.end(), solve->memory.begin());
  }
  urad_radiosity state;
  std::vector<std::uint32_t> memory;
};

void interrupted(Random& random, Findings* findings) {
  TableRoom room = closed_room(random);
  room.spread_areas(4, random);
  room.fill_reciprocal(random.uniform(0.5, 1), random);
  furnish(&room, random.uniform(0.1, 0.95), random);
  room.emit_power(0x1p26);
  const unsigned flags = any_flags(random);
  Solve whole(room, flags), broken(room, flags);
  bool same = true;
  for (int shot = 0; shot < 300; ++shot) {
    const Saved saved(broken);
    for (int further = random.below(4); further > 0; --further)
      static_cast<void>(urad_radiosity_step(&broken.state));
    std::fill(broken.memory.begin(), broken.memory.end(), 0xA5A5A5A5u);
    saved.restore(&broken);
    const urad_status there = urad_radiosity_step(&whole.state);
    const urad_status here = urad_radiosity_step(&broken.state);
    same = same && there == here && whole.memory == broken.memory &&
           whole.state.remaining == broken.state.remaining;
  }
  findings->expect("resumed at every shot, the same bits", same);
}

/// Light that goes round for long: shots until nothing is left.
void endless(Random& random, Findings* findings) {
  TableRoom room{5, int(random.log_uniform(10, 250)), true};
  room.spread_areas(4, random);
  room.fill_reciprocal(1, random);
  const double r = random.uniform(0.9, 0.975);
  furnish(&room, r, random);
  // Either what a patch ends with is near full scale, or all patches together are, as exporters
  // that fear for one bright patch do it.
  const bool full = random.below(2);
  room.emit_power((1 - r) * 0x1p28 * (full ? room.patches() : 1));
  Solve solve(room, overshooting(random));
  shoot(&solve, 0, kMillion, findings);
  findings->expect("converges", solve.status == URAD_OK);
  if (truly_closed(solve))
    findings->measure(full ? "error of B, shot to the end"
                           : "the same, where all patches together are full scale",
                      drift(room, solve.state),
                      full ? 1e-4 : std::numeric_limits<double>::infinity());
}

/// One solve of a million shots: patches and reflectance that take as many. Seven of eight cases are
/// smaller, for those who have no time.
void million(Random& random, Findings* findings) {
  const bool whole = random.below(8) == 0;
  TableRoom room{5, whole ? 320 : 40 + random.below(40), true};
  room.spread_areas(4, random);
  room.fill_reciprocal(1, random);
  const double r = whole ? 0.99 : 0.95;
  for (int s = 0; s < room.scene().surface_count; ++s)
    room.set(s, {r, r, r}, {s ? 0 : 1 << 20, s ? 0 : 1 << 19, 0});
  room.emit_power((1 - r) * 0x1p28 * room.patches());
  Solve solve(room, 0);
  const Course course = shoot(&solve, 0, 2 * kMillion, findings);
  findings->expect("converges", solve.status == URAD_OK);
  findings->measure(course.shots >= kMillion ? "drift after 1e6 shots, of the largest B"
                                             : "drift after fewer shots, of the largest B",
                    drift(room, solve.state), whole ? 2e-5 : 1e-5);
}

Attack solver_attack(const char* family, void (*run)(Random&, Findings*)) {
  return {
      "solver", family,
      [](Random& random) { return fmt::format("{}", std::uint64_t(random.uniform() * 0x1p53)); },
      [run](const std::string& input, Findings* findings) {
        Random random(std::strtoull(input.c_str(), nullptr, 10));
        run(random, findings);
      }};
}

}  // namespace

std::vector<Attack> solver_attacks() {
  return {solver_attack("closed, reflectance 0.9 to 0.999", closed_bright),
          solver_attack("closed, reflectance 1", closed_mirror),
          solver_attack("reflectance 1 in one channel", one_channel_mirror),
          solver_attack("reflectance 0", black),
          solver_attack("one patch", one_patch),
          solver_attack("65,535 patches", most_patches),
          solver_attack("areas 1 : 1e6", spread),
          solver_attack("lamp of one unit", dim_lamp),
          solver_attack("lamp of full scale", full_lamp),
          solver_attack("any rows", any_rows),
          solver_attack("interrupted at every shot", interrupted),
          solver_attack("shots without end", endless),
          solver_attack("a million shots", million)};
}

}  // namespace host
