#include "base/file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>

#include "base/error.hpp"

namespace host {
namespace {

std::string slurp(std::istream& in) {
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

std::string read_file(const std::string& path) {
  if (path == "-") return slurp(std::cin);
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
  // The process number keeps two runs that write the same file apart.
  const std::string beside = path + ".part" + std::to_string(::getpid());
  const auto fail = [&](const char* what) {
    const std::string why = std::strerror(errno);
    std::remove(beside.c_str());
    throw Error(path + ": cannot be " + what + " (" + why + ")");
  };
  {
    std::ofstream out(beside, std::ios::binary | std::ios::trunc);
    if (!out) fail("written");
    out.write(content.data(), size);
    out.close();
    if (!out) fail("written");
  }
  if (std::rename(beside.c_str(), path.c_str()) != 0) fail("replaced");
}

}  // namespace host
