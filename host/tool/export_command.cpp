// urad export: a trained network as a C header.
#include <filesystem>
#include <memory>

#include "base/file.hpp"
#include "command.hpp"
#include "legacy/legacy_export.hpp"
#include "network/digest.hpp"
#include "network/export.hpp"

namespace tool {

namespace {

struct Options {
  std::string net, out, manifest;
  int bits = 16;
};

void run(const Options& options) {
  host::expect_different_files({{"--out", options.out}, {"--manifest", options.manifest}});
  const std::string text = host::read_file(options.net);
  const std::string name = host::net_name(options.out), digest = host::sha256(text);
  const std::string old = options.manifest.empty() || !std::filesystem::exists(options.manifest)
                              ? ""
                              : host::read_file(options.manifest);
  std::string header, manifest;
  if (host::is_legacy_json(text)) {
    const host::LegacyNetFile file = host::legacy_from_json(text, options.net);
    header = host::legacy_to_c(file, name, digest);
    manifest = host::update_manifest(old, name, host::legacy_manifest_line(file, name, digest));
  } else {
    const host::NetFile file = host::net_from_json(text, options.net);
    header = host::net_to_c(file, name, options.bits, digest);
    manifest = host::update_manifest(old, file, name, options.bits, digest);
  }
  std::vector<host::OutputFile> files{{options.out, header}};
  if (!options.manifest.empty()) files.push_back({options.manifest, manifest});
  host::write_files_atomically(files);
}

}  // namespace

void add_export(CLI::App& app, const Common&) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("export", "Write a trained network as a C header (C99 and C++17)");
  command->add_option("net", options->net, "net.json, written by urad train or urad reproduce")
      ->required();
  command->add_option("--bits", options->bits, "Bits of the hidden weights")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str();
  command->add_option("-o,--out", options->out, "NAME.h to write; the network is urad_NAME")
      ->required();
  command->add_option("--manifest", options->manifest,
                      "CSV whose line for NAME is replaced or added");
  command->callback([options] { run(*options); });
}

}  // namespace tool
