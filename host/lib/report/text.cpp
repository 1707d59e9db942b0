#include "report/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace host {

std::string escape_markup(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      case '\n':
      case '\t':
        out += c;
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
          out += "\xEF\xBF\xBD";
        else
          out += c;
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 | (i < count ? static_cast<unsigned char>(bytes[k + i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      out += i <= count ? kDigits[group >> (18 - 6 * i) & 63U] : '=';
  }
  return out;
}

std::string grouped(std::int64_t value) {
  std::string digits = std::to_string(value);
  const std::size_t sign = value < 0 ? 1 : 0;
  for (std::size_t k = digits.size(); k > sign + 3;) digits.insert(k -= 3, 1, ',');
  return digits;
}

std::string metric(double value, int digits) {
  static constexpr std::array<const char*, 9> kPrefix{"p", "n", "µ", "m", "", "k", "M", "G", "T"};
  if (!std::isfinite(value)) return std::isnan(value) ? "not a number" : value > 0 ? "∞" : "−∞";
  if (value == 0) return "0";
  // The exponent of the rounded value, so that 999.96 becomes 1.00 k and not 1e+03.
  const std::string rounded = fmt::format("{:.{}e}", value, digits - 1);
  const int exponent = std::stoi(rounded.substr(rounded.find('e') + 1));
  const int thousands = std::clamp(int(std::floor(exponent / 3.0)), -4, 4);
  const int decimals = std::clamp(digits - 1 - (exponent - 3 * thousands), 0, digits - 1);
  const std::string number = fmt::format("{:.{}f}", value / std::pow(1000.0, thousands), decimals);
  const char* prefix = kPrefix[std::size_t(thousands + 4)];
  return *prefix ? number + " " + prefix : number;
}

std::string percent(double fraction) {
  const double value = 100 * fraction;
  if (!std::isfinite(value)) return metric(value) + " %";
  if (value == 0) return "0 %";
  const std::string rounded = fmt::format("{:.1e}", value);
  const int exponent = std::stoi(rounded.substr(rounded.find('e') + 1));
  if (exponent < -4) return rounded + " %";
  return fmt::format("{:.{}f} %", value, std::max(0, 1 - exponent));
}

std::string bytes_text(std::int64_t bytes) {
  if (std::abs(bytes) < 1024) return fmt::format("{} B", bytes);
  const double kilobytes = double(bytes) / 1024;
  return kilobytes < 1024 ? fmt::format("{:.1f} KB", kilobytes)
                          : fmt::format("{:.1f} MB", kilobytes / 1024);
}

}  // namespace host
