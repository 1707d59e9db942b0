// urad skipping: what every skip saves in the standard scenes, as docs/SKIPPING.md.
#include <filesystem>
#include <memory>

#include "base/file.hpp"
#include "net_option.hpp"
#include "skipping/skip_report.hpp"

namespace tool {

namespace {

struct Options {
  std::vector<std::string> scenes{"cube7", "cornell", "room", "louvre", "gallery"};
  std::string instructions, out;
};

void run(const Options& options, const Common& common) {
  namespace fs = std::filesystem;
  const Nets nets("");
  std::vector<host::SkipReport> reports;
  for (const std::string& scene : options.scenes) {
    reports.push_back(
        host::skip_report(scene, nets.choice(), options.instructions, common.threads));
  }
  std::string command = "urad skipping";
  if (!options.instructions.empty()) command += " --instructions " + options.instructions;
  const fs::path chart = fs::path(options.out).replace_extension(".svg");
  host::write_file_atomically(chart.string(), host::skip_chart(reports));
  for (const host::SkipReport& report : reports) {
    const fs::path early =
        chart.parent_path() / (chart.stem().string() + "_" + report.scene + ".svg");
    host::write_file_atomically(early.string(), host::early_chart(report));
  }
  host::write_file_atomically(
      options.out,
      host::skip_document(reports, command + " -o " + options.out, chart.filename().string()));
}

}  // namespace

void add_skipping(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("skipping", "What every skip saves in the standard scenes: a document");
  command->add_option("--scenes", options->scenes, "Scenes")->delimiter(',')->capture_default_str();
  command->add_option("--instructions", options->instructions,
                      "Folder of SCENE.json and SCENE.sight.json, counted by ./run skipping");
  command->add_option("-o,--out", options->out, "Document to write; the chart goes beside it")
      ->required();
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
