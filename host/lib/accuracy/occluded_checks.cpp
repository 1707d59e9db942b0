#include "accuracy/occluded_checks.hpp"

#include "base/csv.hpp"
#include "base/error.hpp"
#include "geometry/parse.hpp"
#include "method/pairs_table.hpp"

namespace host {

namespace {

CsvTable scenes(const std::vector<KnownValue>& values) {
  CsvTable table{"known values", {"scene", "role", "polygon"}, {}};
  for (const KnownValue& value : values) {
    const auto add = [&](const char* role, const Polygon& polygon) {
      table.rows.push_back({table.rows.size() + 2, {value.name, role, write_polygon(polygon)}});
    };
    add("P", value.p);
    add("Q", value.q);
    for (const Polygon& blocker : value.blockers) add("B", blocker);
  }
  return table;
}

std::vector<double> factors(const CsvTable& rows, const MethodSpec& method, int subdivide,
                            int threads) {
  const CsvTable result =
      parse_csv(scenes_table(rows, method, {}, subdivide, threads, true), method.text());
  const std::size_t f = result.column("f"), status = result.column("status");
  std::vector<double> list;
  for (const CsvRow& row : result.rows) {
    if (row.cells[status] != "ok") throw Error(row.cells[0] + ": " + row.cells[status]);
    list.push_back(std::stod(row.cells[f]));
  }
  return list;
}

}  // namespace

std::vector<OccludedCheck> check_occluded(const std::vector<KnownValue>& values, int threads) {
  const CsvTable rows = scenes(values);
  const std::vector<double> hybrid = factors(rows, {"hybrid", "64"}, 4, threads);
  const std::vector<double> rays = factors(rows, {"rays", "256"}, 1, threads);
  const std::vector<double> cut = factors(rows, {"rays", "256"}, 4, threads);
  std::vector<OccludedCheck> checks;
  for (std::size_t k = 0; k < values.size(); ++k)
    checks.push_back({values[k].name, values[k].f, hybrid[k], rays[k], cut[k]});
  return checks;
}

}  // namespace host
