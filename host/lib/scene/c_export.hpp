// A scene and its light as C headers: what a renderer links.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scene/fixed_scene.hpp"

namespace host {

/// The scene as a C99 and C++17 header of static const arrays; `urad_NAME_scene` is the urad_scene.
/// `name` is a C identifier (Error otherwise; c_identifier makes one). `command` goes into the
/// banner. Same input, same bytes.
std::string scene_to_c(const FixedScene& scene, const std::string& name,
                       const std::string& command);

/// Radiosity of all patches, [patch][channel] in the scene's exitance unit, as
/// `urad_NAME_light[patches][3]`. Throws Error when there are not three integers per patch.
std::string light_to_c(const FixedScene& scene, const std::vector<std::int32_t>& radiosity,
                       const std::string& name, const std::string& command);

/// Flash of the exported scene on a 32-bit chip, with or without a repair factor per patch.
std::size_t scene_flash_bytes(const urad_scene& scene, bool scaled);

/// Letters, digits and underscores of the file name in `text`, without its extension; never empty,
/// never a digit first.
std::string c_identifier(const std::string& text);

/// `name` if it is a C identifier; throws Error otherwise.
const std::string& check_c_name(const std::string& name);

/// `text` such that it cannot end a C comment.
std::string c_comment(std::string text);

}  // namespace host
