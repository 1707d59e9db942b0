// What else might find a factor, or guess its error: trials beside the ways that the engine has.
#pragma once
#include <string>
#include <vector>

#include "accuracy/base_trials.hpp"
#include "accuracy/guess_limits.hpp"
#include "accuracy/third_order_trials.hpp"

namespace host {

struct KernelTrialRequest {
  double effort = 1;              ///< share of pairs and steps, above 0, at most 1
  const urad_net* net = nullptr;  ///< the general network
  int threads = 0;
};

struct KernelTrials {
  std::vector<ThirdOrderRow> third_order;
  std::vector<ThirdOrderCost> third_order_costs;
  std::vector<BaseTrials> bases;
  std::vector<GuessLimit> guesses;
};

KernelTrials try_kernels(const KernelTrialRequest& request);

/// docs/KERNELS.md. Every number comes from the trials.
std::string kernel_document(const KernelTrials& trials, const std::string& command);

}  // namespace host
