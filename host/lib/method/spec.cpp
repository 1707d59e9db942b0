#include "method/spec.hpp"

#include <fmt/format.h>

#include <charconv>

#include "base/error.hpp"

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

}  // namespace host
