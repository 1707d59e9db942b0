// From a scene, or from nothing, to a finished net.json: data, training, quantisation, errors.
#pragma once
#include <functional>
#include <optional>

#include "network/general_pairs.hpp"
#include "network/net_json.hpp"
#include "network/trainer.hpp"
#include "scene/scene.hpp"

namespace host {

struct TrainRequest {
  int hidden = 8;
  std::uint64_t seed = 1;
  double far_rho = 0.01;   ///< pairs below it take the kernel alone
  int threads = 0;         ///< 0: all cores
  double effort = 1;       ///< share of the usual pairs and steps, for tests; above 0, at most 1
  std::string command;     ///< goes into the file; decides whether a checkpoint fits
  std::string checkpoint;  ///< path of the unfinished state, removed at the end; empty: none
  std::function<void(double)> progress;  ///< 0 .. 1
  std::function<bool()> stop;            ///< true: write the checkpoint and give up
};

/// A net for one scene: a compressed table of its factors. Where that leaves an error above 3e-5
/// (standard deviation of F), it hands near and clipped pairs over to the exact sum. It is trained
/// on all configurations, its held-out error comes from a second net trained on 80 % of them.
/// Nothing when stopped. Throws Error.
std::optional<NetFile> train_scene_net(const Scene& scene, const TrainRequest& request);

/// What train_general_net() learns from, and how.
GeneralDataset general_training(const TrainRequest& request);
TrainerSettings general_settings(const TrainRequest& request);

/// A net for any scene, from random pairs.
std::optional<NetFile> train_general_net(const TrainRequest& request);

}  // namespace host
