#include "base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "base/remark.hpp"

namespace host {

Progress::Progress(std::string what, std::size_t total, bool quiet)
    : what_(std::move(what)),
      total_(std::max<std::size_t>(total, 1)),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO)) {}

Progress::~Progress() {
  if (!quiet_ && terminal_ && shown_ > 0) remark("\r\033[K");
}

void Progress::add(std::size_t steps) {
  const std::size_t done = done_.fetch_add(steps) + steps;
  if (!quiet_) show(std::min(done, total_));
}

double Progress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Progress::show(std::size_t done) {
  const std::size_t parts = terminal_ ? 100 : 10, part = done * parts / total_;
  const std::lock_guard<std::mutex> guard(output_);
  if (part <= shown_) return;
  shown_ = part;
  const double left = seconds() * double(total_ - done) / double(done);
  if (terminal_) {
    const std::string bar(part * 30 / 100, '#');
    remark(fmt::format("\r{} [{:<30}] {:3} %  {:.0f} s left\033[K", what_, bar, part, left));
    (void)std::fflush(stderr);  // a bar that is not seen harms nobody
  } else {
    remark(fmt::format("{}: {} %, {:.0f} s left\n", what_, part * 10, left));
  }
}

}  // namespace host
