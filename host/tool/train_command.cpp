// urad train: a network for one scene, or a general one, as net.json.
#include <memory>

#include "base/file.hpp"
#include "base/progress.hpp"
#include "command.hpp"
#include "network/train_net.hpp"
#include "number_range.hpp"
#include "scene_option.hpp"

namespace tool {

namespace {

constexpr int kSceneHidden = 4, kGeneralHidden = 8;
constexpr std::size_t kProgressSteps = 1000;

struct Options {
  std::string scene, out;
  host::MeshOptions mesh;
  bool general = false;
  int hidden = 0;
  std::uint64_t seed = 1;
};

// The command as someone else would type it; the output's name does not matter to the net.
std::string command_line(const Options& options, int hidden) {
  std::string line = "urad train ";
  line += options.general ? "--general" : "--scene " + options.scene;
  if (options.mesh.subdivide > 0) line += " --subdivide " + std::to_string(options.mesh.subdivide);
  if (options.mesh.patch_size > 0)
    line += " --patch-size " + CLI::detail::to_string(options.mesh.patch_size);
  return line + " --hidden " + std::to_string(hidden) + " --seed " + std::to_string(options.seed);
}

void run(const Options& options, const Common& common) {
  host::TrainRequest request;
  request.hidden = options.hidden > 0 ? options.hidden
                   : options.general  ? kGeneralHidden
                                      : kSceneHidden;
  request.seed = options.seed;
  request.threads = common.threads;
  request.command = command_line(options, request.hidden);
  request.checkpoint = options.out + ".partial";
  host::Progress progress("training", kProgressSteps, common.quiet);
  std::size_t shown = 0;
  request.progress = [&](double done) {
    const auto steps = std::size_t(done * double(kProgressSteps));
    if (steps > shown) progress.add(steps - shown), shown = steps;
  };
  const auto file = options.general ? host::train_general_net(request)
                                    : host::train_scene_net(
                                          host::load_scene(options.scene, options.mesh), request);
  if (file) host::write_file_atomically(options.out, host::to_json(*file));
}

}  // namespace

void add_train(CLI::App& app, const Common& common) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "train", "Train a network; a run that was interrupted goes on where it was");
  auto* subject = command->add_option_group("subject");
  subject->add_flag("--general", options->general, "For any scene, from random pairs");
  subject->add_option("--scene", options->scene,
                      "For this scene: a built-in name, an OBJ or a patch CSV");
  subject->require_option(1);
  add_mesh_options(command, &options->mesh);
  command
      ->add_option("--hidden", options->hidden,
                   "Hidden neurons; default 4 for a scene, 8 for general")
      ->check(between(1, URAD_NET_MAX_HIDDEN));
  command->add_option("--seed", options->seed, "Start values, held-out pairs, random pairs")
      ->capture_default_str();
  command->add_option("-o,--out", options->out, "net.json to write")->required();
  command->callback([options, &common] { run(*options, common); });
}

}  // namespace tool
