#include "method/pairs_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/parallel.hpp"
#include "base/remark.hpp"
#include "geometry/parse.hpp"

namespace host {

namespace {

/// id and the outcome of every method for one row.
struct Row {
  std::vector<PairResult> results;
};

PairResult refused(PolygonStatus status) {
  return {{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()},
          std::string(name(status))};
}

Row evaluate(const CsvRow& row, std::size_t columns, std::size_t p_column, std::size_t q_column,
             const std::vector<FreePairMethod>& methods) {
  ParsedPolygon p, q;
  PolygonStatus status = PolygonStatus::invalid_syntax;
  if (row.cells.size() == columns) {
    p = parse_polygon(row.cells[p_column]);
    q = parse_polygon(row.cells[q_column]);
    status = p.status != PolygonStatus::ok ? p.status : q.status;
  }
  Row result;
  for (const FreePairMethod& method : methods) {
    result.results.push_back(status == PolygonStatus::ok ? method.run(p.polygon, q.polygon)
                                                         : refused(status));
  }
  return result;
}

}  // namespace

std::string pairs_table(const CsvTable& pairs, const std::vector<MethodSpec>& specs,
                        const NetChoice& nets, int threads, bool quiet) {
  const std::size_t id = pairs.column("id"), p = pairs.column("p"), q = pairs.column("q");
  std::vector<FreePairMethod> methods;
  std::vector<std::string> header{"id"};
  for (const MethodSpec& spec : specs) {
    methods.push_back(pair_method(spec, nets));
    const std::string suffix = specs.size() == 1 ? "" : "_" + spec.text();
    header.push_back("f" + suffix);
    header.push_back("status" + suffix);
    if (methods.back().knows_error) header.push_back("error" + suffix);
  }

  std::vector<Row> rows(pairs.rows.size());
  Progress progress("form factors", rows.size(), quiet);
  parallel_for(rows.size(), threads, [&](std::size_t k) {
    rows[k] = evaluate(pairs.rows[k], pairs.header.size(), p, q, methods);
    progress.add();
  });

  std::string text = csv_line(header), first;
  std::size_t failed = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const CsvRow& row = pairs.rows[k];
    std::vector<std::string> cells{id < row.cells.size() ? row.cells[id] : ""};
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const PairResult& result = rows[k].results[m];
      const bool ok = result.status == "ok";
      cells.push_back(ok ? csv_number(result.estimate.f) : "");
      cells.push_back(result.status);
      if (methods[m].knows_error)
        cells.push_back(ok ? csv_number(result.estimate.relative_error) : "");
    }
    text += csv_line(cells);
    const auto bad = std::find_if(rows[k].results.begin(), rows[k].results.end(),
                                  [](const PairResult& result) { return result.status != "ok"; });
    if (bad == rows[k].results.end()) continue;
    if (failed++ == 0) first = fmt::format("line {}, {}", row.line, bad->status);
  }
  if (failed && !quiet)
    remark(fmt::format("{} of {} rows have no factor by every method; the first: {}\n", failed,
                       rows.size(), first));
  return text;
}

}  // namespace host
