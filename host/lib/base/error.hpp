// The one exception of the host programs: a sentence for the person at the keyboard.
#pragma once
#include <stdexcept>

namespace host {

/// Thrown for anything the user can mend. what() names the file, the line, the value and what would
/// do.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The same for what was typed rather than what was read: a method or setting that does not exist.
struct UsageError : Error {
  using Error::Error;
};

}  // namespace host
