// SHA-256 of a file's bytes: tells which net.json a header was exported from.
#pragma once
#include <string>
#include <string_view>

namespace host {

/// 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace host
