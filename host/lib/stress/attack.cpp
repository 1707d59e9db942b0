#include "stress/attack.hpp"

#include <algorithm>

namespace host {

void Findings::measure(std::string_view what, double value, double limit) {
  if (std::isnan(value)) value = std::numeric_limits<double>::infinity();
  const auto known = std::find_if(checks_.begin(), checks_.end(),
                                  [&](const StressCheck& check) { return check.what == what; });
  if (known == checks_.end())
    checks_.push_back({std::string(what), value, limit});
  else
    known->value = std::max(known->value, value);
}

}  // namespace host
