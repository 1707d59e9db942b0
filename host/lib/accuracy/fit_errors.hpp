// The constants of urad/cheapest.hpp: what each way to a form factor is off by, fitted to random
// pairs.
#pragma once
#include <string>

#include "urad/net.h"

namespace host {

struct ErrorFitRequest {
  std::string command;            ///< goes into the comment
  std::uint64_t seed = 1;         ///< of the pairs
  std::size_t pairs = 2000;       ///< of each family that is not kept for tests
  const urad_net* net = nullptr;  ///< the general network
  int threads = 0;
};

/// The text of firmware_style/src/cheapest_models.hpp. The same for the same request on any number
/// of threads.
std::string fitted_error_models(const ErrorFitRequest& request);

}  // namespace host
