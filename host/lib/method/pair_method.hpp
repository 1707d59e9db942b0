// Form factors of free polygon pairs by any method of the command line.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "form_factor/estimate.hpp"
#include "geometry/polygon.hpp"
#include "method/nets.hpp"
#include "method/spec.hpp"

namespace host {

/// What a method made of one pair: a factor, or why it has none ("unsupported_...").
struct PairResult {
  Estimate estimate;
  std::string status = "ok";
};

/// A method ready to run on any number of threads.
struct FreePairMethod {
  std::function<PairResult(const Polygon& p, const Polygon& q)> run;
  bool knows_error = false;  ///< fills estimate.relative_error
};

/// "lambert:N": what pair_method() takes, as it is typed.
const std::vector<std::string>& pair_method_names();
bool is_pair_method(const MethodSpec& spec);

/// Throws Error for an unknown name (listing those known) or a value out of range. `nets` must
/// outlive the result.
FreePairMethod pair_method(const MethodSpec& spec, const NetChoice& nets);

}  // namespace host
