#include "scene/obj.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "scene/obj_lines.hpp"

#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace host {
namespace {

struct LibraryMaterial {
  std::string file;
  MtlLines lines;
};
using Library = std::map<std::string, LibraryMaterial>;

/// The files that mtllib names: one, whose name may hold blanks, or several.
std::vector<std::pair<std::string, std::string>> texts_of(
    const std::string& names, const std::function<std::string(const std::string&)>& read) {
  try {
    return {{names, read(names)}};
  } catch (const Error&) {
    std::istringstream words(names);
    std::vector<std::pair<std::string, std::string>> texts;
    for (std::string name; words >> name;) {
      if (name == names) throw;  // a single one
      texts.emplace_back(name, read(name));
    }
    return texts;
  }
}

Library read_libraries(const ObjLines& obj, const std::string& file,
                       const std::function<std::string(const std::string&)>& read) {
  Library library;
  std::set<std::string> seen;  // joined files name theirs again
  for (const auto& [names, line] : obj.libraries) {
    std::vector<std::pair<std::string, std::string>> texts;
    try {
      texts = texts_of(names, read);
    } catch (const Error& error) {
      throw Error(fmt::format("{}:{}: mtllib: {}", file, line, error.what()));
    }
    for (const auto& [name, text] : texts) {
      if (!seen.insert(name).second) continue;
      for (const auto& [material, lines] : index_mtl(plain_lines(text), name)) {
        const auto [other, fresh] = library.emplace(material, LibraryMaterial{name, lines});
        if (!fresh)
          throw Error(fmt::format("{}:{}: material '{}' stands in {}:{} already", name, lines.line,
                                  material, other->second.file, other->second.lines.line));
      }
    }
  }
  return library;
}

Material checked_material(const std::string& name, const LibraryMaterial& from) {
  const auto& [file, lines] = from;
  if (lines.kd_line == 0)
    throw Error(fmt::format(
        "{}:{}: material '{}' has no Kd; give it a reflectance, 'Kd 0 0 0' for a black one", file,
        lines.line, name));
  for (int channel = 0; channel < 3; ++channel) {
    if (lines.kd[channel] < 0 || lines.kd[channel] > 1)
      throw Error(
          fmt::format("{}:{}: material '{}' reflects {} of the light; Kd must lie between 0 and 1",
                      file, lines.kd_line, name, lines.kd[channel]));
    if (!emission_in_range(lines.ke[channel]))
      throw Error(
          fmt::format("{}:{}: material '{}' emits {}; Ke must be 0, or between 1e-30 and 1e30",
                      file, lines.ke_line, name, lines.ke[channel]));
  }
  return {name, lines.kd, lines.ke};
}

// Its message ends in "line N.)": what stands there is no vertex number, or 0.
[[noreturn]] void rethrow(const std::string& message, const std::string& file) {
  std::smatch line;
  if (std::regex_search(message, line, std::regex("line ([0-9]+)")))
    throw Error(fmt::format(
        "{}:{}: this line names a vertex that is no number, or 0; vertices count from 1", file,
        line[1].str()));
  throw Error(fmt::format("{}: not an OBJ that can be read", file));
}

// tinyobjloader keeps the order of the faces through all shapes.
std::vector<Loop> loops_of(const tinyobj::ObjReader& reader, const ObjLines& lines,
                           const std::string& file) {
  const auto count_all = std::ptrdiff_t(lines.vertices.size());
  std::vector<Loop> loops;
  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    std::size_t first = 0;
    for (const std::size_t count : shape.mesh.num_face_vertices) {
      const std::size_t line =
          loops.size() < lines.faces.size() ? lines.faces[loops.size()].line : 0;
      Loop loop;
      for (std::size_t k = first; k < first + count; ++k) {
        const std::ptrdiff_t at = shape.mesh.indices[k].vertex_index;
        if (at < 0 || at >= count_all)
          throw Error(fmt::format("{}:{}: the face names vertex {}, but there are {}", file, line,
                                  at + 1, count_all));
        loop.push_back(lines.vertices[std::size_t(at)]);
      }
      loops.push_back(std::move(loop));
      first += count;
    }
  }
  if (loops.size() != lines.faces.size())
    throw Error(fmt::format("{}: {} f lines, but {} faces could be read", file, lines.faces.size(),
                            loops.size()));
  return loops;
}

}  // namespace

Scene parse_obj(const std::string& given, const std::string& name, const MeshOptions& options,
                const std::function<std::string(const std::string&)>& library_text) {
  const std::string text = plain_lines(given);
  const ObjLines lines = index_obj(text, name);
  const Library library = read_libraries(lines, name, library_text);
  std::vector<Material> materials;
  std::map<std::string, int> index;
  for (const auto& [material, line] : lines.material_uses) {
    const auto at = library.find(material);
    if (at == library.end())
      throw Error(fmt::format("{}:{}: usemtl names '{}', which no mtllib of this file has", name,
                              line, material));
    index.emplace(material, int(materials.size()));
    materials.push_back(checked_material(material, at->second));
  }
  tinyobj::ObjReaderConfig config;
  config.triangulate = false;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString(text, {}, config)) rethrow(reader.Error(), name);
  std::vector<Face> faces;
  for (Loop& loop : loops_of(reader, lines, name)) {
    const ObjFaceLine& at = lines.faces[faces.size()];
    faces.push_back({{std::move(loop), {}},
                     index.at(at.material),
                     at.counts,
                     fmt::format("{}:{}", name, at.line)});
  }
  Scene scene = mesh_faces(name, std::move(materials), faces, options).scene;
  if (lines.camera) scene.camera = *lines.camera;
  return scene;
}

Scene read_obj(const std::string& path, const MeshOptions& options) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return parse_obj(read_file(path), path, options,
                   [&](const std::string& name) { return read_file((folder / name).string()); });
}

}  // namespace host
