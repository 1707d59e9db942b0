// What the stress run is made of: attacks that draw hostile cases and look at what comes of them.
#pragma once
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "network/random.hpp"

namespace host {

/// Something that must hold of a case: fine while value <= limit.
struct StressCheck {
  std::string what;
  double value = 0;
  double limit = 0;  ///< infinity: shown, never a failure
  bool holds() const { return value <= limit; }
};

/// What one case has shown.
class Findings {
 public:
  /// The worst of several values of one name counts. A value that is no number is an infinite one.
  void measure(std::string_view what, double value,
               double limit = std::numeric_limits<double>::infinity());
  /// A yes or no, as 0 or 1 with the limit 0.
  void expect(std::string_view what, bool holds) { measure(what, holds ? 0 : 1, 0); }

  const std::vector<StressCheck>& checks() const { return checks_; }

 private:
  std::vector<StressCheck> checks_;
};

/// One family of hostile cases. The text of a case is all that its run needs: a failure is written
/// down as that text, and runs again from it.
struct Attack {
  std::string kind, family;
  std::function<std::string(Random&)> draw;
  std::function<void(const std::string& input, Findings*)> run;
};

}  // namespace host
