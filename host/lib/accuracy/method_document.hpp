// docs/METHODS.md: every method on every kind of pair, with its cost.
#pragma once
#include <string>

#include "accuracy/method_trials.hpp"

namespace host {

struct MethodDocument {
  std::string command;                        ///< as someone else would type it
  std::string time_chart, instruction_chart;  ///< file names of pictures; empty: none
};

/// Markdown. Every number comes from `trials`.
std::string method_document(const MethodTrials& trials, const MethodDocument& document);

}  // namespace host
