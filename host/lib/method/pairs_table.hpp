// pairs.csv in, factors out: many pairs by several methods, a status per row.
#pragma once
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "base/progress.hpp"
#include "method/pair_method.hpp"

namespace host {

/// The table of `urad formfactor --in`: columns id, then f, status and (for methods that know it)
/// error; with several methods f_M, status_M, error_M. One line per row of `pairs`, in its order; a
/// bad row never stops the run. Throws Error when a column is missing or a method is unknown.
std::string pairs_table(const CsvTable& pairs, const std::vector<MethodSpec>& methods,
                        const NetChoice& nets, int threads, bool quiet);

/// The table of `urad formfactor --scene`: scene, f, status; one line per scene in the order of
/// first appearance. P is cut into about subdivide x subdivide pieces; blockers are opaque from
/// both sides.
std::string scenes_table(const CsvTable& rows, const MethodSpec& method, const NetChoice& nets,
                         int subdivide, int threads, bool quiet);

}  // namespace host
