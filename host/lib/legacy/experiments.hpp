// The open questions of the 1996 report, each answered by a measurement (docs/EXPERIMENTS.md).
#pragma once
#include "legacy/reproduce.hpp"
#include "method/nets.hpp"

namespace host {

struct ExperimentRequest {
  ReproduceRequest base;  ///< epochs: of every backpropagation; share: of pairs and passes
  NetChoice nets;         ///< the shipped general network and that of the cube
};

/// 5.2: are the sixteen vertex orders learned as one? Spread of F over them, networks trained on
/// the report's order and on random orders, and a network that sees invariants.
ResultTable experiment_orders(const ExperimentRequest& request, const CubeExperiment& cube);

/// 5.2: the test that the report proposes, the 24 inputs trained on the dot product of the normals.
ResultTable experiment_normals(const ExperimentRequest& request, const CubeExperiment& cube);

/// 5.3: larger networks, log and relative loss, by Adam on the same data.
ResultTable experiment_sizes(const ExperimentRequest& request, const CubeExperiment& cube);

/// 5.3: points on both patches and a kernel per pair of points, learned, against Gauss's points.
ResultTable experiment_sampling(const ExperimentRequest& request, const CubeExperiment& cube);

/// 5.1: one ray, n rays, all or nothing by subdivision, hemicube mask, on three occluded scenes.
ResultTable experiment_visibility(const ExperimentRequest& request);

/// 3.5: what bias and noise of one size do to light and to the picture.
ResultTable experiment_spread(const ExperimentRequest& request, const CubeExperiment& cube);

/// What 30 years changed: the report's networks, kernels, exact sums and today's networks, error
/// beside cost, on the cube and on the random quads.
ResultTable experiment_years(const ExperimentRequest& request, const CubeExperiment& cube);

}  // namespace host
