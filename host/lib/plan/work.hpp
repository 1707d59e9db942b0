// What a row of factors makes the engine do, as numbers that instructions are linear in.
#pragma once
#include <algorithm>
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
  facing,  ///< pairs skipped: facing away, found pair by pair
  behind,  ///< the same, found with one look at a surface
  evaluated,
  clipped,
  far,   ///< kernel alone
  near,  ///< exact sum
  sums,  ///< points of exact sums
  networks,
  hidden,  ///< networks times their hidden neurons
  rays,
  lit,  ///< rays of the pairs that light goes through: those are weighed
  ray_tests,
  spared,    ///< rays not made
  kept,      ///< blockers that rays are tested against, by pair
  rejected,  ///< blockers rejected by their bounds, by pair
  cells,     ///< of a hemicube, written or summed
  rows,      ///< of a hemicube, summed
  walks,     ///< passes over all polygons: faces times bands
  drawn,     ///< walks times evaluated
  patches,
  grid_rows,  ///< rows of receivers, for a pose table
  count
};
inline constexpr std::size_t kWorkTerms = std::size_t(WorkTerm::count);
inline constexpr std::array<std::string_view, kWorkTerms> kWorkNames = {
    "row",  "runs",     "same",     "facing", "behind", "evaluated", "clipped",   "far",
    "near", "sums",     "networks", "hidden", "rays",   "lit",       "ray_tests", "spared",
    "kept", "rejected", "cells",    "rows",   "walks",  "drawn",     "patches",   "grid_rows"};

using RowWork = std::array<double, kWorkTerms>;

/// What else a row depends on.
struct RowSetting {
  int hidden = 0;     ///< neurons of the network, 0: none
  int walks = 0;      ///< of a hemicube
  int grid_rows = 0;  ///< of a pose table
};

/// The work of `rows` rows in which the engine counted `c`, by row.
inline RowWork row_work(const urad_counters& c, const urad_scene& scene, const RowSetting& setting,
                        double rows = 1) {
  RowWork work{};
  const auto set = [&](WorkTerm term, double value) { work[std::size_t(term)] = value; };
  const auto counted = [&](WorkTerm term, double value) { set(term, value / rows); };
  set(WorkTerm::row, 1);
  set(WorkTerm::runs, scene.surface_count);
  counted(WorkTerm::same, c.skipped_same);
  counted(WorkTerm::facing, double(c.skipped_facing) - c.skipped_behind);
  counted(WorkTerm::behind, c.skipped_behind);
  counted(WorkTerm::evaluated, c.evaluated);
  counted(WorkTerm::clipped, c.clipped);
  counted(WorkTerm::far, c.far_pairs);
  counted(WorkTerm::near, c.near_pairs);
  counted(WorkTerm::sums, c.sums);
  counted(WorkTerm::networks, c.networks);
  counted(WorkTerm::hidden, double(setting.hidden) * c.networks);
  counted(WorkTerm::rays, c.rays);
  // Every pair has as many, made or spared.
  const double rays_of_pair = c.evaluated ? (double(c.rays) + c.rays_spared) / c.evaluated : 0;
  const double dark = double(c.blocked) - c.shut_unseen;
  counted(WorkTerm::lit, std::max(0.0, c.rays - rays_of_pair * dark));
  counted(WorkTerm::ray_tests, c.ray_tests);
  counted(WorkTerm::spared, c.rays_spared);
  counted(WorkTerm::kept, c.blockers_kept);
  counted(WorkTerm::rejected, c.blockers_rejected);
  counted(WorkTerm::cells, c.cells);
  counted(WorkTerm::rows, c.rows);
  set(WorkTerm::walks, setting.walks);
  counted(WorkTerm::drawn, setting.walks * double(c.evaluated));
  set(WorkTerm::patches, scene.patch_count);
  set(WorkTerm::grid_rows, setting.grid_rows);
  return work;
}

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

/// A hybrid in an occluded scene looks from the middles of the patch's quarters.
inline constexpr int kHybridEyes = 4;

/// Passes over all polygons that a hemicube makes for a row: bands of `rows` rows; 0: one in all.
constexpr int hemicube_walks(int resolution, int rows) {
  if (rows == 0) return 1;
  const auto bands = [&](int height) { return (height + rows - 1) / rows; };
  return bands(resolution) + 4 * bands(resolution / 2);
}

}  // namespace host
