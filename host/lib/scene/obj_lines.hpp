// Where things stand in an OBJ or MTL file: the lines that a message must name, and the comments
// that urad reads.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"

namespace host {

struct ObjFaceLine {
  std::size_t line = 0;
  std::string material;             ///< of the usemtl before it
  std::array<int, 2> counts{1, 1};  ///< of the `# grid U V` before it
};

/// What an OBJ file says, in its order. Which vertices a face has is tinyobjloader's to say.
struct ObjLines {
  std::vector<Vec3> vertices;      ///< to the last bit; tinyobjloader's are a few off
  std::vector<ObjFaceLine> faces;  ///< one per f line
  std::vector<std::pair<std::string, std::size_t>> libraries;      ///< mtllib: file, line
  std::vector<std::pair<std::string, std::size_t>> material_uses;  ///< usemtl: name, first line
  std::optional<Camera>
      camera;  ///< `# camera eye x y z target x y z up x y z fov degrees [mirrored]`
};

struct MtlLines {
  std::size_t line = 0;                  ///< of newmtl
  std::size_t kd_line = 0, ke_line = 0;  ///< 0: none
  Vec3 kd{0}, ke{0};
};

/// The same lines in plain form, every statement on the line on which it begins: no UTF-8 mark, no
/// carriage returns, no comments behind a statement, and what `\` continues in one line (blank ones
/// follow, so that the numbers stay). A comment on its own line is kept, and never continued.
std::string plain_lines(std::string_view text);

/// Both take plain lines. Throws Error: a vertex that is not three finite numbers, a face of fewer
/// than 3 vertices or before any usemtl, a malformed camera or grid comment, no vertex or no face
/// at all (what a file of another kind looks like).
ObjLines index_obj(std::string_view text, const std::string& file);

/// By material name. Throws Error: Kd or Ke that are not three finite numbers, a name twice, Kd or
/// Ke before newmtl.
std::map<std::string, MtlLines> index_mtl(std::string_view text, const std::string& file);

}  // namespace host
