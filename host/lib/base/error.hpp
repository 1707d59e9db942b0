// The one exception of the host programs: a sentence for the person at the keyboard.
#pragma once
#include <stdexcept>
#include <string>

namespace host {

/// Values are quoted as they were read: what would break the line or the terminal is written as an
/// escape, and of what is longer than any sentence the middle is left out.
inline std::string one_line(std::string text) {
  constexpr char kDigits[] = "0123456789abcdef";
  constexpr std::size_t kMost = 1000, kKept = 450;
  if (text.size() > kMost) text.replace(kKept, text.size() - 2 * kKept, " ... ");
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n')
      line += "\\n";
    else if (c == '\t')
      line += "\\t";
    else if (byte < 0x20 || byte == 0x7f)
      line += std::string("\\x") + kDigits[byte >> 4] + kDigits[byte & 15];
    else
      line += c;
  }
  return line;
}

/// Thrown for anything the user can mend. what() names the file, the line, the value and what would
/// do.
struct Error : std::runtime_error {
  explicit Error(const std::string& sentence) : std::runtime_error(one_line(sentence)) {}
};

/// The same for what was typed rather than what was read: a method or setting that does not exist.
struct UsageError : Error {
  using Error::Error;
};

}  // namespace host
