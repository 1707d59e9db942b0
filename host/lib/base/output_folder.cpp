#include "base/output_folder.hpp"

#include <fmt/format.h>

#include <system_error>

#include "base/error.hpp"

namespace host {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(const std::string& path) : path_(path) {
  std::error_code failure;
  for (fs::path folder = fs::absolute(path_).lexically_normal(); !fs::exists(folder, failure);
       folder = folder.parent_path())
    made_ = folder;
  fs::create_directories(path_, failure);
  if (failure) throw Error(fmt::format("{}: cannot make this folder: {}", path, failure.message()));
}

OutputFolder::~OutputFolder() {
  if (made_.empty()) return;
  std::error_code failure;  // a folder that holds something is not removed
  fs::path folder = fs::absolute(path_, failure).lexically_normal();
  while (fs::remove(folder, failure) && folder != made_) folder = folder.parent_path();
}

}  // namespace host
