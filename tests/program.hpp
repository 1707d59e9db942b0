// The program urad as a test starts it, and a place for what it writes.
#pragma once
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace test {

struct Outcome {
  int status = -1;
  std::string text;  // stdout and stderr
};

inline Outcome urad(const std::string& arguments) {
  const std::string command = std::string(URAD_PROGRAM) + " --quiet " + arguments + " 2>&1";
  // NOLINTNEXTLINE(cert-env33-c): the program is run as a person runs it, by a shell
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  Outcome outcome;
  std::array<char, 4096> block;
  for (std::size_t n; (n = fread(block.data(), 1, block.size(), pipe)) > 0;)
    outcome.text.append(block.data(), n);
  const int status = pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

/// Whether a shell runs it, and it succeeds.
inline bool runs(const std::string& command) {
  return std::system(command.c_str()) == 0;  // NOLINT(cert-env33-c): compilers, found as make does
}

/// A folder of its own for each test case, empty at the start.
inline std::filesystem::path scratch(const std::string& name) {
  std::filesystem::path folder = std::filesystem::path(URAD_SCRATCH_DIR) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace test
