// urad kernels: what was tried instead of the engine's ways to a factor, as docs/KERNELS.md.
#include <fmt/format.h>

#include <memory>

#include "accuracy/kernel_document.hpp"
#include "base/file.hpp"
#include "command.hpp"
#include "net_option.hpp"
#include "number_range.hpp"

namespace tool {

namespace {

struct Options {
  host::KernelTrialRequest request;
  std::string out;
};

void run(Options& options, const Common& common) {
  const Nets nets("");
  host::KernelTrialRequest& request = options.request;
  request.net = nets.choice().general();
  request.threads = common.threads;
  const std::string command =
      fmt::format("urad kernels --effort {} -o {}", request.effort, options.out);
  host::write_file_atomically(options.out,
                              host::kernel_document(host::try_kernels(request), command));
}

}  // namespace

void add_kernels(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "kernels", "Kernels, inputs and guesses that were tried beside the engine's, and their cost");
  command->add_option("--effort", options->request.effort, "Share of pairs and steps")
      ->check(between(0.01, 1.0))
      ->capture_default_str();
  command->add_option("-o,--out", options->out, "Document to write")->required();
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
