#include "method/spec.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace host {

namespace {

/// Letters to change, leave out or put in [Levenshtein 1966].
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
    }
  }
  return row.back();
}

}  // namespace

int MethodSpec::number(int otherwise, int least, int most) const {
  if (argument.empty()) return otherwise;
  int value = 0;
  const char* end = argument.data() + argument.size();
  const auto [rest, failure] = std::from_chars(argument.data(), end, value);
  if (failure != std::errc() || rest != end || value < least || value > most) {
    throw UsageError(fmt::format("--method {}: \"{}\" should be a whole number from {} to {}",
                                 text(), argument, least, most));
  }
  return value;
}

double MethodSpec::real(double otherwise, double least, double most) const {
  if (argument.empty()) return otherwise;
  double value = 0;
  const char* end = argument.data() + argument.size();
  const auto [rest, failure] = std::from_chars(argument.data(), end, value);
  if (failure != std::errc() || rest != end || !(value >= least && value <= most)) {
    throw UsageError(fmt::format("--method {}: \"{}\" should be a number from {} to {}", text(),
                                 argument, least, most));
  }
  return value;
}

void MethodSpec::expect_no_argument() const {
  if (!argument.empty())
    throw UsageError(fmt::format("--method {}: {} takes no value", text(), name));
}

MethodSpec parse_method(const std::string& text) {
  const std::size_t colon = text.find(':');
  MethodSpec spec{text.substr(0, colon), colon == std::string::npos ? "" : text.substr(colon + 1)};
  if (spec.name.empty() || (colon != std::string::npos && spec.argument.empty())) {
    throw UsageError(fmt::format("--method: \"{}\" should be NAME or NAME:VALUE", text));
  }
  return spec;
}

std::vector<MethodSpec> parse_methods(const std::string& list) {
  std::vector<MethodSpec> specs;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    specs.push_back(parse_method(list.substr(at, comma - at)));
    at = comma + 1;
  }
  return specs;
}

UsageError unknown_method(const MethodSpec& spec, const std::vector<std::string>& known) {
  const auto name = [](const std::string& entry) {
    return entry.substr(0, entry.find_first_of(":["));
  };
  const auto away = [&](const std::string& entry) { return distance(spec.name, name(entry)); };
  const auto nearest = std::min_element(
      known.begin(), known.end(), [&](const auto& a, const auto& b) { return away(a) < away(b); });
  const bool close = nearest != known.end() && 3 * away(*nearest) <= name(*nearest).size();
  return UsageError(fmt::format("--method {}: unknown{}; known are {}", spec.text(),
                                close ? fmt::format(", {} would do", *nearest) : "",
                                fmt::join(known, ", ")));
}

}  // namespace host
