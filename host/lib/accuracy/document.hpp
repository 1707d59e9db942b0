// docs/ACCURACY.md.
#pragma once
#include <string>

#include "accuracy/accuracy_run.hpp"

namespace host {

/// Markdown. Every number comes from `results`; no dates, no paths but those the command was given.
std::string accuracy_document(const AccuracyResults& results);

}  // namespace host
