#include "stress/case_file.hpp"

#include "base/error.hpp"

namespace host {
namespace {

constexpr std::string_view kFormat = "urad-stress 1";

/// The next line after `word` and a blank.
bool take_line(std::string_view* text, std::string_view word, std::string* value) {
  const std::size_t end = text->find('\n');
  if (end == text->npos || !text->starts_with(word)) return false;
  *value = std::string(text->substr(word.size(), end - word.size()));
  text->remove_prefix(end + 1);
  return true;
}

}  // namespace

std::string to_text(const StressCase& c) {
  return std::string(kFormat) + "\nkind " + c.kind + "\nfamily " + c.family + "\n" + c.input;
}

StressCase case_from_text(std::string_view text, const std::string& where) {
  StressCase c;
  std::string rest;
  if (!take_line(&text, kFormat, &rest) || !take_line(&text, "kind ", &c.kind) ||
      !take_line(&text, "family ", &c.family))
    throw Error(where + ": not a case of urad stress; those begin with '" + std::string(kFormat) +
                "', 'kind K', 'family F'");
  c.input = std::string(text);
  return c;
}

}  // namespace host
