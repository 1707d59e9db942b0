#include "method/spec.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>

#include "base/nearest_name.hpp"

namespace host {

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
  if (text.find(',') != std::string::npos)
    throw UsageError(fmt::format("--method {}: one method at a time here", text));
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
    const MethodSpec spec = parse_method(list.substr(at, comma - at));
    if (std::any_of(specs.begin(), specs.end(),
                    [&](const MethodSpec& other) { return other.text() == spec.text(); }))
      throw UsageError(fmt::format("--method {}: {} stands twice", list, spec.text()));
    specs.push_back(spec);
    at = comma + 1;
  }
  return specs;
}

UsageError unknown_method(const MethodSpec& spec, const std::vector<std::string>& known) {
  const auto name = [](const std::string& entry) {
    return entry.substr(0, entry.find_first_of(":["));
  };
  std::vector<std::string> names;
  std::transform(known.begin(), known.end(), std::back_inserter(names), name);
  const auto meant = nearest_name(spec.name, names);
  return UsageError(fmt::format("--method {}: unknown{}; known are {}", spec.text(),
                                meant ? fmt::format(", {} would do", known[*meant]) : "",
                                fmt::join(known, ", ")));
}

}  // namespace host
