// Every parser behind one function: bytes in, no opinion out.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace host {

struct FileTarget {
  std::string name;                ///< "obj", "mtl", "pairs-csv", "scenes-csv", "patch-csv", ...
  std::vector<std::string> seeds;  ///< good files, to be altered
  std::vector<std::string> words;  ///< what the format is made of
  /// Reads the text and what it leads to. Throws host::Error when it is no good; anything else that
  /// happens is a defect.
  std::function<void(const std::string&)> read;
};

const std::vector<FileTarget>& file_targets();

/// The one with this name. Throws UsageError.
const FileTarget& file_target(const std::string& name);

}  // namespace host
