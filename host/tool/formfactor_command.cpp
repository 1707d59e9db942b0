// urad formfactor: form factors of free polygon pairs, and of plates with blockers between them.
#include <memory>

#include "base/csv.hpp"
#include "base/file.hpp"
#include "command.hpp"
#include "method/pairs_table.hpp"
#include "net_option.hpp"
#include "number_range.hpp"

namespace tool {

namespace {

struct Options {
  std::string methods, in, scene, out, net;
  int subdivide = 1;
};

void run(const Options& options, const Common& common) {
  const auto file = [](const std::string& path) { return path == "-" ? "" : path; };
  host::expect_different_files({{"--in", file(options.in)},
                                {"--scene", file(options.scene)},
                                {"--net", options.net},
                                {"--out", options.out}});
  const Nets nets(options.net);
  const std::vector<host::MethodSpec> methods = host::parse_methods(options.methods);
  std::string table;
  if (!options.in.empty()) {
    table = host::pairs_table(host::read_csv(options.in, host::CsvRows::ragged), methods,
                              nets.choice(), common.threads, common.quiet);
  } else {
    if (methods.size() != 1)
      throw CLI::ValidationError("--method", "one method at a time with --scene");
    table = host::scenes_table(host::read_csv(options.scene, host::CsvRows::ragged), methods[0],
                               nets.choice(), options.subdivide, common.threads, common.quiet);
  }
  host::write_file_atomically(options.out, table);
}

}  // namespace

void add_formfactor(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("formfactor", "Form factors of polygon pairs, with or without blockers");
  command
      ->add_option(
          "--method", options->methods,
          "M[,M...]: reference, closed-form, lambert:N, gauss:N, contour:N, monte-carlo:SAMPLES, "
          "kernel, moment, fixed-kernel, fixed-moment, fixed-lambert:N, net[:NAME], auto[:ERROR], "
          "hemicube:R, legacy:NAME; with --scene also hybrid[:R], rays:N")
      ->required();
  auto* sources = command->add_option_group("input");
  sources->add_option(
      "--in", options->in,
      "CSV with columns id, p, q (\"-\": standard input). A polygon is \"x y z;x y z;x y z\", "
      "counter-clockwise from its lit side; holes follow behind |");
  auto* plates = sources->add_option("--scene", options->scene,
                                     "CSV with columns scene, role (P, Q or B), polygon");
  sources->require_option(1);
  command->add_option("--net", options->net, "JSON of the network for methods net and auto");
  command->add_option("--subdivide", options->subdivide, "Cut P into about N x N pieces (--scene)")
      ->check(between(1, 256))
      ->needs(plates);
  command->add_option("--out", options->out, "CSV to write (\"-\": standard output)")->required();
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
