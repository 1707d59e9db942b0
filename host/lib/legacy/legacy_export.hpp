// A network of the report as a C header: weights/legacy_NAME.h, C99 and C++17, nothing but
// integers.
#pragma once
#include <string>

#include "legacy/legacy_json.hpp"

namespace host {

/// The header that defines `static const urad_legacy_net urad_NAME`. digest: sha256 of the json.
/// The same bytes from every compiler, at any time, from any folder. Error unless name is a C
/// identifier.
std::string legacy_to_c(const LegacyNetFile& file, const std::string& name,
                        const std::string& digest);

/// The net's line of MANIFEST.csv.
std::string legacy_manifest_line(const LegacyNetFile& file, const std::string& name,
                                 const std::string& digest);

}  // namespace host
