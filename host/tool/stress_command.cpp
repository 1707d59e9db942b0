// urad stress: hostile input of every kind until time is up.
#include <fmt/format.h>

#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/parallel.hpp"
#include "command.hpp"
#include "number_range.hpp"
#include "stress/stress_run.hpp"
#include "stress/stress_table.hpp"

namespace tool {

namespace {

struct Options {
  std::vector<std::string> kinds = host::stress_kinds();
  std::uint64_t seed = 1;
  double minutes = 1;
  std::size_t cases = 0;
  std::string folder, document, file, one;
};

std::string command_line(const Options& options) {
  std::string line = fmt::format("urad stress --seed {}", options.seed);
  if (options.cases > 0)
    line += fmt::format(" --cases {}", options.cases);
  else
    line += fmt::format(" --minutes {}", options.minutes);
  if (options.kinds != host::stress_kinds())
    line += fmt::format(" --kind {}", fmt::join(options.kinds, ","));
  return line;
}

/// "FAMILY#N", by its number in a run of this seed.
host::StressCase numbered_case(const Options& options) {
  const std::size_t hash = options.one.rfind('#');
  for (const std::string& kind : options.kinds)
    for (const host::Attack& attack : host::attacks_of(kind, {shipped_net}))
      if (hash != std::string::npos && attack.family == options.one.substr(0, hash))
        return host::stress_case(attack, options.seed,
                                 std::strtoull(options.one.c_str() + hash + 1, nullptr, 10));
  throw host::UsageError("--case " + options.one + ": no such family; it should be FAMILY#N");
}

/// The checks of one case; fails when one of them does.
void run_again(const host::StressCase& stress_case, const std::string& where) {
  const std::vector<host::StressCheck> checks = host::replay(stress_case, {shipped_net});
  fmt::print("{}", host::check_table(checks));
  for (const host::StressCheck& check : checks)
    if (!check.holds()) throw host::Error(where + ": " + check.what + " does not hold");
}

void run(const Options& options, const Common& common) {
  if (!options.file.empty())
    return run_again(host::case_from_text(host::read_file(options.file), options.file),
                     options.file);
  if (!options.one.empty()) {
    const host::StressCase one = numbered_case(options);
    if (!options.folder.empty())
      host::write_file_atomically(options.folder + "/one.case", host::to_text(one));
    return run_again(one, options.one);
  }
  host::StressRequest request;
  request.command = command_line(options);
  request.kinds = options.kinds;
  request.seed = options.seed;
  request.minutes = options.minutes;
  request.cases = options.cases;
  request.folder = options.folder;
  request.nets = {shipped_net};
  request.threads = int(host::thread_count(common.threads));
  request.quiet = common.quiet;
  const host::StressReport report = host::run_stress(request);
  fmt::print("{}", host::stress_table(report));
  if (!options.document.empty())
    host::write_file_atomically(options.document, host::stress_document(report));
  if (report.failures() > 0)
    throw host::Error(fmt::format("{} checks of this run do not hold; the table begins with them",
                                  report.failures()));
}

}  // namespace

void add_stress(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "stress", "Hostile input of every kind until time is up; writes what breaks");
  command->add_option("--kind", options->kinds, "pairs, networks, solver, scenes, files")
      ->delimiter(',');
  command->add_option("--seed", options->seed, "Of all cases")->capture_default_str();
  auto* minutes = command->add_option("--minutes", options->minutes, "Time for all kinds together")
                      ->check(positive())
                      ->capture_default_str();
  command->add_option("--cases", options->cases, "So many of every family, instead of a time")
      ->check(positive())
      ->excludes(minutes);
  command->add_option("-o,--out", options->folder, "Folder for the failures");
  command->add_option("--document", options->document, "The table as Markdown");
  auto* file = command->add_option("--replay", options->file, "Run one failure again");
  command
      ->add_option("--case", options->one,
                   "Run case FAMILY#N of this seed again; with -o it is written to DIR/one.case")
      ->excludes(file);
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
