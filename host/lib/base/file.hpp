// Whole files in and out. A failed run leaves no half-written file.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace host {

/// The bytes of a file; "-" reads standard input. Throws Error when it cannot be read.
std::string read_file(const std::string& path);

/// Writes beside `path`, then renames, so that readers see the old bytes or the new ones. "-"
/// writes to standard output. Throws Error (and removes what it wrote) when the disk refuses.
void write_file_atomically(const std::string& path, std::string_view content);

struct OutputFile {
  std::string path, content;
};

/// The same for the files of one run, which appear together: none is renamed before all are
/// written.
void write_files_atomically(const std::vector<OutputFile>& files);

struct NamedPath {
  std::string option, path;  ///< such as "--out"; an empty path is an output nobody asked for
};

/// Throws UsageError when two outputs are one file, under whatever names. To be asked before the
/// work begins.
void expect_different_files(const std::vector<NamedPath>& paths);

}  // namespace host
