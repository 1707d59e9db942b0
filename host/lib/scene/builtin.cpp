#include "scene/builtin.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/error.hpp"
#include "scene/obj.hpp"
#include "scene/patch_csv.hpp"

namespace host {
namespace {

const char* embedded(const std::string& name) {
  for (const EmbeddedFile& file : embedded_files())
    if (file.name == name) return file.text;
  return nullptr;
}

std::string extension(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

}  // namespace

std::vector<std::string> builtin_scenes() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : embedded_files())
    if (extension(file.name) == ".obj")
      names.push_back(std::filesystem::path(file.name).stem().string());
  return names;
}

Scene load_scene(const std::string& name_or_path, const MeshOptions& options) {
  if (const char* text = embedded(name_or_path + ".obj")) {
    Scene scene = parse_obj(text, name_or_path + ".obj", options, [](const std::string& name) {
      const char* library = embedded(name);
      if (!library) throw Error(name + " is not built in");
      return std::string(library);
    });
    scene.name = name_or_path;
    return scene;
  }
  if (extension(name_or_path) == ".obj") return read_obj(name_or_path, options);
  if (extension(name_or_path) == ".csv") {
    if (options.subdivide != 0 || options.patch_size != 0)
      throw Error(name_or_path +
                  ": a patch table is cut already; --subdivide and --patch-size are for OBJ files");
    return read_patch_csv(name_or_path);
  }
  throw Error(
      fmt::format("'{}' is neither a built-in scene ({}) nor a file that ends in .obj or .csv",
                  name_or_path, fmt::join(builtin_scenes(), ", ")));
}

}  // namespace host
