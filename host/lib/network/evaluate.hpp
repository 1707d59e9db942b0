// Measures any form factor method against the reference: on a scene, and on random pairs.
#pragma once
#include <functional>

#include "network/error_table.hpp"
#include "network/general_pairs.hpp"
#include "network/scene_dataset.hpp"
#include "urad/net.h"

namespace host {

/// F from patch i to patch j of a scene.
using SceneMethod = std::function<double(std::size_t i, std::size_t j)>;
/// F from polygon p to polygon q.
using PairMethod = std::function<double(const Polygon& p, const Polygon& q)>;

/// The engine's unoccluded factors of `fixed`, which must outlive the method. net null: the moment
/// kernel alone.
SceneMethod engine_method(const FixedScene& fixed, const urad_net* net);
/// The engine's factor of a pair by itself. net null: the moment kernel alone.
PairMethod engine_method(const urad_net* net);

/// Both directions of every pair of the dataset.
std::vector<Measured> measure(const SceneDataset& dataset, const SceneMethod& method);

/// The same as a table whose first row knows the row sums.
std::vector<ErrorRow> evaluate(const std::string& name, const SceneDataset& dataset,
                               const SceneMethod& method);

/// Only the pairs whose configuration k has use[k] == wanted.
ErrorRow evaluate_part(const std::string& name, const SceneDataset& dataset,
                       const std::vector<char>& use, char wanted, const SceneMethod& method);

/// `count` random pairs of a family, reference once, each method on the same pairs; on all cores.
struct GeneralMeasurement {
  PairFamily family = PairFamily::free;
  std::vector<std::vector<Measured>> by_method;
};
std::vector<GeneralMeasurement> measure_general(const std::vector<PairMethod>& methods,
                                                std::uint64_t seed, std::size_t count,
                                                double far_rho, int threads);

std::string_view name(PairFamily family);

}  // namespace host
