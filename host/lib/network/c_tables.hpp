// Pieces of exported C headers.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/error.hpp"

namespace host {

/// Throws Error unless `name` is a C identifier of letters, digits and underscores.
inline void check_c_name(const std::string& name) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const bool good =
      !name.empty() && letter(name[0]) &&
      std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || digit(c); });
  if (!good)
    throw Error(fmt::format(
        "\"{}\" cannot name a network in C: use letters, digits and underscores, no digit first",
        name));
}

/// Inside /* */: what a file says of itself must not end the comment.
inline std::string c_comment(std::string text) {
  for (std::size_t at = text.find("*/"); at != std::string::npos; at = text.find("*/"))
    text.replace(at, 2, "* /");
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return text;
}

/// Values in lines of at most 100 columns.
template <class Values>
std::string c_list(const Values& values) {
  std::string text, line = "   ";
  for (const auto& value : values) {
    const std::string item = fmt::format(" {},", value);
    if (line.size() + item.size() > 100) text += line + "\n", line = "   ";
    line += item;
  }
  return text + line + "\n";
}

/// static const TYPE SYMBOL_FIELD[n] = {...};
template <class Values>
std::string c_table(const char* type, const std::string& symbol, const char* field,
                    const Values& values) {
  return fmt::format("static const {} {}_{}[{}] = {{\n{}}};\n", type, symbol, field, values.size(),
                     c_list(values));
}

/// Include guard, include and ABI check at the top of a header; the caller ends it with #endif.
inline std::string c_guard(const std::string& name, const char* header, const char* abi_macro,
                           int abi) {
  std::string guard = "URAD_WEIGHTS_" + name + "_H";
  std::transform(guard.begin(), guard.end(), guard.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; });
  return fmt::format(
      "#ifndef {0}\n#define {0}\n#include \"{1}\"\n"
      "#if {2} != {3}\n#error \"{4}.h was exported for net ABI {3}: export it again\"\n#endif\n\n",
      guard, header, abi_macro, abi, name);
}

/// Between quotes of a CSV cell.
inline std::string quoted_csv(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result;
}

}  // namespace host
