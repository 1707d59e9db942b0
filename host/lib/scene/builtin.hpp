// A scene by name or by file.
#pragma once
#include <string>
#include <vector>

#include "scene/mesh.hpp"

namespace host {

/// A file of host/scenes, part of the program.
struct EmbeddedFile {
  const char* name;
  const char* text;
};

/// All of them, sorted by name (written by host/scenes/embed.cmake).
std::vector<EmbeddedFile> embedded_files();

/// Names of the built-in scenes, sorted: cornell, cube7, gallery, louvre, room.
std::vector<std::string> builtin_scenes();

/// A built-in name, or a path that ends in .obj or .csv (a patch table; already cut, so that
/// options are refused). Scene.name is the built-in name or the path. Throws Error.
Scene load_scene(const std::string& name_or_path, const MeshOptions& options = {});

}  // namespace host
