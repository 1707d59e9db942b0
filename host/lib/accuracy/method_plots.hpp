// Error against cost of every method on every kind of pair, drawn, and who stands on a front.
#pragma once
#include <string>

#include "accuracy/method_trials.hpp"

namespace host {

/// What a method costs.
enum class MethodCost { host_ns, m0_instructions };

/// One SVG: a plot a family, what 95 % of its pairs are off by less than against the cost, the
/// Pareto front drawn. Methods without that cost are left out; empty when all are.
std::string method_plots_svg(const MethodTrials& trials, MethodCost cost);

/// Markdown: for each method the families on whose front it stands, by either cost; a method on
/// none is named as such.
std::string front_table(const MethodTrials& trials);

/// Markdown: what others measured or reported elsewhere, marked as such.
std::string peer_table();

}  // namespace host
