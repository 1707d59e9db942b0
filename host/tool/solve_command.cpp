// urad solve: light in a scene, by any method, in the engine's integers.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/remark.hpp"
#include "net_option.hpp"
#include "number_range.hpp"
#include "report/solve_json.hpp"
#include "scene_option.hpp"
#include "solve/scene_solver.hpp"

namespace tool {

namespace {

struct Options {
  SceneOption scene;
  std::string method, net, out, rows, report;
  std::optional<int> shots;
  double error = 0.01;
  int rays = 1024;
  bool no_exact = false;
  host::EngineOptions engine;
};

std::string radiosity_table(const host::Scene& scene, const std::vector<host::Vec3>& radiosity) {
  std::string text = host::csv_line({"patch", "B_r", "B_g", "B_b"});
  for (std::size_t row = 0; row < radiosity.size(); ++row) {
    const host::Vec3& b = radiosity[scene.patch_of_row(row)];
    text += host::csv_line({scene.label_of_row(row), host::csv_number(b.x), host::csv_number(b.y),
                            host::csv_number(b.z)});
  }
  return text;
}

std::string rows_table(const host::Scene& scene,
                       const std::function<double(std::size_t, std::size_t)>& f) {
  std::vector<std::string> cells{"patch"};
  const std::size_t n = scene.patches.size();
  for (std::size_t j = 0; j < n; ++j) cells.push_back(fmt::format("F{}", j));
  std::string text = host::csv_line(cells);
  for (std::size_t i = 0; i < n; ++i) {
    cells = {scene.label_of_row(i)};
    for (std::size_t j = 0; j < n; ++j)
      cells.push_back(host::csv_number(f(scene.patch_of_row(i), scene.patch_of_row(j))));
    text += host::csv_line(cells);
  }
  return text;
}

void refuse(const std::string& scene, urad_status status) {
  if (status == URAD_OK) return;
  const char* why =
      status == URAD_DIVERGES
          ? "the solve does not converge: row sums times reflectance reach 1; a lower "
            "reflectance or a method with better row sums would do"
      : status == URAD_OVERFLOW
          ? "a power left its 32 bits: a lower reflectance or a dimmer lamp would do"
          : "the engine refused the scene";
  throw host::Error(fmt::format("{}: {}", scene, why));
}

/// Whether patches shine with nothing but what they emit.
bool all_dark(const host::Scene& scene, const std::vector<host::Vec3>& radiosity) {
  for (std::size_t k = 0; k < radiosity.size(); ++k)
    if (glm::any(glm::greaterThan(radiosity[k], 1.0001 * scene.material_of(k).exitance)))
      return false;
  return true;
}

void run(const Options& options, const Common& common) {
  host::expect_different_files({{"SCENE", options.scene.name},
                                {"--net", options.net},
                                {"--out", options.out},
                                {"--rows", options.rows},
                                {"--report", options.report}});
  std::vector<host::OutputFile> files;
  const Nets nets(options.net);
  const host::MethodSpec spec = host::parse_method(options.method);
  const host::Scene scene = options.scene.load();
  host::SceneSolver solver(scene, common.threads, common.quiet, options.rays);
  solver.use(options.engine);
  if (spec.name == "exact") {
    const host::ExactSolution& exact = solver.exact();
    if (!options.rows.empty()) {
      files.push_back({options.rows, rows_table(scene, [&](std::size_t i, std::size_t j) {
                         return exact.form_factors(Eigen::Index(i), Eigen::Index(j));
                       })});
    }
    if (!options.report.empty())
      files.push_back(
          {options.report,
           host::exact_json(scene, exact, host::pair_statistics(scene, common.threads, 64))});
    files.push_back({options.out, radiosity_table(scene, exact.radiosity)});
    host::write_files_atomically(files);
    return;
  }
  host::SolveGoal goal;
  goal.shots = options.shots;
  goal.error = options.error;
  // Who neither reads the sentence at the end nor the report has no use for the comparison.
  goal.against_exact = !options.no_exact && !(common.quiet && options.report.empty());
  if (!(goal.error > 0)) throw host::UsageError("--error should be a number above 0");
  const host::MethodRun result = solver.run(spec, nets.choice(), goal);
  refuse(options.scene.name, result.solution.status);
  if (!goal.shots && !(result.solution.error <= goal.error)) {
    throw host::Error(fmt::format(
        "{}: {} shots brought B to {:.3g} % rms only, and more would not help; a larger --error, a "
        "lower reflectance or --shots N would do",
        options.scene.name, result.solution.shots, 100 * result.solution.error));
  }
  if (!options.rows.empty()) files.push_back({options.rows, rows_table(scene, result.rows)});
  if (!options.report.empty())
    files.push_back({options.report, host::solve_json(scene, spec.text(), result)});
  files.push_back({options.out, radiosity_table(scene, result.solution.radiosity)});
  host::write_files_atomically(files);
  if (!common.quiet) {
    const std::string exact =
        goal.against_exact ? fmt::format(" and {:.3g} % of the exact solution", 100 * result.rms)
                           : " one";
    host::remark(fmt::format("{} by {}: {} shots, B within {:.3g} % rms of the converged{}\n",
                             options.scene.name, spec.text(), result.solution.shots,
                             100 * result.solution.error, exact));
    if (all_dark(scene, result.solution.radiosity))
      host::remark(fmt::format(
          "{}: no light falls on any patch. The lit side of a face is the one from which its "
          "vertices run counter-clockwise: are they turned the other way?\n",
          options.scene.name));
  }
}

}  // namespace

void add_solve(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("solve", "Light in a scene: radiosity per patch");
  options->scene.add_to(command);
  command
      ->add_option(
          "--method", options->method,
          "exact, auto[:ERROR], net[:NAME], fixed-kernel, fixed-moment, table, hemicube:R, "
          "hybrid[:R], legacy:NAME, or a "
          "pair method in double")
      ->required();
  command->add_option("--net", options->net, "JSON of the network for net, auto and hybrid");
  auto* shots = command->add_option("--shots", options->shots, "Stop after N shots")
                    ->check(between(1, 1 << 30));
  command
      ->add_option("--error", options->error,
                   "Stop at this relative rms error of B, without what patches emit themselves, "
                   "against the converged solution of the same factors")
      ->check(between(1e-7, 1.0))
      ->capture_default_str()
      ->excludes(shots);
  command
      ->add_option(
          "--rays", options->rays,
          "Rays a pair of patches of the exact solution, where something may stand between")
      ->check(between(1, 1 << 20))
      ->capture_default_str();
  command
      ->add_option("--bound", options->engine.bound,
                   "Pair methods with rays: leave out small factors as long as no row loses more "
                   "than this; 0: none")
      ->check(between(0.0, 0.5));
  command
      ->add_option("--pair-rays", options->engine.rays,
                   "Rays a pair by the engine, where something may stand between")
      ->check(between(1, 1024))
      ->capture_default_str();
  command
      ->add_option("--ray-error", options->engine.ray_error,
                   "Pair methods: the fewer rays, the further a form factor is below this; 0: the "
                   "same for all")
      ->check(between(0.0, 1.0));
  command
      ->add_option("--cuts", options->engine.cuts,
                   "With --ray-error: cut patches so often where rays disagree")
      ->check(between(0, 6));
  command->add_option("--out", options->out, "CSV of the solution (\"-\": standard output)")
      ->required();
  command->add_option("--rows", options->rows, "CSV of all form factors, before repair");
  command->add_flag("--no-exact", options->no_exact,
                    "Do not compare with the exact solution, the dearest part of large scenes");
  command->add_option("--report", options->report, "JSON: shots, errors, counters, ledger, memory");
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
