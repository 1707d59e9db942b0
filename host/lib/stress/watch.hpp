// The case that a thread is at, for the time when it does not come back.
#pragma once
#include <pthread.h>

#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace host {

/// Processor time of this thread.
double thread_seconds();

/// While it lives, a signal that ends the program writes the case of its thread first, and a case
/// that takes more than `most_seconds` of its thread's time (not the clock's: machines are shared) is
/// written and ends the program with status 1. To
/// `folder`/crash.case or hang.case; an empty folder: nothing is written.
class CaseWatch {
 public:
  CaseWatch(const std::string& folder, double most_seconds, std::size_t threads);
  ~CaseWatch();
  CaseWatch(const CaseWatch&) = delete;
  CaseWatch& operator=(const CaseWatch&) = delete;

  /// This thread begins with a case; the text stays where it is until the next call or end().
  void begin(std::size_t thread, const std::string& text);
  void end(std::size_t thread);

 private:
  struct Slot {
    const std::string* text = nullptr;
    pthread_t thread{};
    double start = 0;
  };
  void watch(double most_seconds);
  void report_hang(const std::string& text, double most_seconds) const;

  std::string folder_;
  std::vector<Slot> slots_;
  std::mutex lock_;
  bool stop_ = false;
  std::thread watcher_;
};

}  // namespace host
