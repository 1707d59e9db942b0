// What every method returns.
#pragma once
#include <limits>

namespace host {

/// Form factor from p to q, 0..1, and the method's own estimate of its relative error (NaN when it
/// has none).
struct Estimate {
  double f = 0;
  double relative_error = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace host
