// Numbers and names as a person reads them, and as HTML and SVG take them.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace host {

/// Safe as text and inside quoted attributes of HTML, XML and SVG. Control characters become
/// U+FFFD.
std::string escape_markup(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// 1,234,567
std::string grouped(std::int64_t value);

/// `digits` significant digits and a metric prefix: 12.3 k, 4.56 M, 789, 1.2 m (1e-3), 3.4 µ.
std::string metric(double value, int digits = 3);

/// A fraction as per cent with two significant digits: 0.21 %, 12 %, 0.0031 %.
std::string percent(double fraction);

/// 812 B, 12.4 KB (1024 bytes).
std::string bytes_text(std::int64_t bytes);

}  // namespace host
