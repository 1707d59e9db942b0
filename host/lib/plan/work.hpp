// What a row of factors makes the engine do, as numbers that instructions are linear in.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "urad/scene.h"
#include "urad/source.h"

namespace host {

/// Terms of the model: what the engine counts in a row, and sizes of the scene.
enum class WorkTerm : std::size_t {
  row,     ///< 1
  runs,    ///< calls of the source
  same,    ///< pairs skipped: same plane
  facing,  ///< pairs skipped: facing away
  looked,  ///< pairs of runs that a plane may cut, in which every pair is looked at
  evaluated,
  clipped,
  far,     ///< kernel alone
  near,    ///< exact sum
  sums,    ///< points of exact sums
  ran,     ///< pairs that ran a network
  hidden,  ///< the same, times its hidden neurons
  rays,
  ray_tests,
  traced,  ///< pairs between which a blocker may stand
  cells,   ///< of a hemicube, written or summed
  walks,   ///< passes over all polygons: faces times bands
  drawn,   ///< walks times evaluated
  patches,
  grid_rows,  ///< rows of receivers, for a pose table
  count
};
inline constexpr std::size_t kWorkTerms = std::size_t(WorkTerm::count);
inline constexpr std::array<std::string_view, kWorkTerms> kWorkNames = {
    "row",    "runs",  "same",  "facing", "looked",  "evaluated", "clipped",
    "far",    "near",  "sums",  "ran",    "hidden",  "rays",      "ray_tests",
    "traced", "cells", "walks", "drawn",  "patches", "grid_rows"};

using RowWork = std::array<double, kWorkTerms>;

/// What else a row depends on.
struct RowSetting {
  int traced = 0;     ///< WorkTerm::traced
  int looked = 0;     ///< WorkTerm::looked
  int hidden = 0;     ///< neurons of the network, 0: none
  int walks = 0;      ///< of a hemicube
  int grid_rows = 0;  ///< of a pose table
};

inline RowWork row_work(const urad_counters& c, const urad_scene& scene,
                        const RowSetting& setting) {
  RowWork work{};
  const auto set = [&](WorkTerm term, double value) { work[std::size_t(term)] = value; };
  set(WorkTerm::row, 1);
  set(WorkTerm::runs, scene.surface_count);
  set(WorkTerm::same, c.skipped_same);
  set(WorkTerm::facing, c.skipped_facing);
  set(WorkTerm::evaluated, c.evaluated);
  set(WorkTerm::clipped, c.clipped);
  set(WorkTerm::far, c.far_pairs);
  set(WorkTerm::near, c.near_pairs);
  const double ran = double(c.evaluated) - c.far_pairs - c.near_pairs;
  set(WorkTerm::looked, setting.looked);
  set(WorkTerm::sums, c.sums);
  set(WorkTerm::ran, setting.hidden ? ran : 0);
  set(WorkTerm::hidden, setting.hidden * ran);
  set(WorkTerm::rays, c.rays);
  set(WorkTerm::ray_tests, c.ray_tests);
  set(WorkTerm::traced, c.rays ? setting.traced : 0);
  set(WorkTerm::cells, c.cells);
  set(WorkTerm::walks, setting.walks);
  set(WorkTerm::drawn, setting.walks * double(c.evaluated));
  set(WorkTerm::patches, scene.patch_count);
  set(WorkTerm::grid_rows, setting.grid_rows);
  return work;
}

/// Pairs of one shooter that a pair source looks at one by one.
int looked_pairs(const urad_scene& scene, std::uint16_t shooter);

/// Pairs of one shooter between which a blocker may stand.
int traced_pairs(const urad_scene& scene, std::uint16_t shooter);

/// Instructions of one family of rows on a Cortex-M0, -O2, by term.
struct RowCost {
  std::string_view family;
  std::array<double, kWorkTerms> instructions{};

  double of(const RowWork& work) const {
    double sum = 0;
    for (std::size_t k = 0; k < kWorkTerms; ++k) sum += instructions[k] * work[k];
    return sum;
  }
};

struct TermCost {
  WorkTerm term;
  double instructions;
};

/// Terms that are not named cost nothing.
constexpr RowCost row_cost(std::string_view family, std::initializer_list<TermCost> costs) {
  RowCost result{family, {}};
  for (const TermCost& cost : costs)
    result.instructions[std::size_t(cost.term)] = cost.instructions;
  return result;
}

/// Passes over all polygons that a hemicube makes for a row: bands of `rows` rows; 0: one in all.
constexpr int hemicube_walks(int resolution, int rows) {
  if (rows == 0) return 1;
  const auto bands = [&](int height) { return (height + rows - 1) / rows; };
  return bands(resolution) + 4 * bands(resolution / 2);
}

}  // namespace host
