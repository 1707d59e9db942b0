#include "base/file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "base/error.hpp"

namespace host {
namespace {

namespace fs = std::filesystem;

std::string slurp(std::istream& in) {
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

std::string read_file(const std::string& path) {
  if (path == "-") return slurp(std::cin);
  if (fs::is_directory(path)) throw Error(path + ": cannot be read (it is a folder)");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path + ": cannot be read (" + std::strerror(errno) + ")");
  std::string content = slurp(in);
  if (in.bad()) throw Error(path + ": reading stopped half-way");
  return content;
}

void write_file_atomically(const std::string& path, std::string_view content) {
  const auto size = static_cast<std::streamsize>(content.size());
  if (path == "-") {
    if (!std::cout.write(content.data(), size).flush()) throw Error("standard output is closed");
    return;
  }
  const auto fail = [&](const std::string& beside, const char* what) {
    const std::string why = std::strerror(errno);
    if (!beside.empty()) std::remove(beside.c_str());
    throw Error(path + ": cannot be " + what + " (" + why + ")");
  };
  const auto write = [&](const std::string& to, const std::string& beside) {
    std::ofstream out(to, std::ios::binary | std::ios::trunc);
    if (!out) fail(beside, "written");
    out.write(content.data(), size);
    out.close();
    if (!out) fail(beside, "written");
  };
  // A link is followed to what it names; devices and pipes have no name to swap and are written as
  // they are.
  std::error_code none;
  const fs::path real = fs::exists(path, none) ? fs::canonical(path, none) : fs::path(path);
  if (fs::exists(real, none) && !fs::is_regular_file(real, none)) return write(real.string(), "");
  // The process number keeps two runs that write the same file apart.
  const std::string beside = real.string() + ".part" + std::to_string(::getpid());
  write(beside, beside);
  if (std::rename(beside.c_str(), real.c_str()) != 0) fail(beside, "replaced");
}

}  // namespace host
