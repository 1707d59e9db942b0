// urad plan: what each method would cost on a chip, and which to take.
#include <fmt/format.h>

#include <memory>

#include "base/file.hpp"
#include "net_option.hpp"
#include "number_range.hpp"
#include "plan/plan.hpp"
#include "scene_option.hpp"

namespace tool {

namespace {

struct Options {
  SceneOption scene;
  std::string net, json;
  host::PlanRequest request;
};

void run(Options options, const Common& common) {
  const Nets nets(options.net);
  options.request.threads = common.threads;
  const host::Plan plan = host::make_plan(options.scene.load(), nets.choice(), options.request);
  if (!options.json.empty()) host::write_file_atomically(options.json, host::plan_json(plan));
  if (options.json != "-") fmt::print("{}", host::plan_text(plan));
}

}  // namespace

void add_plan(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "plan", "What each method costs on a chip, and which to take: before anything runs there");
  options->scene.add_to(command);
  command
      ->add_option("--ram", options->request.ram,
                   "Bytes of RAM for the solve, or 16K; left out: any")
      ->transform(CLI::AsSizeValue(false))
      ->check(between(std::size_t{1}, std::size_t{1} << 40));
  command->add_option("--flash", options->request.flash, "Bytes of flash, or 256K; left out: any")
      ->transform(CLI::AsSizeValue(false))
      ->check(between(std::size_t{1}, std::size_t{1} << 40));
  command
      ->add_option("--error", options->request.error,
                   "Relative rms error of B against the exact solution; 0.01 = 1 %")
      ->check(between(1e-6, 1.0))
      ->capture_default_str();
  command->add_flag("--visibility", options->request.visibility,
                    "Also with exported visibility (urad bake --visibility): some seconds");
  command->add_option("--net", options->net, "JSON of the network for net and hybrid");
  command->add_option("--json", options->json, "The plan as JSON (\"-\": to standard output)");
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
