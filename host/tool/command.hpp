// The sub-commands of `urad`: each adds itself, its options and what it does to the command line.
#pragma once
#include <CLI/CLI.hpp>

#include "method/nets.hpp"

namespace tool {

/// Options of every command.
struct Common {
  bool quiet = false;
  int threads = 0;
};

/// The networks that travel inside the program, by the name of their header.
const urad_net* shipped_net(const std::string& name);
/// Those of the report, by the name of their header without "legacy_".
const urad_legacy_net* shipped_legacy_net(const std::string& name);

void add_formfactor(CLI::App& app, const Common& common);
void add_solve(CLI::App& app, const Common& common);
void add_bake(CLI::App& app, const Common& common);
void add_plan(CLI::App& app, const Common& common);
void add_train(CLI::App& app, const Common& common);
void add_export(CLI::App& app, const Common& common);
void add_evaluate(CLI::App& app, const Common& common);
void add_accuracy(CLI::App& app, const Common& common);
void add_skipping(CLI::App& app, const Common& common);
void add_kernels(CLI::App& app, const Common& common);
void add_networks(CLI::App& app, const Common& common);
void add_reproduce(CLI::App& app, const Common& common);
void add_stress(CLI::App& app, const Common& common);

}  // namespace tool
