// urad bake: everything a renderer and a person want of one scene: pictures, vertex colours, C
// arrays, report.
#include <fmt/format.h>

#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/output_folder.hpp"
#include "base/remark.hpp"
#include "net_option.hpp"
#include "number_range.hpp"
#include "pose/pose_table.hpp"
#include "report/animation.hpp"
#include "report/apng.hpp"
#include "report/instructions.hpp"
#include "report/ply.hpp"
#include "report/report_html.hpp"
#include "report/solve_json.hpp"
#include "report/text.hpp"
#include "scene/c_export.hpp"
#include "scene_option.hpp"
#include "solve/scene_solver.hpp"

namespace tool {

namespace {

struct Options {
  SceneOption scene;
  std::string methods = "exact,net,hemicube:64,hybrid:64", net, folder, instructions, visibility;
  double error = 0.001;
  int size = 480;
  bool animate = false;
};

std::string command_of(const Options& options) {
  std::string text = fmt::format("urad bake {} --method {}", options.scene.name, options.methods);
  if (options.scene.mesh.subdivide > 0)
    text += fmt::format(" --subdivide {}", options.scene.mesh.subdivide);
  if (options.scene.mesh.patch_size > 0)
    text += fmt::format(" --patch-size {}", options.scene.mesh.patch_size);
  if (options.error != Options{}.error) text += fmt::format(" --error {}", options.error);
  if (!options.visibility.empty()) text += " --visibility " + options.visibility;
  if (options.animate) text += " --animate";
  if (options.size != Options{}.size) text += fmt::format(" --size {}", options.size);
  if (!options.net.empty()) text += " --net " + options.net;
  return text + " -o " + options.folder;
}

std::string file_of(std::string method) {
  std::replace(method.begin(), method.end(), ':', '_');
  return method;
}

host::MethodResult exact_result(host::SceneSolver& solver) {
  host::MethodResult result;
  result.name = "exact";
  result.title = solver.scene().convex ? "Exact factors, dense solve"
                                       : "Exact factors, traced visibility, dense solve";
  result.reference = true;
  result.B = solver.exact().radiosity;
  result.seconds = solver.exact().seconds;
  return result;
}

host::EnergyAudit audit_of(const urad_ledger& ledger) {
  host::EnergyAudit audit;
  for (std::size_t c = 0; c < 3; ++c) {
    audit.emitted[c] = ledger.emitted[c];
    audit.absorbed[c] = ledger.absorbed[c];
    audit.unshot[c] = ledger.unshot[c];
    audit.escaped[c] = ledger.escaped[c];
  }
  return audit;
}

host::MethodResult method_result(const std::string& name, const host::MethodRun& run) {
  const host::FixedSolution& solution = run.solution;
  const double pairs = double(run.rows.patches) * double(run.rows.patches - 1);
  host::MethodResult result;
  result.name = name;
  result.B = solution.radiosity;
  result.errors = {run.rms,
                   run.max,
                   run.factors.std,
                   run.factors.max,
                   run.factors.row_mean,
                   run.factors.row_worst};
  result.shots = std::uint32_t(solution.shots);
  result.seconds = run.rows.seconds + solution.seconds;
  result.ns_per_pair = run.rows.seconds / pairs * 1e9;
  result.ram_bytes = std::int64_t(solution.ram_bytes + run.rows.ram_bytes);
  result.memory = {{"solver: unshot and shot power, one run of factors",
                    host::bytes_text(std::int64_t(solution.ram_bytes))},
                   {"source of factors", host::bytes_text(std::int64_t(run.rows.ram_bytes))}};
  result.counters = run.rows.counters;
  result.solver = solution.counters;
  result.audit = audit_of(solution.ledger);
  return result;
}

std::vector<host::Fact> facts(const host::Scene& scene, const host::SceneSolver& solver) {
  return {{"Patches", std::to_string(scene.patches.size())},
          {"Surfaces", std::to_string(scene.surfaces.size())},
          {"Polygons that can stand between patches", std::to_string(scene.blockers.size())},
          {"Convex", scene.convex ? "yes: no visibility is computed" : "no"},
          {"Closed", scene.closed ? "yes: rows are repaired to sum to 1" : "no: light escapes"},
          {"Scene units per unit of the file",
           fmt::format("{:.6g}", solver.fixed().units_per_length())},
          {"Exitance per integer", fmt::format("{:.6g}", solver.fixed().exitance_unit())}};
}

std::vector<host::Fact> network_facts(const host::NetFile* file) {
  if (!file) return {};
  std::vector<host::Fact> result = {{"Trained by", file->command}, {"Split", file->split}};
  for (const host::ErrorRow& row : file->errors) result.push_back({row.name, host::to_line(row)});
  return result;
}

void add_method(const host::OutputFolder& folder, const host::Scene& scene,
                const host::MethodResult& method, const host::CornerMesh& mesh, double white,
                std::vector<host::OutputFile>* files) {
  const std::string stem = folder.file(file_of(method.name));
  files->push_back({stem + ".png", method.pictures.smooth});
  if (!method.pictures.difference.empty())
    files->push_back({stem + "_difference.png", method.pictures.difference});
  files->push_back({stem + ".ply", host::ply(scene, mesh, method.B, white)});
}

/// A strip of light that moves, a wall that is painted and an object that moves, each as animated PNG
/// and table.
void write_animations(const host::OutputFolder& folder, const host::Scene& scene,
                      const host::EngineRows& rows, const host::NetChoice& nets,
                      const host::PictureOptions& pictures, host::BakeReport* report) {
  host::AnimationOptions options;
  options.picture = pictures;
  const auto write = [&](const std::string& name, const host::Animation& animation,
                         const std::string& what) {
    host::write_file_atomically(folder.file(name + ".png"), host::apng(animation.frames, 33));
    host::write_file_atomically(folder.file(name + ".csv"), animation.table);
    report->files.push_back({name + ".png, .csv", what});
  };
  write("moving_strip", host::animate_strip(scene, rows, options),
        "a strip of light that moves over the lamp, 20 shots a frame, and the error of each frame");
  write("painted_wall", host::animate_wall(scene, rows, options),
        "a wall that is painted, 20 shots a frame, and the error of each frame");
  const host::Animation object = host::animate_object(scene, nets, options);
  if (!object.frames.empty())
    write(
        "moved_object", object,
        "an object that moves, 20 shots a frame, and the pairs made again and the error by frame");
}

void run(const Options& options, const Common& common) {
  const Nets nets(options.net);
  const host::Scene scene = options.scene.load();
  host::SceneSolver solver(scene, common.threads, common.quiet);
  std::unique_ptr<host::InstructionCounts> counts;
  if (!options.instructions.empty())
    counts = std::make_unique<host::InstructionCounts>(options.instructions);
  const host::OutputFolder folder(options.folder);

  host::BakeReport report;
  report.title = scene.name;
  report.scene = options.scene.name;
  report.version = URAD_VERSION;
  report.command = command_of(options);
  report.facts = facts(scene, solver);
  if (!options.visibility.empty()) {
    const host::VisibilityCode code = host::parse_visibility_code(options.visibility);
    report.facts.push_back(
        {"Exported visibility, in flash", host::to_line(solver.use_visibility(code))});
  }
  report.network = network_facts(nets.file());
  report.reproduce = {report.command};

  host::SolveGoal goal;
  goal.error = options.error;
  const std::string name = host::c_identifier(scene.name);
  std::string light, scene_arrays, pose_arrays;
  host::EngineRows rows;
  for (const host::MethodSpec& spec : host::parse_methods(options.methods)) {
    if (!common.quiet) host::remark(fmt::format("{}: {}\n", options.scene.name, spec.text()));
    if (spec.name == "exact") {
      report.methods.push_back(exact_result(solver));
      continue;
    }
    const host::MethodRun run = solver.run(spec, nets.choice(), goal);
    if (run.solution.status != URAD_OK) {
      throw host::Error(fmt::format(
          "{} by {}: the solve stopped with status {}; a lower reflectance or another method "
          "would do",
          options.scene.name, spec.text(), int(run.solution.status)));
    }
    if (rows.patches == 0) rows = run.repaired;
    host::MethodResult result = method_result(spec.text(), run);
    if (counts) {
      result.m0_instructions_per_pair = counts->per_pair(spec.text());
      if (const auto shot = counts->per_shot(spec.text()))
        result.m0_instructions = *shot * *result.shots;
    }
    if (light.empty())
      light = host::light_to_c(solver.fixed(), run.solution.raw, name, report.command);
    // The scene goes out with the repair that belongs to the network's factors, or else to those of
    // the first method.
    if (scene_arrays.empty() || spec.name == "net") {
      scene_arrays = host::scene_to_c(solver.fixed(), name, report.command);
    }
    if (spec.name == "table") {
      const host::PoseLayout& layout = solver.poses().layout();
      pose_arrays = host::poses_to_c(solver.poses(), name, report.command);
      result.memory.push_back(
          {"pose table, in flash", host::bytes_text(std::int64_t(layout.bytes()))});
      report.facts.push_back({"Distinct relative poses", std::to_string(layout.classes)});
    }
    report.methods.push_back(std::move(result));
  }

  host::PictureOptions pictures;
  pictures.width = pictures.height = options.size;
  pictures.threads = common.threads;
  host::add_pictures(scene, pictures, &report);
  if (options.animate) {
    if (rows.patches == 0)
      throw host::UsageError("--animate needs a method of the engine beside exact, such as net");
    write_animations(folder, scene, rows, nets.choice(), pictures, &report);
  }
  const host::CornerMesh mesh = host::merge_corners(scene);
  const double white = host::white_level(scene, solver.exact().radiosity);
  std::vector<host::OutputFile> files;
  for (const host::MethodResult& method : report.methods) {
    add_method(folder, scene, method, mesh, white, &files);
    report.files.push_back(
        {file_of(method.name) + ".png, .ply", "picture and vertex colours by " + method.label()});
  }
  if (!light.empty()) {
    files.push_back({folder.file("scene.h"), scene_arrays});
    files.push_back({folder.file("light.h"), light});
    report.files.push_back({"scene.h, light.h", "the scene and its light as C arrays"});
  }
  if (!pose_arrays.empty()) {
    files.push_back({folder.file("poses.h"), pose_arrays});
    report.files.push_back({"poses.h", "the pose table as C arrays"});
  }
  files.push_back({folder.file("report.json"), host::report_json({report})});
  files.push_back({folder.file("report.html"), host::report_html({report})});
  host::write_files_atomically(files);
}

}  // namespace

void add_bake(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "bake", "Pictures, vertex colours, C arrays and a report of a solved scene");
  options->scene.add_to(command);
  command->add_option("--method", options->methods, "M[,M...], as for solve")
      ->capture_default_str();
  command->add_option("--net", options->net, "JSON of the network for net and hybrid");
  command->add_option("--error", options->error, "Stop each solve at this relative rms error of B")
      ->check(between(1e-7, 1.0))
      ->capture_default_str();
  command->add_option("--size", options->size, "Width and height of the pictures")
      ->check(between(16, 4096));
  command->add_flag(
      "--animate", options->animate,
      "Also animated PNGs of light that changes: a strip of the lamp that moves, a "
      "wall that is painted; by the first method's factors; and an object that moves");
  command->add_option("--visibility", options->visibility,
                      "Export what every pair sees, so that the chip makes no rays: bits or "
                      "fractions (4 bits); net and other pair methods then solve with it");
  command->add_option("--instructions", options->instructions,
                      "Counted Cortex-M0 instructions (bench/icount)");
  command->add_option("-o,--out", options->folder, "Folder to write into")->required();
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
