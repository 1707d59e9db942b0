// Error and cost of every method side by side: on the same pairs, in the same run.
#pragma once
#include <string>
#include <vector>

#include "accuracy/pair_sets.hpp"
#include "method/nets.hpp"
#include "method/spec.hpp"
#include "network/error_table.hpp"
#include "network/scene_dataset.hpp"

namespace host {

/// A row to be measured. "net" runs `nets.file`.
struct TableMethod {
  std::string label;
  MethodSpec spec;
  NetChoice nets;
};

struct MethodRow {
  std::string label;
  ErrorRow errors;  ///< over all pairs
  double ns = 0;    ///< host time per ordered pair, one core
};

/// Root of the mean squared error.
double rms(const ErrorRow& row);

/// F of every pair of a set by one method, and the time of all together.
struct MethodValues {
  std::vector<double> f;
  double ns = 0;
};
MethodValues method_values(const PairSet& set, const TableMethod& method);

/// Every method on the pairs of a set. Methods in double start from the vertices. Those of the
/// engine start from a scene of the two patches that was made before, as a chip has it in flash.
std::vector<MethodRow> measure_pairs(const PairSet& set, const std::vector<TableMethod>& methods);

struct SceneMethodRow {
  MethodRow row;                ///< errors.rows holds the row sums
  std::vector<ErrorRow> table;  ///< all, by decade, by kind of pair: error_table()
};

/// Every method on both directions of the pairs of `dataset`, which is all of `scene`; unoccluded.
/// The engine runs whole rows, the way a solver asks for them.
std::vector<SceneMethodRow> measure_scene(const Scene& scene, const SceneDataset& dataset,
                                          const std::vector<TableMethod>& methods);

/// The share of the squared error that pairs of this kind hold, 0 .. 1, and how many they are.
struct ErrorShare {
  std::size_t pairs = 0;
  double share = 0;
};
ErrorShare error_share(const std::vector<ErrorRow>& table, PairKind kind);

}  // namespace host
