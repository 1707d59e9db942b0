// SCENE and how to cut it: the same for every command that takes a scene.
#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "command.hpp"
#include "number_range.hpp"
#include "scene/builtin.hpp"

namespace tool {

/// --subdivide or --patch-size.
inline void add_mesh_options(CLI::App* command, host::MeshOptions* mesh) {
  auto* subdivide =
      command->add_option("--subdivide", mesh->subdivide, "Cut every face into N x N patches")
          ->check(between(1, 255));
  command->add_option("--patch-size", mesh->patch_size, "Longest patch edge, in the file's unit")
      ->check(positive())
      ->excludes(subdivide);
}

struct SceneOption {
  std::string name;
  host::MeshOptions mesh;

  void add_to(CLI::App* command) {
    command
        ->add_option("SCENE,--scene", name,
                     fmt::format("An OBJ with its MTL, a patch CSV, or a built-in name: {}",
                                 fmt::join(host::builtin_scenes(), ", ")))
        ->required();
    add_mesh_options(command, &mesh);
  }
  host::Scene load() const { return host::load_scene(name, mesh); }
};

}  // namespace tool
