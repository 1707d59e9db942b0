// The experiments of the 1996 report, run again: each printed number beside ours.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "legacy/legacy_training.hpp"
#include "legacy/result_table.hpp"
#include "scene/scene.hpp"

namespace host {

struct ReproduceRequest {
  std::string folder;  ///< results; networks in folder/nets
  int epochs = 4000;
  double share = 1;          ///< of the random samples
  std::string command_tail;  ///< " --quick", as typed: part of the networks' commands
  std::uint64_t seed = 1;
  int threads = 0;
  bool quiet = false;
  /// A sentence on what is less than in the report; empty: nothing.
  std::string shortened;
};

/// Chapter 3: Tables 3.1 and 3.2. Writes random_pairs.csv: set, polygons, exact, hemicube, network.
std::vector<ResultTable> reproduce_random(const ReproduceRequest& request);

/// The cube of chapter 4 with exact factors and the networks trained on it.
struct CubeExperiment {
  Scene scene;  ///< seen from inside the luminous side
  Eigen::MatrixXd exact;
  std::vector<LegacyNetFile> nets;  ///< linear 50, 30, 15, 5, then log 30, 15, 5
};

/// hidden: only networks of this size and linear scaling; 0: all seven.
CubeExperiment cube_experiment(const ReproduceRequest& request, int hidden = 0);

/// What the analytic library was asked for (Figure 4.1): the ordered pairs whose faces see each
/// other.
std::vector<LegacySample> legacy_samples(const CubeExperiment& cube, LegacyScaling scaling);

/// F(i, j) of a network, 0 where the patches' faces do not see each other (Figure 4.1).
Eigen::MatrixXd legacy_factors(const Scene& scene, const LegacyNet& net, int threads);

/// Largest |eigenvalue|.
double spectral_radius(const Eigen::MatrixXd& matrix);

/// Table 4.1, and the table that explains which methods "blew up".
std::vector<ResultTable> reproduce_cube(const ReproduceRequest& request,
                                        const CubeExperiment& cube);

/// Figure 4.3: writes the six plates and the sheet as PNG, and the three solutions as CSV.
std::vector<ResultTable> reproduce_figure(const ReproduceRequest& request,
                                          const CubeExperiment& cube);

/// Section 2.9: operations counted beside its formulas, and time.
std::vector<ResultTable> reproduce_operations(const ReproduceRequest& request,
                                              const CubeExperiment& cube);

/// Section 4.2.3: how long the cube's networks train, on one core.
std::vector<ResultTable> reproduce_training(const ReproduceRequest& request,
                                            const CubeExperiment& cube);

}  // namespace host
