// A folder to write into.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace host {

/// Made, with its parents, before the work begins, so that a name that cannot be one is known at
/// once; gone again with this object if nothing was written into it.
class OutputFolder {
 public:
  /// Throws Error when the disk refuses.
  explicit OutputFolder(const std::string& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::string file(std::string_view name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
  std::filesystem::path made_;  ///< the highest folder that did not exist
};

}  // namespace host
