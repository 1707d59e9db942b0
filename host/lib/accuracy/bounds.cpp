#include "accuracy/bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "form_factor/closed_form.hpp"
#include "report/text.hpp"

namespace host {

namespace {

constexpr double kExact = 1e-12;
constexpr double kHybridPlates = 1e-2, kRayPlates = 3e-3;
constexpr double kOwnStd = 3e-5, kOwnRow = 0.003, kGeneralStd = 6e-4, kHemicubeStd = 8e-4;
constexpr double kNarrowLoss = 0.03;
constexpr double kNetLight = 0.003, kNearLight = 0.01, kCornellLight = 0.03, kChipLight = 0.01;
constexpr double kLargestOfCube = 0.200043776075403, kSmallestOfCube = 6.08e-5;
constexpr std::size_t kChipRam = 16 * 1024, kChipFlash = 256 * 1024;

using List = std::vector<Bound>;

/// Three digits: enough to see on which side of a bound a figure lies.
std::string fine_percent(double fraction) { return fmt::format("{:.3g} %", 100 * fraction); }

void add_reference(const AccuracyResults& r, List* list) {
  list->push_back({fmt::format("reference, {} unoccluded polygon values", r.known.cases),
                   "1e-12 or the last printed digit",
                   fmt::format("worst error {:.1e}; {:.2g} of its bound at most ({})",
                               r.known.worst, r.known.of_bound, r.known.worst_name),
                   r.known.of_bound <= 1});
  const RowCheck& rows = r.cube_rows;
  const bool known_ends = std::fabs(rows.largest - kLargestOfCube) <= kExact &&
                          std::fabs(rows.smallest - kSmallestOfCube) <= 1e-7;
  list->push_back({"reference, rows of cube7", "sum to 1 within 1e-12",
                   fmt::format("worst {:.1e}; F from {:.3g} to {:.15g}", rows.worst, rows.smallest,
                               rows.largest),
                   rows.worst <= kExact && known_ends});
  HostileCheck all;
  for (const HostileCheck& check : r.hostile) {
    all.draws += check.draws;
    all.not_finite += check.not_finite;
    all.negative += check.negative;
  }
  list->push_back(
      {fmt::format("reference, {} degenerate families, {} pairs", r.hostile.size(), all.draws),
       "no NaN, none negative",
       fmt::format("{} not finite, {} negative", all.not_finite, all.negative),
       all.not_finite + all.negative == 0});
  const ScaleCheck& scales = r.scales;
  list->push_back(
      {fmt::format("reference, scales 1e-12 to 1e12, {} pairs", scales.counts.draws),
       "no NaN, none negative",
       fmt::format("{} not finite, {} negative; F changes by {:.1e} at most",
                   scales.counts.not_finite, scales.counts.negative, scales.worst_change),
       scales.counts.not_finite + scales.counts.negative == 0});
}

void add_closed_form(const AccuracyResults& r, List* list) {
  std::size_t pairs = 0, random = 0, random_refused = 0, hard_refused = 0;
  const double worst = worst_of(r.closed_form, [](const ClosedFormCheck& c) { return c.worst; });
  for (const ClosedFormCheck& check : r.closed_form) {
    pairs += check.pairs;
    (check.random ? random_refused : hard_refused) += check.refused;
    if (check.random) random += check.pairs;
  }
  const std::size_t of_cube = r.closed_form.back().refused;
  list->push_back(
      {fmt::format("closed form against the reference, {} pairs", pairs),
       "1e-9 where answered; refused: 1 % of random pairs, none of cube7",
       fmt::format("worst difference {:.1e}; refused: {} of {} random pairs, {} of cube7, {} of "
                   "degenerate families",
                   worst, random_refused, random, of_cube, hard_refused - of_cube),
       worst <= kClosedFormTolerance && 100 * random_refused <= random && of_cube == 0});
}

void add_occluded(const std::string& what, const std::vector<OccludedCheck>& checks, List* list) {
  const double hybrid =
      worst_of(checks, [](const OccludedCheck& c) { return std::fabs(c.hybrid - c.f); });
  list->push_back({what + ", hybrid:64 with --subdivide 4", "1e-2", fmt::format("{:.1e}", hybrid),
                   hybrid <= kHybridPlates});
  const auto add_rays = [&](const char* name, double OccludedCheck::*value) {
    const double rays =
        worst_of(checks, [&](const OccludedCheck& c) { return std::fabs(c.*value - c.f); });
    list->push_back({what + name, "3e-3", fmt::format("{:.1e}", rays), rays <= kRayPlates});
  };
  add_rays(", rays:256", &OccludedCheck::rays);
  add_rays(", rays:256 with --subdivide 4", &OccludedCheck::rays_cut);
}

void add_cube_factors(const AccuracyResults& r, List* list) {
  const double own = worst_of(r.cube7, [](const SceneNetTrial& t) { return t.factors.std; });
  const double row = worst_of(r.cube7, [](const SceneNetTrial& t) { return t.factors.row_worst; });
  const double held = worst_of(r.cube7, [](const SceneNetTrial& t) { return t.held_out_std; });
  list->push_back({fmt::format("cube7, network trained for it (H = {}, int16), {} off-wall pairs",
                               r.request.scene_hidden, r.cube7.front().factors.pairs),
                   "std of error <= 3e-5",
                   fmt::format("{:.2e}; on held-out configurations {:.2e}", own, held),
                   own <= kOwnStd});
  list->push_back(
      {"the same, worst row sum before repair", "<= 0.3 %", fine_percent(row), row <= kOwnRow});

  const double general = worst_of(r.general, [](const GeneralTrial& t) { return t.cube7.std; });
  const double centre = row_of(r.cube7_methods, "fixed-kernel").row.errors.std;
  const double moment = row_of(r.cube7_methods, "fixed-moment").row.errors.std;
  list->push_back(
      {"cube7, general network that never saw it", "std <= 6e-4, and better than both kernels",
       fmt::format("{:.2e}; centre kernel {:.2e}, moment kernel {:.2e}", general, centre, moment),
       general <= kGeneralStd && general < std::min(centre, moment)});

  const HemicubeTrial& cube = r.hemicube;
  list->push_back({"cube7, hemicube:64, turned", "std <= 8e-4, every row sums to exactly 1",
                   fmt::format("{:.2e}; {} of {} rows exact to the last unit of 2^-32",
                               cube.factors.std, cube.exact_rows, cube.rows),
                   cube.factors.std <= kHemicubeStd && cube.exact_rows == cube.rows});
}

/// What 8 bits a weight cost a general network. By the network in double: docs/NETWORKS.md.
void add_narrow(const AccuracyResults& r, List* list) {
  double worst = -1;
  std::string which;
  for (const GeneralTrial& t : r.general) {
    if (!t.int16 || !t.int8) return;
    const struct {
      const char* name;
      double ErrorRow::*value;
    } statistics[] = {{"median", &ErrorRow::median},
                      {"p95", &ErrorRow::p95},
                      {"p99", &ErrorRow::p99},
                      {"std", &ErrorRow::std}};
    for (const auto& s : statistics) {
      const double loss = (*t.int8).*s.value / ((*t.int16).*s.value) - 1;
      if (loss > worst) worst = loss, which = fmt::format("{}, {}", s.name, t.origin);
    }
  }
  list->push_back({"general network, int8 by int16: median, p95, p99, std of random pairs",
                   "<= 3 % worse", fmt::format("{} ({})", fine_percent(worst), which),
                   worst <= kNarrowLoss});
}

/// What auto:0.01 promises, on pairs that none of its constants was fitted to.
void add_auto(const AccuracyResults& r, List* list) {
  const auto row = [&](std::size_t family) -> const MethodTrialRow& {
    const auto& rows = r.trials.families.at(family).rows;
    return *std::find_if(rows.begin(), rows.end(), [](const auto& x) { return x.label == "auto"; });
  };
  const auto most = [&](double MethodTrialRow::*value) {
    return std::max({row(0).*value, row(1).*value, row(2).*value});
  };
  const double median = most(&MethodTrialRow::median), p99 = most(&MethodTrialRow::p99),
               max = most(&MethodTrialRow::max);
  list->push_back(
      {"auto, free quads and rooms", "median <= 0.1 %, p99 <= 3 %, none above 10 %",
       fmt::format("{}, {}, {}", fine_percent(median), fine_percent(p99), fine_percent(max)),
       median <= 1e-3 && p99 <= 0.03 && max <= 0.1});
  const double edge = row(3).max;
  list->push_back({"auto, walls that share an edge, 1 to 179 degrees, 1:20 to 20:1", "<= 2 %",
                   fine_percent(edge), edge <= 0.02});
  double missed = 0, pairs = 0, useful = 0;
  for (std::size_t f = 0; f < r.trials.families.size(); ++f) {
    missed += row(f).estimate->missed * double(row(f).pairs);
    pairs += double(row(f).pairs);
    useful = std::max(useful, row(f).estimate->median);
  }
  list->push_back({"auto, its estimate of its error, all kinds of pairs", "holds for 99 %",
                   fmt::format("{:.2f} %; by the true error, median of the worst kind {:.2g}",
                               100 - 100 * missed / pairs, useful),
                   missed <= 0.01 * pairs});
  list->push_back(
      {"radiosity of cube7 by auto", "<= 0.05 % rms, <= 0.2 % max",
       fmt::format("{}, {}", fine_percent(r.auto_light), fine_percent(r.auto_light_max)),
       r.auto_light <= 5e-4 && r.auto_light_max <= 2e-3});
}

void add_light(const AccuracyResults& r, List* list) {
  const double net = worst_of(r.cube7, [](const SceneNetTrial& t) { return t.light; });
  list->push_back({"radiosity of cube7 by network, converged", "<= 0.3 % rms", fine_percent(net),
                   net <= kNetLight});

  const double own = worst_of(r.near_hybrid, [](double light) { return light; });
  const double general = worst_of(r.general, [](const GeneralTrial& t) { return t.near_hybrid; });
  list->push_back(
      {"radiosity of cube7 by hemicube:32, network factors for pairs closer than 3 patches",
       "<= 1 % rms", fine_percent(own), own <= kNearLight});
  list->push_back({"the same by a general network", "<= 1 % rms", fine_percent(general),
                   general <= kNearLight});

  const double cornell = worst_of(r.cornell, [](const CornellTrial& t) { return t.light; });
  list->push_back({"Cornell box by hybrid:64, against Embree visibility (1024 rays a pair)",
                   "<= 3 % rms",
                   fmt::format("{} with its own networks, {} with a general one",
                               fine_percent(cornell), fine_percent(r.cornell_general)),
                   std::max(cornell, r.cornell_general) <= kCornellLight});
}

void add_chip(const AccuracyResults& r, List* list) {
  const double light = worst_of(r.chip, [](const ChipSolve& c) { return c.light; });
  const int shots = int(worst_of(r.chip, [](const ChipSolve& c) { return c.shots; }));
  const int indeed = int(worst_of(r.chip, [](const ChipSolve& c) { return c.shots_to_percent; }));
  const ChipSolve& first = r.chip.front();
  list->push_back({"cube7 on the micro:bit by network, stopped by its own estimate of 1 %",
                   "1 % rms",
                   fmt::format("{} after {} shots; 1 % after {} shots; these integers, on the host",
                               fine_percent(light), shots, indeed),
                   light <= kChipLight});
  list->push_back(
      {"the same, memory", "16 KB RAM, 256 KB flash",
       fmt::format(
           "solver and source {}, network {}; the linker refuses an image that does not fit",
           bytes_text(std::int64_t(first.ram_bytes)), bytes_text(first.net_bytes)),
       first.ram_bytes <= kChipRam && std::size_t(first.net_bytes) <= kChipFlash
           ? std::nullopt
           : std::optional<bool>(false)});
  list->push_back({"the same, integers", "those of the host",
                   "compared by `./run demo` and by the test firmware_microbit", std::nullopt});
  if (!r.solve_instructions) {
    list->push_back({"the same, Cortex-M0 instructions", "shown",
                     "not counted in this run; `./run accuracy` counts them", std::nullopt});
    return;
  }
  std::string text = fmt::format("{} to 1 %", grouped(std::llround(*r.solve_instructions)));
  if (r.shot_instructions)
    text += fmt::format(", {} a shot", grouped(std::llround(*r.shot_instructions)));
  if (r.pair_instructions)
    text += fmt::format(", {} a pair", grouped(std::llround(*r.pair_instructions)));
  list->push_back({"the same, Cortex-M0 instructions", "shown", text, true});
}

}  // namespace

const SceneMethodRow& row_of(const std::vector<SceneMethodRow>& table, const std::string& label) {
  for (const SceneMethodRow& row : table)
    if (row.row.label == label) return row;
  throw std::out_of_range("no method " + label + " in the table");
}

std::vector<Bound> bounds(const AccuracyResults& results) {
  List list;
  add_reference(results, &list);
  add_closed_form(results, &list);
  add_occluded("square obstruction, in a corner and in the middle", results.squares, &list);
  add_occluded(fmt::format("L-room, {} factors", results.l_room.size()), results.l_room, &list);
  add_cube_factors(results, &list);
  add_narrow(results, &list);
  add_auto(results, &list);
  add_light(results, &list);
  add_chip(results, &list);
  return list;
}

}  // namespace host
