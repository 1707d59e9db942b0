// Time that other work on the machine does not change.
#pragma once
#include <ctime>

namespace host {

/// Processor time of the calling thread since its construction.
class Stopwatch {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  }
  double start_ = now();
};

}  // namespace host
