#include "report/solve_json.hpp"

#include <nlohmann/json.hpp>

#include "report/counters_json.hpp"

namespace host {

namespace {

using Json = nlohmann::ordered_json;

Json three(const std::int64_t* x) { return Json::array({x[0], x[1], x[2]}); }

Json facts(const Scene& scene) {
  return {{"name", scene.name},
          {"patches", scene.patches.size()},
          {"surfaces", scene.surfaces.size()},
          {"blockers", scene.blockers.size()},
          {"convex", scene.convex},
          {"closed", scene.closed}};
}

Json shots(const urad_radiosity_counters& c) {
  return {{"shots", c.shots},
          {"shots_empty", c.shots_empty},
          {"updates", c.updates},
          {"skipped_channel", c.skipped_channel},
          {"skipped_black", c.skipped_black},
          {"skipped_dark", c.skipped_dark},
          {"rows_over", c.rows_over},
          {"rows_off", c.rows_off},
          {"rows_cut", c.rows_cut}};
}

}  // namespace

std::string solve_json(const Scene& scene, const std::string& method, const MethodRun& run) {
  const FixedSolution& solution = run.solution;
  const Json json = {
      {"scene", facts(scene)},
      {"method", method},
      {"shots", solution.shots},
      {"error",
       {{"converged_rms", solution.error}, {"exact_rms", run.rms}, {"exact_max", run.max}}},
      {"form_factors",
       {{"pairs", run.factors.pairs},
        {"std", run.factors.std},
        {"max", run.factors.max},
        {"bias", run.factors.bias},
        {"row_mean", run.factors.row_mean},
        {"row_worst", run.factors.row_worst},
        {"repaired", !run.scale.empty()},
        {"host_seconds", run.rows.seconds}}},
      {"sweep", counters_json(run.rows.counters)},
      {"solver", shots(solution.counters)},
      {"energy",
       {{"emitted", three(solution.ledger.emitted)},
        {"absorbed", three(solution.ledger.absorbed)},
        {"unshot", three(solution.ledger.unshot)},
        {"escaped", three(solution.ledger.escaped)},
        {"exact", solution.ledger_exact}}},
      {"memory",
       {{"solver_ram_bytes", solution.ram_bytes}, {"source_ram_bytes", run.rows.ram_bytes}}},
  };
  return json.dump(2) + "\n";
}

std::string exact_json(const Scene& scene, const ExactSolution& exact,
                       const PairStatistics& pairs) {
  const Eigen::VectorXd sums = exact.form_factors.rowwise().sum();
  const Json json = {
      {"scene", facts(scene)},
      {"method", "exact"},
      {"form_factors", {{"row_least", sums.minCoeff()}, {"row_most", sums.maxCoeff()}}},
      {"pairs",
       {{"all", pairs.all},
        {"facing", pairs.facing},
        {"seen", pairs.seen},
        {"partly", pairs.partly},
        {"blocked", pairs.blocked}}},
      {"host_seconds", exact.seconds}};
  return json.dump(2) + "\n";
}

}  // namespace host
