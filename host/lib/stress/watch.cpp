#include "stress/watch.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace host {
namespace {

constexpr std::array kSignals = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

// What a signal handler may touch: pointers set before it can run.
thread_local const std::string* t_case = nullptr;
const char* g_crash_path = nullptr;

/// System calls only.
void write_case(const char* path, const std::string& text) {
  const int file = ::open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0) return;
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::write(file, text.data() + at, text.size() - at);
    if (written <= 0) break;
    at += std::size_t(written);
  }
  ::close(file);
}

void on_signal(int number) {
  if (t_case && g_crash_path) write_case(g_crash_path, *t_case);
  (void)std::signal(number, SIG_DFL);  // where these fail, too, the program goes on to its end
  (void)std::raise(number);
}

double seconds_of(clockid_t clock) {
  timespec now{};
  return clock_gettime(clock, &now) == 0 ? double(now.tv_sec) + 1e-9 * double(now.tv_nsec) : 0;
}

// Sanitizers have handlers that say more.
#ifdef URAD_SANITIZED
constexpr bool kOwnHandlers = false;
#else
constexpr bool kOwnHandlers = true;
#endif

void handle_signals(void (*handler)(int)) {
  if (!kOwnHandlers) return;
  for (const int number : kSignals) (void)std::signal(number, handler);
}

}  // namespace

double thread_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

CaseWatch::CaseWatch(const std::string& folder, double most_seconds, std::size_t threads)
    : folder_(folder.empty() ? "" : folder + "/crash.case"), slots_(threads) {
  g_crash_path = folder_.empty() ? nullptr : folder_.c_str();
  handle_signals(on_signal);
  watcher_ = std::thread([this, most_seconds] { watch(most_seconds); });
}

CaseWatch::~CaseWatch() {
  {
    const std::lock_guard<std::mutex> guard(lock_);
    stop_ = true;
  }
  watcher_.join();
  handle_signals(SIG_DFL);
  g_crash_path = nullptr;
}

void CaseWatch::begin(std::size_t thread, const std::string& text) {
  const std::lock_guard<std::mutex> guard(lock_);
  slots_[thread] = {&text, pthread_self(), thread_seconds()};
  t_case = &text;
}

void CaseWatch::end(std::size_t thread) {
  const std::lock_guard<std::mutex> guard(lock_);
  slots_[thread].text = nullptr;
  t_case = nullptr;
}

void CaseWatch::watch(double most_seconds) {
  for (;;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::lock_guard<std::mutex> guard(lock_);
    if (stop_) return;
    for (const Slot& slot : slots_) {
      clockid_t clock{};
      if (!slot.text || pthread_getcpuclockid(slot.thread, &clock) != 0) continue;
      if (seconds_of(clock) - slot.start > most_seconds) report_hang(*slot.text, most_seconds);
    }
  }
}

void CaseWatch::report_hang(const std::string& text, double most_seconds) const {
  constexpr std::size_t kName = std::string_view("crash.case").size();
  const std::string path =
      folder_.empty() ? "" : folder_.substr(0, folder_.size() - kName) + "hang.case";
  if (!path.empty()) write_case(path.c_str(), text);
  (void)std::fprintf(stderr, "urad: stress: a case did not end within %.0f s%s%s\n", most_seconds,
                     path.empty() ? "" : "; urad stress --replay ", path.c_str());
  std::_Exit(1);
}

}  // namespace host
