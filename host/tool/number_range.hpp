// What numbers an option takes, and how a wrong one is told.
#pragma once
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>

namespace tool {

/// From least to most, both allowed.
template <class Number>
CLI::Validator between(Number least, Number most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        Number value{};
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most)
          return std::string();
        return fmt::format("{} should be from {} to {}", text, least, most);
      },
      fmt::format("from {} to {}", least, most));
}

/// Above 0 and finite.
inline CLI::Validator positive() {
  return CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value > 0 &&
            value <= std::numeric_limits<double>::max())
          return std::string();
        return fmt::format("{} should be above 0", text);
      },
      "above 0");
}

}  // namespace tool
