// urad accuracy: every number the project promises, measured, as docs/ACCURACY.md.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "accuracy/document.hpp"
#include "base/file.hpp"
#include "command.hpp"

namespace tool {

namespace {

struct Options {
  std::vector<std::uint64_t> seeds{1, 2, 3, 4, 5}, general_seeds;
  bool quick = false, shipped_general = false;
  std::string instructions, out;
};

constexpr std::size_t kQuickPairs = 100;

/// As someone else would type it.
std::string command_line(const Options& options) {
  std::string line = fmt::format("urad accuracy --seeds {}", fmt::join(options.seeds, ","));
  if (options.shipped_general)
    line += " --shipped-general";
  else if (!options.general_seeds.empty())
    line += fmt::format(" --general-seeds {}", fmt::join(options.general_seeds, ","));
  if (options.quick) line += " --quick";
  if (!options.instructions.empty()) line += " --instructions " + options.instructions;
  return line + " -o " + options.out;
}

void run(const Options& options, const Common& common) {
  host::AccuracyRequest request;
  request.command = command_line(options);
  request.seeds = options.seeds;
  request.general_seeds = options.general_seeds.empty() ? options.seeds : options.general_seeds;
  if (options.quick) {
    request.seeds.resize(1);
    request.pairs = kQuickPairs;
  }
  if (options.quick || options.shipped_general) request.general_seeds.clear();
  request.shipped = shipped_net;
  request.shipped_legacy = shipped_legacy_net;
  request.instructions = options.instructions;
  request.threads = common.threads;
  request.quiet = common.quiet;
  host::write_file_atomically(options.out, host::accuracy_document(host::run_accuracy(request)));
}

}  // namespace

void add_accuracy(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "accuracy", "Train afresh, measure every promised number, write a document");
  command->add_option("--seeds", options->seeds, "Seeds of the trainings")
      ->delimiter(',')
      ->capture_default_str();
  auto* general = command
                      ->add_option("--general-seeds", options->general_seeds,
                                   "Seeds of the general networks; default: those of --seeds")
                      ->delimiter(',');
  command
      ->add_flag("--shipped-general", options->shipped_general,
                 "Train no general network, take the shipped one")
      ->excludes(general);
  command->add_flag("--quick", options->quick,
                    "First seed only, shipped general network, fewer random pairs");
  command->add_option("--instructions", options->instructions,
                      "icount.json of bench/icount/run.sh, for the rows of the micro:bit");
  command->add_option("-o,--out", options->out, "Document to write (\"-\": standard output)")
      ->required();
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
