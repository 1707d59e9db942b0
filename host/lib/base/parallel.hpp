// A loop over all cores.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace host {

/// Cores to use when the user asks for `threads`; 0 or less means all of them.
inline std::size_t thread_count(int threads) {
  if (threads > 0) return static_cast<std::size_t>(threads);
  return std::max(1U, std::thread::hardware_concurrency());
}

/// Calls fn(index) once for each index in [0, n), in any order, on `threads` threads (0: all
/// cores). Results do not depend on the number of threads as long as fn writes only what belongs to
/// its index. The first exception stops the loop and is thrown again here.
template <class Function>
void parallel_for(std::size_t n, int threads, Function&& fn) {
  const std::size_t workers = std::min(thread_count(threads), n);
  if (workers <= 1) {
    for (std::size_t i = 0; i < n; ++i) fn(i);
    return;
  }
  // Small runs keep cores busy to the end, runs of more than one index keep them off each other's
  // cache lines.
  const std::size_t run = std::clamp<std::size_t>(n / (workers * 16), 1, 256);
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_lock;
  const auto work = [&] {
    try {
      for (std::size_t first = next.fetch_add(run); first < n; first = next.fetch_add(run))
        for (std::size_t i = first; i < std::min(first + run, n); ++i) fn(i);
    } catch (...) {
      const std::lock_guard<std::mutex> guard(failure_lock);
      if (!failure) failure = std::current_exception();
      next = n;
    }
  };
  std::vector<std::thread> pool;
  for (std::size_t i = 1; i < workers; ++i) pool.emplace_back(work);
  work();
  for (std::thread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace host
