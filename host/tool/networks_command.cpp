// urad networks: general networks by width and seed, as docs/NETWORKS.md.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "accuracy/network_trials.hpp"
#include "base/file.hpp"
#include "base/remark.hpp"
#include "command.hpp"
#include "net_option.hpp"
#include "number_range.hpp"

namespace tool {

namespace {

struct Options {
  host::NetworkRequest request;
  std::string out;
};

void run(Options& options, const Common& common) {
  const Nets nets("");
  host::NetworkRequest& request = options.request;
  request.nets = nets.choice();
  request.threads = common.threads;
  if (!common.quiet)
    request.progress = [](int hidden, std::uint64_t seed) {
      host::remark(fmt::format("{} hidden neurons, seed {}\n", hidden, seed));
    };
  const auto trials = host::try_networks(request);
  const std::string command =
      fmt::format("urad networks --hidden {} --seeds {} --effort {} --pairs {} --trials {} -o {}",
                  fmt::join(request.hidden, ","), fmt::join(request.seeds, ","), request.effort,
                  request.pairs, request.trials, options.out);
  host::TrainingTrialRequest ways;
  ways.effort = request.effort;
  ways.threads = request.threads;
  host::write_file_atomically(
      options.out,
      host::network_document(trials, host::try_fronts(request, trials), host::try_optimisers(ways),
                             host::try_inputs(ways), command));
}

}  // namespace

void add_networks(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  host::NetworkRequest& request = options->request;
  request.seeds = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  CLI::App* command = app.add_subcommand(
      "networks", "General networks by width and seed: errors, what integers cost, fronts");
  command->add_option("--hidden", request.hidden, "Widths")
      ->delimiter(',')
      ->check(between(1, 32))
      ->capture_default_str();
  command->add_option("--seeds", request.seeds, "Seeds")->delimiter(',')->capture_default_str();
  command->add_option("--effort", request.effort, "Share of a training's usual pairs and steps")
      ->check(between(0.01, 1.0))
      ->capture_default_str();
  command->add_option("--pairs", request.pairs, "Random pairs of a family to judge by")
      ->check(between(10, 100000))
      ->capture_default_str();
  command->add_option("--trials", request.trials, "Test pairs of a family for the fronts")
      ->check(between(10, 100000))
      ->capture_default_str();
  command->add_option("-o,--out", options->out, "Document to write")->required();
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
