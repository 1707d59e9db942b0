// The page a bake ends with.
#pragma once
#include <string>
#include <vector>

#include "report/bake_report.hpp"

namespace host {

/// One self-contained page for one or more scenes: pictures and plots inline, no script, no
/// network. Follows the reader's light or dark setting. All text from outside is escaped.
std::string report_html(const std::vector<BakeReport>& reports);

}  // namespace host
