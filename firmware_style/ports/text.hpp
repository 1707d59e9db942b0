// text.hpp -- integers as text, in and out of files, through a small buffer on the stack.
#pragma once
#include "port.hpp"

namespace port {

/// Collects text and hands it to a file in pieces. failed() tells in the end whether all of it went out.
class Writer {
 public:
  explicit Writer(int file) : file_(file) {}

  Writer& text(const char* s) {
    while (*s) put(*s++);
    return *this;
  }

  /// |value| < 2^32.
  Writer& integer(int64_t value) {
    char digits[10];
    int n = 0;
    uint32_t rest = uint32_t(value < 0 ? -value : value);
    do digits[n++] = char('0' + rest % 10);
    while (rest /= 10);
    if (value < 0) put('-');
    while (n) put(digits[--n]);
    return *this;
  }

  void flush() {
    if (used_ && !write(file_, buffer_, used_)) failed_ = true;
    used_ = 0;
  }

  bool failed() const { return failed_; }

 private:
  void put(char c) {
    if (used_ == int(sizeof buffer_)) flush();
    buffer_[used_++] = c;
  }

  int file_;
  int used_ = 0;
  bool failed_ = false;
  char buffer_[64];
};

/// Reads integers that stand between blanks and line ends.
class Reader {
 public:
  explicit Reader(int file) : file_(file) {}

  /// The next integer; false at the end of the file or at anything that is no integer of 32 bits.
  bool integer(int32_t* value) {
    int c = get();
    while (c == ' ' || c == '\n' || c == '\r') c = get();
    const bool negative = c == '-';
    if (negative) c = get();
    if (c < '0' || c > '9') return false;
    int64_t sum = 0;
    for (; c >= '0' && c <= '9'; c = get()) {
      sum = sum * 10 + (c - '0');
      if (sum > INT32_MAX) return false;
    }
    *value = int32_t(negative ? -sum : sum);
    return true;
  }

 private:
  int get() {
    if (at_ == used_) {
      at_ = 0;
      used_ = read(file_, buffer_, int(sizeof buffer_));
      if (used_ <= 0) return used_ = 0, -1;
    }
    return buffer_[at_++];
  }

  int file_;
  int at_ = 0, used_ = 0;
  char buffer_[64];
};

}  // namespace port
