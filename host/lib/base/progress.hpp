// How far a long computation is, on stderr.
#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace host {

/// A bar with an estimate of what is left when stderr is a terminal, else one line per 10 %;
/// nothing when quiet. add() may be called from several threads.
class Progress {
 public:
  Progress(std::string what, std::size_t total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void add(std::size_t steps = 1);

 private:
  void show(std::size_t done);
  double seconds() const;

  std::string what_;
  std::size_t total_;
  bool quiet_, terminal_;
  std::atomic<std::size_t> done_{0};
  std::size_t shown_ = 0;  // in steps of 1 % (terminal) or 10 %
  std::mutex output_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace host
