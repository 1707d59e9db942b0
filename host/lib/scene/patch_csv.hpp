// Scenes as a table of patches.
#pragma once
#include <string>

#include "base/csv.hpp"
#include "scene/scene.hpp"

namespace host {

/// Reads `patch,polygon,rho_r,rho_g,rho_b,emit` (or emit_r,emit_g,emit_b); other columns are
/// ignored. Patches of one plane and one material become a surface, a grid where they tile one;
/// tables keep the file's order and labels. Throws Error that begins with "FILE:LINE: ".
Scene read_patch_csv(const std::string& path);

/// The same from a table already read.
Scene patch_csv_scene(const CsvTable& table);

}  // namespace host
