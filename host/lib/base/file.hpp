// Whole files in and out. A failed run leaves no half-written file.
#pragma once
#include <string>
#include <string_view>

namespace host {

/// The bytes of a file; "-" reads standard input. Throws Error when it cannot be read.
std::string read_file(const std::string& path);

/// Writes beside `path`, then renames, so that readers see the old bytes or the new ones. "-"
/// writes to standard output. Throws Error (and removes what it wrote) when the disk refuses.
void write_file_atomically(const std::string& path, std::string_view content);

}  // namespace host
