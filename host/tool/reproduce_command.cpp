// urad reproduce: the experiments of the 1996 report, its numbers beside ours.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/output_folder.hpp"
#include "command.hpp"
#include "legacy/experiments.hpp"
#include "number_range.hpp"

namespace tool {

namespace {

constexpr int kEpochs = 4000, kQuickEpochs = 40;
constexpr double kQuickShare = 0.1;

struct Options {
  std::string what, out, document;
  int epochs = 0;
  std::uint64_t seed = 1;
  bool quick = false;
};

host::ReproduceRequest request_of(const Options& options, const Common& common) {
  host::ReproduceRequest request;
  request.folder = options.out;
  request.epochs = options.epochs > 0 ? options.epochs : options.quick ? kQuickEpochs : kEpochs;
  request.share = options.quick ? kQuickShare : 1;
  request.command_tail = options.quick ? " --quick" : "";
  request.seed = options.seed;
  request.threads = common.threads;
  request.quiet = common.quiet;
  std::string less;
  if (request.epochs < kEpochs)
    less = fmt::format("{} epochs instead of {}", request.epochs, kEpochs);
  if (options.quick)
    less += fmt::format("{}{:.0f} % of the random samples", less.empty() ? "" : ", ",
                        100 * kQuickShare);
  if (!less.empty()) request.shortened = "Shortened: " + less + ".";
  return request;
}

void run(const Options& options, const Common& common) {
  const host::ReproduceRequest request = request_of(options, common);
  const std::string document = options.document.empty() ? "" : host::read_file(options.document);
  const host::OutputFolder folder(options.out);
  const auto asked = [&](const std::string& what) {
    return options.what == what || (options.what == "all" && what != "experiments");
  };
  std::vector<host::ResultTable> shown;
  const auto show = [&](const std::vector<host::ResultTable>& tables) {
    for (const host::ResultTable& table : tables) {
      shown.push_back(table);
      const std::string path = folder.file(table.file);
      host::write_file_atomically(path + ".csv", host::to_csv(table));
      host::write_file_atomically(path + ".md", host::to_markdown(table));
      fmt::print("{}\n", host::to_text(table));
    }
  };
  if (asked("table3.1") || asked("table3.2")) {
    std::vector<host::ResultTable> tables = host::reproduce_random(request);
    if (options.what != "all")
      std::erase_if(tables, [&](const auto& table) { return table.file != options.what; });
    show(tables);
  }
  if (asked("table4.1") || asked("figure4.3") || asked("section2.9")) {
    const host::CubeExperiment cube =
        host::cube_experiment(request, options.what == "figure4.3" ? 50 : 0);
    if (asked("table4.1")) show(host::reproduce_cube(request, cube));
    if (asked("figure4.3")) show(host::reproduce_figure(request, cube));
    if (asked("section2.9")) {
      show(host::reproduce_operations(request, cube));
      show(host::reproduce_training(request, cube));
    }
  }
  if (asked("experiments")) {
    const host::ExperimentRequest experiments{request, {shipped_net, nullptr, shipped_legacy_net}};
    const host::CubeExperiment cube = host::cube_experiment(request);
    const auto add = [&](host::ResultTable table) {
      if (!request.shortened.empty()) table.notes.push_back(request.shortened);
      show({table});
    };
    add(host::experiment_orders(experiments, cube));
    add(host::experiment_normals(experiments, cube));
    add(host::experiment_sizes(experiments, cube));
    add(host::experiment_sampling(experiments, cube));
    add(host::experiment_visibility(experiments));
    add(host::experiment_spread(experiments, cube));
    add(host::experiment_years(experiments, cube));
  }
  if (!options.document.empty())
    host::write_file_atomically(options.document,
                                host::with_tables(document, shown, options.document));
}

}  // namespace

void add_reproduce(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "reproduce",
      "The 1996 report again, its numbers beside ours; a run that was interrupted goes on where it "
      "was");
  command
      ->add_option(
          "WHAT", options->what,
          "table3.1, table3.2, table4.1, figure4.3, section2.9, all; experiments: the report's "
          "open questions")
      ->required()
      ->check(CLI::IsMember(std::set<std::string>{"table3.1", "table3.2", "table4.1", "figure4.3",
                                                  "section2.9", "experiments", "all"}));
  command
      ->add_option("--epochs", options->epochs,
                   fmt::format("Epochs of every training; default {}, the report's", kEpochs))
      ->check(between(1, 1'000'000));
  command->add_option("--seed", options->seed, "Start weights, split, random quads")
      ->capture_default_str();
  command->add_flag("--quick", options->quick,
                    fmt::format("{} epochs and a tenth of the random samples", kQuickEpochs));
  command->add_option("-o,--out", options->out, "Folder for tables, pictures and networks")
      ->required();
  command->add_option("--document", options->document,
                      "Markdown whose tables between <!-- NAME --> and <!-- end --> are replaced");
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
