// General networks of several widths and seeds: what they are off by in double and as integers, and
// whether any of them stands on a front of error against cost.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "accuracy/method_trials.hpp"
#include "accuracy/training_trials.hpp"
#include "network/net_json.hpp"

namespace host {

/// Errors of one form of a network: on random pairs that it has not seen, and on cube7, neither.
struct NetworkErrors {
  ErrorRow pairs, cube;
  double cube_apart_std = 0;  ///< of cube7 without its pairs that share an edge
};

struct NetworkTrial {
  NetFile net;
  NetworkErrors real, int16, int8;  ///< real: the network in double, all else as in the engine
};

struct NetworkRequest {
  std::vector<int> hidden{4, 6, 8, 12, 16};
  std::vector<std::uint64_t> seeds{1};
  double effort = 1;         ///< of each training: TrainRequest
  std::size_t pairs = 1000;  ///< random pairs of each of six families to judge by
  std::size_t trials = 200;  ///< pairs of each family of trial_pairs.hpp for the fronts
  NetChoice nets;            ///< what `auto` uses
  int threads = 0;
  std::function<void(int hidden, std::uint64_t seed)> progress;
};

/// Trains and judges every width with every seed.
std::vector<NetworkTrial> try_networks(const NetworkRequest& request);

/// By multiply-adds: the best network of each width (least p95 on random pairs), alone and with near
/// pairs handed over to the exact sum, beside kernels, exact sums and auto.
MethodTrials try_fronts(const NetworkRequest& request, const std::vector<NetworkTrial>& trials);

/// docs/NETWORKS.md. Every number comes from these.
std::string network_document(const std::vector<NetworkTrial>& trials, const MethodTrials& fronts,
                             const std::vector<TrainingTrial>& optimisers,
                             const std::vector<TrainingTrial>& inputs, const std::string& command);

}  // namespace host
