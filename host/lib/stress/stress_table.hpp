// What a stress run has shown, for people.
#pragma once
#include <string>

#include "stress/stress_run.hpp"

namespace host {

/// Kind, cases, worst value and where, a line for each check of each family; failures first.
std::string stress_table(const StressReport& report);

/// The checks of one case.
std::string check_table(const std::vector<StressCheck>& checks);

/// The same as a document in Markdown.
std::string stress_document(const StressReport& report);

}  // namespace host
