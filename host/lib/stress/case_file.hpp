// One case of an attack as a file, so that a failure can be run again.
#pragma once
#include <string>
#include <string_view>

namespace host {

/// Three lines of text, then the bytes of the input to the end of the file.
struct StressCase {
  std::string kind, family, input;
};

/// The file's bytes.
std::string to_text(const StressCase& stress_case);

/// Throws Error, which begins with `where`, when the text is none of ours.
StressCase case_from_text(std::string_view text, const std::string& where);

}  // namespace host
