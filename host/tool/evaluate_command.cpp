// urad evaluate: the error of networks and methods by decade of F and by kind of pair, against the
// reference; and the constants of auto, fitted.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <sstream>

#include "accuracy/fit_errors.hpp"
#include "accuracy/method_document.hpp"
#include "accuracy/method_plots.hpp"
#include "base/file.hpp"
#include "command.hpp"
#include "net_option.hpp"
#include "network/evaluate.hpp"
#include "network/net_json.hpp"
#include "scene_option.hpp"

namespace tool {

namespace {

struct Options {
  std::vector<std::string> nets;
  std::string methods, instructions, scene, document, out = "-";
  bool fit_auto = false;
  host::MeshOptions mesh;
  int bits = 16;
  std::size_t pairs = 4000;
  std::uint64_t seed = 20240229;
};

/// The meshing that a net was trained with, from the command that it keeps.
host::MeshOptions mesh_of_command(const std::string& command) {
  host::MeshOptions mesh;
  std::istringstream words(command);
  for (std::string word; words >> word;) {
    if (word == "--subdivide") words >> mesh.subdivide;
    if (word == "--patch-size") words >> mesh.patch_size;
  }
  return mesh;
}

struct Entry {
  std::string name;
  const urad_net* net;  // null: the kernel alone
};

std::string on_scene(const host::Scene& scene, const std::vector<Entry>& entries, double far_rho,
                     const Common& common) {
  const host::FixedScene fixed(scene);
  const host::SceneDataset dataset =
      host::scene_dataset(scene, fixed, far_rho, 1, 400000, common.threads);
  std::string text = fmt::format("Scene {}: {} ordered pairs, {} configurations\n\n", scene.name,
                                 2 * dataset.pairs.size(), dataset.configurations.size());
  for (const Entry& entry : entries)
    text +=
        host::to_text(host::evaluate(entry.name, dataset, host::engine_method(fixed, entry.net))) +
        "\n";
  return text;
}

std::string on_random_pairs(const Options& options, const std::vector<Entry>& entries,
                            double far_rho, const Common& common) {
  std::vector<host::PairMethod> methods;
  methods.reserve(entries.size());
  for (const Entry& entry : entries) methods.push_back(host::engine_method(entry.net));
  const auto families =
      host::measure_general(methods, options.seed, options.pairs, far_rho, common.threads);
  std::string text = fmt::format("Random pairs, seed {}\n\n", options.seed);
  for (std::size_t m = 0; m < entries.size(); ++m)
    for (const host::GeneralMeasurement& family : families)
      text += host::to_text(host::error_table(
                  fmt::format("{}, {}", entries[m].name, host::name(family.family)),
                  family.by_method[m])) +
              "\n";
  return text;
}

/// Any methods on the test pairs of every family; the first net, if any, is the general one.
host::MethodTrials on_trial_pairs(const Options& options, const Common& common) {
  const Nets nets(options.nets.empty() ? "" : options.nets.front());
  host::TrialRequest request;
  request.methods = host::trial_methods(nets.choice());
  if (!options.methods.empty()) {
    request.methods.clear();
    for (const host::MethodSpec& spec : host::parse_methods(options.methods))
      request.methods.push_back({spec.text(), spec, nets.choice()});
  }
  std::optional<host::InstructionCounts> counts;
  if (!options.instructions.empty()) {
    counts.emplace(options.instructions);
    request.instructions = &*counts;
  }
  request.seed = options.seed;
  request.pairs = options.pairs;
  request.threads = common.threads;
  return host::try_methods(request);
}

std::string trials_text(const Options& options, const Common& common) {
  return fmt::format("Test pairs, seed {}, {} of each family, against the reference.\n",
                     options.seed, options.pairs) +
         host::to_markdown(on_trial_pairs(options, common));
}

/// The document, and its pictures beside it.
void write_document(const Options& options, const Common& common) {
  const std::filesystem::path path = options.document;
  const host::MethodTrials trials = on_trial_pairs(options, common);
  host::MethodDocument document;
  document.command = fmt::format("urad evaluate --pairs {} --seed {}", options.pairs, options.seed);
  if (!options.methods.empty()) document.command += " --method " + options.methods;
  if (!options.instructions.empty()) document.command += " --instructions " + options.instructions;
  document.command += " --document " + options.document;
  const auto draw = [&](const char* ending, host::MethodCost cost) {
    const std::string svg = host::method_plots_svg(trials, cost);
    const std::string name = path.stem().string() + ending;
    if (!svg.empty()) host::write_file_atomically((path.parent_path() / name).string(), svg);
    return svg.empty() ? std::string() : name;
  };
  document.time_chart = draw("_time.svg", host::MethodCost::host_ns);
  document.instruction_chart = draw("_instructions.svg", host::MethodCost::m0_instructions);
  host::write_file_atomically(options.document, host::method_document(trials, document));
}

std::string fitted_auto(const Options& options, const Common& common) {
  host::ErrorFitRequest request;
  request.command = fmt::format("urad evaluate --fit-auto --pairs {}", options.pairs);
  request.pairs = options.pairs;
  const Nets nets(options.nets.empty() ? "" : options.nets.front());
  request.net = nets.choice().general();
  request.threads = common.threads;
  return host::fitted_error_models(request);
}

void run(const Options& options, const Common& common) {
  if (!options.document.empty()) return write_document(options, common);
  if (options.fit_auto || !options.methods.empty() || options.nets.empty()) {
    host::write_file_atomically(options.out, options.fit_auto ? fitted_auto(options, common)
                                                              : trials_text(options, common));
    return;
  }
  std::vector<host::NetFile> files;
  for (const std::string& path : options.nets) files.push_back(host::read_net(path));
  std::vector<Entry> entries{{"moment kernel", nullptr}};
  for (std::size_t k = 0; k < files.size(); ++k)
    entries.push_back({options.nets[k], &files[k].quantised(options.bits).pod()});
  const double far_rho = files.front().far_rho;
  std::string text;
  const bool general = files.front().subject == "general";
  const std::string& scene =
      options.scene.empty() && !general ? files.front().subject : options.scene;
  if (!scene.empty()) {
    const bool own =
        options.scene.empty() && !options.mesh.subdivide && !(options.mesh.patch_size > 0);
    const host::MeshOptions mesh = own ? mesh_of_command(files.front().command) : options.mesh;
    text += on_scene(host::load_scene(scene, mesh), entries, far_rho, common);
  }
  if (scene.empty()) text += on_random_pairs(options, entries, far_rho, common);
  host::write_file_atomically(options.out, text);
}

}  // namespace

void add_evaluate(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("evaluate",
                                         "Error of networks or methods by decade of F and kind of "
                                         "pair: networks on a scene or on random "
                                         "pairs, methods on pairs of every kind, with their cost");
  command->add_option("nets", options->nets, "net.json ...; none: methods");
  command->add_option(
      "--method", options->methods,
      "M[,M...]: these instead of all, on pairs of every kind; the first net.json is "
      "their network");
  command->add_option("--instructions", options->instructions,
                      "icount.json of bench/icount: Cortex-M0 instructions beside the methods");
  command->add_flag(
      "--fit-auto", options->fit_auto,
      "Fit the constants of method auto and write firmware_style/src/cheapest_models.hpp");
  command->add_option(
      "--scene", options->scene,
      "Scene to measure on; default: the first net's own, meshed as it was trained");
  add_mesh_options(command, &options->mesh);
  command->add_option("--bits", options->bits, "Which of the quantised nets")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str();
  command->add_option("--pairs", options->pairs, "Random pairs of each family")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the random pairs")->capture_default_str();
  command->add_option("--document", options->document,
                      "Markdown to write with every method on pairs of every kind; pictures go "
                      "beside it");
  command->add_option("-o,--out", options->out, "Text file; \"-\": standard output")
      ->capture_default_str();
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
