#include "base/file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>

#include "base/error.hpp"

namespace host {
namespace {

namespace fs = std::filesystem;

std::string slurp(std::istream& in) {
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool same_file(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return a == b;
  std::error_code none;
  return fs::equivalent(a, b, none) || fs::weakly_canonical(fs::absolute(a, none), none) ==
                                           fs::weakly_canonical(fs::absolute(b, none), none);
}

/// Writes one file beside its place, and puts it there when all others are written, too.
class Replacement {
 public:
  Replacement(std::string path, std::string_view content)
      : path_(std::move(path)), content_(content) {
    if (path_ == "-") return;
    // A link is followed to what it names; devices and pipes have no name to swap and are written
    // as they are.
    std::error_code none;
    real_ = (fs::exists(path_, none) ? fs::canonical(path_, none) : fs::path(path_)).string();
    if (fs::is_directory(real_, none)) throw Error(path_ + ": cannot be written (it is a folder)");
    if (fs::exists(real_, none) && !fs::is_regular_file(real_, none)) return;
    // The process number keeps two runs that write the same file apart.
    beside_ = real_ + ".part" + std::to_string(::getpid());
    try {
      write(beside_);
    } catch (...) {
      fs::remove(beside_, none);
      throw;
    }
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  ~Replacement() {
    std::error_code none;
    if (!beside_.empty()) fs::remove(beside_, none);
  }

  bool has_name() const { return !beside_.empty(); }
  void stream() const {
    if (path_ != "-") return write(real_);
    if (!std::cout.write(content_.data(), size()).flush()) throw Error("standard output is closed");
  }
  void rename() {
    if (std::rename(beside_.c_str(), real_.c_str()) != 0) fail("replaced");
    beside_.clear();
  }

 private:
  std::streamsize size() const { return static_cast<std::streamsize>(content_.size()); }
  [[noreturn]] void fail(const char* what) const {
    throw Error(path_ + ": cannot be " + what + " (" + std::strerror(errno) + ")");
  }
  void write(const std::string& to) const {
    std::ofstream out(to, std::ios::binary | std::ios::trunc);
    if (out) {
      out.write(content_.data(), size());
      out.close();
    }
    if (!out) fail("written");
  }

  std::string path_, real_, beside_;  // beside_ is empty for what has no name to swap
  std::string_view content_;
};

}  // namespace

std::string read_file(const std::string& path) {
  if (path == "-") return slurp(std::cin);
  std::error_code none;
  if (fs::is_directory(path, none)) throw Error(path + ": cannot be read (it is a folder)");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path + ": cannot be read (" + std::strerror(errno) + ")");
  std::string content = slurp(in);
  if (in.bad()) throw Error(path + ": reading stopped half-way");
  return content;
}

void expect_different_files(const std::vector<NamedPath>& paths) {
  for (std::size_t k = 0; k < paths.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      if (!paths[k].path.empty() && !paths[j].path.empty() &&
          same_file(paths[k].path, paths[j].path))
        throw UsageError(paths[j].option + " and " + paths[k].option + " both name " +
                         paths[k].path + "; give each a file of its own");
}

void write_files_atomically(const std::vector<OutputFile>& files) {
  std::vector<std::unique_ptr<Replacement>> written;
  written.reserve(files.size());
  for (const OutputFile& file : files)
    written.push_back(std::make_unique<Replacement>(file.path, file.content));
  for (const auto& file : written)
    if (!file->has_name()) file->stream();
  for (const auto& file : written)
    if (file->has_name()) file->rename();
}

void write_file_atomically(const std::string& path, std::string_view content) {
  write_files_atomically({{path, std::string(content)}});
}

}  // namespace host
