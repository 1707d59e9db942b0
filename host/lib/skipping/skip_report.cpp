#include "skipping/skip_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "report/svg_plot.hpp"
#include "scene/builtin.hpp"
#include "solve/exact.hpp"
#include "solve/fixed_solve.hpp"
#include "solve/moving.hpp"
#include "solve/relight.hpp"
#include "solve/repair.hpp"
#include "solve/scene_solver.hpp"
#include "urad/radiosity.hpp"

namespace host {
namespace {

constexpr const char* kBoard = "microbit";
constexpr int kSettled = 6;  // shots a patch until nothing changes that a table shows

std::map<std::string, double> read_counts(const std::string& path) {
  const Error malformed(path + ": not a table of counted instructions; ./run skipping writes one");
  const auto json = nlohmann::json::parse(read_file(path), nullptr, false);
  if (json.is_discarded() || !json.is_object() || !json.contains(kBoard)) throw malformed;
  std::map<std::string, double> counts;
  for (const auto& [what, value] : json.at(kBoard).items()) {
    if (!value.is_object() || !value.contains("mean") || !value["mean"].is_number())
      throw malformed;
    counts[what] = value["mean"].get<double>();
  }
  if (!counts.contains("on")) throw malformed;
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
    answer.errors.push_back(error);
    for (; next < 4 && error <= kEarlyErrors[next]; ++next) answer.shots[next] = shots;
    if (light.step(1) == 0) break;
  }
  return answer;
}

/// Shots until `light` is within each of kEarlyErrors of `truth`.
void count_shots(Moving* light, const std::vector<Vec3>& truth, int* shots_to) {
  const int most = 8 * int(truth.size());
  int next = 0;
  for (int shots = 0; shots < most && next < 4; ++shots) {
    const double error = relative_rms(light->scene(), light->radiosity(), truth);
    for (; next < 4 && error <= kEarlyErrors[next]; ++next) shots_to[next] = shots;
    if (light->step(1) == 0) break;
  }
}

std::optional<MovedAnswer> moved_answer(const Scene& scene, const NetChoice& nets) {
  const std::vector<int> object = smallest_object(scene);
  const Motion motion{glm::dmat3(1), free_way(scene, object, scene.camera.up)};
  if (object.empty() || motion.by == Vec3(0)) return std::nullopt;
  const MethodSpec net = parse_method("net");
  const EngineOptions options{.rays = kSkipRays};
  const Scene there = moved_scene(scene, object, motion);
  Moving light(scene, net, nets, options, true), from_start(there, net, nets, options, true);
  MovedAnswer answer;
  light.step(kSettled * int(scene.patches.size()));
  light.move(object, motion);
  const urad_move& last = light.last();
  answer.patches = last.patch_count;
  answer.made = last.made;
  answer.pairs = std::size_t{last.made} + last.kept;
  Moving truth(there, net, nets, options, true);
  truth.step(kSettled * int(scene.patches.size()));
  answer.before = relative_rms(there, light.radiosity(), truth.radiosity());
  count_shots(&light, truth.radiosity(), answer.shots);
  count_shots(&from_start, truth.radiosity(), answer.from_start);
  return answer;
}

/// Each patch shoots in turn what it has, whatever that is.
std::vector<double> errors_by_number(const Scene& scene, const EngineRows& rows) {
  const std::size_t n = rows.patches;
  std::vector<Vec3> b(n), unshot(n);
  for (std::size_t k = 0; k < n; ++k) b[k] = unshot[k] = scene.material_of(k).exitance;
  const std::vector<Vec3> truth = Relighting(scene, rows, false).converged();
  std::vector<double> errors;
  for (std::size_t shots = 0; shots < 20 * n; ++shots) {
    errors.push_back(relative_rms(scene, b, truth));
    if (errors.back() <= kEarlyErrors[3]) break;
    const std::size_t i = shots % n;
    const Vec3 power = scene.patches[i].moments.area * unshot[i];
    unshot[i] = Vec3(0);
    for (std::size_t j = 0; j < n; ++j) {
      const Vec3 met = rows(i, j) / scene.patches[j].moments.area * power;
      b[j] += scene.material_of(j).reflectance * met;
      unshot[j] += scene.material_of(j).reflectance * met;
    }
  }
  return errors;
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
  if (!counted.empty()) {
    report.instructions = read_counts(counted + "/" + name + ".json");
    if (!scene.convex)
      report.instructions["sight"] = read_counts(counted + "/" + name + ".sight.json").at("on");
  }
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
  report.error_few = error({.rays = kSkipRays});
  report.error_fixed = error({.rays = kManyRays});
  report.error_worth = error({.rays = kManyRays, .ray_error = kSkipBound});
  if (!scene.convex) {
    report.bytes_bits = solver.use_visibility(VisibilityCode::bits).bytes();
    report.error_bits = error({});
    report.bytes_fractions = solver.use_visibility(VisibilityCode::fractions).bytes();
    report.error_fractions = error({});
  }
  report.moved = moved_answer(scene, nets);
  const EngineRows rows = repaired_rows(scene, nets, threads);
  report.by_number = errors_by_number(scene, rows);
  for (const bool overshoot : {false, true}) {
    for (const bool ambient : {false, true})
      report.early.push_back(early_answer(scene, rows, overshoot, ambient));
  }
  return report;
}

std::string early_chart(const SkipReport& report) {
  const auto count = [&](const char* what) {
    const auto at = report.instructions.find(what);
    return at == report.instructions.end() ? 0 : at->second;
  };
  const bool counted = count("on") > 0;
  const double on = counted ? count("on") + count("solver_on") : 1;
  const double off = counted ? count("all") + count("solver_all") : 1;
  const auto curve = [&](const std::string& name, const std::vector<double>& errors, double shot) {
    PlotCurve result{name, {}};
    // Steps of a fiftieth, no shot twice.
    double at = 1;
    while (at < double(errors.size())) {
      result.points.push_back({at * shot, errors[std::size_t(at)]});
      at = std::max(at + 1, at * 1.02);
    }
    return result;
  };
  std::vector<PlotCurve> curves{curve("in turn, nothing skipped", report.by_number, off)};
  for (const EarlyAnswer& answer : report.early)
    curves.push_back(curve(answer.name == "plain" ? "largest first, skips" : "+ " + answer.name,
                           answer.errors, on));
  return curves_svg(
      curves, {"How early " + report.scene + " can be shown",
               counted ? "Cortex-M0 instructions" : "shots", "", "rms error of what is shown"});
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
