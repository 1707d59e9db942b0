// A network as a C header: weights/NAME.h, C99 and C++17, nothing but integers.
#pragma once
#include <string>

#include "network/net_json.hpp"

namespace host {

/// The header that defines `static const urad_net urad_NAME`. digest: sha256 of the net.json.
/// Prints integers and what the file says of itself only: the same bytes from every compiler, at
/// any time, from any folder. Error unless bits is 8 or 16 and name is a C identifier of letters,
/// digits and underscores.
std::string net_to_c(const NetFile& file, const std::string& name, int bits,
                     const std::string& digest);

/// "weights/cube7_h4.h" -> "cube7_h4"; Error when that is not a C identifier.
std::string net_name(const std::string& header_path);

/// MANIFEST.csv with the line of this net replaced or added, ordered by name. `old`: the file so
/// far, or empty.
std::string update_manifest(const std::string& old, const std::string& name,
                            const std::string& line);
std::string update_manifest(const std::string& old, const NetFile& file, const std::string& name,
                            int bits, const std::string& digest);

}  // namespace host
