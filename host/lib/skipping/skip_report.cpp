#include "skipping/skip_report.hpp"

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "report/svg_plot.hpp"
#include "scene/builtin.hpp"
#include "solve/exact.hpp"
#include "solve/fixed_solve.hpp"
#include "solve/relight.hpp"
#include "solve/repair.hpp"
#include "solve/scene_solver.hpp"
#include "urad/radiosity.hpp"

namespace host {
namespace {

constexpr const char* kBoard = "microbit";

std::map<std::string, double> read_counts(const std::string& path) {
  if (path.empty()) return {};
  const auto json = nlohmann::json::parse(read_file(path), nullptr, false);
  if (json.is_discarded() || !json.is_object() || !json.contains(kBoard)) {
    throw Error(path + ": not a table of counted instructions; ./run skipping writes one");
  }
  std::map<std::string, double> counts;
  for (const auto& [what, value] : json.at(kBoard).items())
    counts[what] = value.at("mean").get<double>();
  return counts;
}

EngineRows repaired_rows(const Scene& scene, const NetChoice& nets, int threads) {
  FixedScene fixed(scene);
  const MethodSpec net = parse_method("net");
  EngineRows rows = engine_rows(fixed, net, nets, {.rays = kSkipRays}, threads);
  if (!scene.closed) return rows;
  Eigen::MatrixXd f(rows.patches, rows.patches);
  for (std::size_t i = 0; i < rows.patches; ++i) {
    for (std::size_t j = 0; j < rows.patches; ++j) f(Eigen::Index(i), Eigen::Index(j)) = rows(i, j);
  }
  fixed.set_scale(symmetric_scale(scene, f));
  return engine_rows(fixed, net, nets, {.rays = kSkipRays}, threads);
}

EarlyAnswer early_answer(const Scene& scene, const EngineRows& rows, bool overshoot, bool ambient) {
  EarlyAnswer answer;
  answer.name = overshoot && ambient ? "overshooting, ambient term"
                : overshoot          ? "overshooting"
                : ambient            ? "ambient term"
                                     : "plain";
  Relighting light(scene, rows, overshoot);
  const std::vector<Vec3> truth = light.converged();
  const int most = 8 * int(rows.patches);
  int next = 0;
  for (int shots = 0; shots < most && next < 4; ++shots) {
    const double error = relative_rms(scene, ambient ? light.display() : light.radiosity(), truth);
    for (; next < 4 && error <= kEarlyErrors[next]; ++next) answer.shots[next] = shots;
    if (light.step(1) == 0) break;
  }
  return answer;
}

}  // namespace

SkipReport skip_report(const std::string& name, const NetChoice& nets, const std::string& counted,
                       int threads) {
  const Scene scene = load_scene(name);
  const FixedScene fixed(scene);
  SkipReport report;
  report.scene = name;
  report.patches = scene.patches.size();
  report.blockers = scene.blockers.size();
  report.instructions = read_counts(counted);
  report.pairs = pair_statistics(scene, threads, 64);
  const auto sweep = [&](const char* method, const EngineOptions& options) {
    return engine_rows(fixed, parse_method(method), nets, options, threads).counters;
  };
  report.by_pairs = sweep("net", {.rays = kSkipRays});
  report.bounded = sweep("net", {.rays = kSkipRays, .bound = kSkipBound});
  report.by_hybrid = sweep("hybrid:64", {.rays = kSkipRays});
  SceneSolver solver(scene, threads, true, 256);
  const auto error = [&](const EngineOptions& options) {
    solver.use(options);
    SolveGoal goal;
    goal.error = 0.001;
    return solver.run(parse_method("net"), nets, goal).rms;
  };
  report.error_fixed = error({.rays = kManyRays});
  report.error_worth = error({.rays = kManyRays, .ray_error = kSkipBound});
  const EngineRows rows = repaired_rows(scene, nets, threads);
  for (const bool overshoot : {false, true}) {
    for (const bool ambient : {false, true})
      report.early.push_back(early_answer(scene, rows, overshoot, ambient));
  }
  return report;
}

std::string skip_chart(const std::vector<SkipReport>& reports) {
  std::vector<Bar> bars;
  for (const SkipReport& r : reports) {
    const urad_counters& c = r.by_pairs;
    const std::uint64_t rays = c.rays / kSkipRays;
    const std::uint64_t seen = c.evaluated > rays ? c.evaluated - rays : 0;
    bars.push_back(
        {r.scene,
         {{"evaluated with rays", rays, "#2f6f8f"},
          {"evaluated, no blocker between", seen, "#6fae9f"},
          {"same surface", c.skipped_same, "#7a5c8e"},
          {"wholly behind", c.skipped_behind, "#b9a04a"},
          {"facing away", std::uint64_t{c.skipped_facing} - c.skipped_behind, "#8b8f98"}}});
  }
  return share_bars_svg(bars, "What becomes of all pairs of a sweep");
}

}  // namespace host
