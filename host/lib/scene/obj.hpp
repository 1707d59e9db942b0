// Scenes from Wavefront OBJ and MTL: Kd is the reflectance, Ke the emitted exitance.
#pragma once
#include <functional>
#include <string>

#include "scene/mesh.hpp"

namespace host {

/// Reads a scene. Faces are planar polygons, counter-clockwise seen from their lit side; the other
/// side is black. Two comments speak to urad: `# grid U V` cuts the faces after it U times along
/// their first edge and V times along their last (triangles: by the larger), and `# camera eye x y
/// z target x y z up x y z fov degrees [mirrored]`. Throws Error, one sentence that begins with
/// "FILE:LINE: ", for anything it cannot make a scene of.
Scene read_obj(const std::string& path, const MeshOptions& options);

/// The same from text. `name` stands for the file in messages and names the scene; `library` gives
/// the text of an MTL file by the name that the OBJ calls it.
Scene parse_obj(const std::string& text, const std::string& name, const MeshOptions& options,
                const std::function<std::string(const std::string&)>& library);

}  // namespace host
