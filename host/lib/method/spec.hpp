// The name of a method as typed: "lambert:3", "net:cube7", "hemicube:64".
#pragma once
#include <string>
#include <vector>

#include "base/error.hpp"

namespace host {

struct MethodSpec {
  std::string name;      ///< before the colon
  std::string argument;  ///< after it, or empty

  std::string text() const { return argument.empty() ? name : name + ":" + argument; }
  /// The argument as a whole number in [least, most], or `otherwise` when there is none. Throws
  /// Error.
  int number(int otherwise, int least, int most) const;
  /// The argument as a number in [least, most], or `otherwise` when there is none. Throws Error.
  double real(double otherwise, double least, double most) const;
  /// For methods that take none. Throws UsageError when there is one.
  void expect_no_argument() const;
};

MethodSpec parse_method(const std::string& text);

/// "M[,M...]". Throws UsageError when the list or one of its members is empty or stands twice.
std::vector<MethodSpec> parse_methods(const std::string& list);

/// What to throw for a method that is none of `known` ("hybrid[:R]", "lambert:N"): names them, and
/// the one that was probably meant.
UsageError unknown_method(const MethodSpec& spec, const std::vector<std::string>& known);

}  // namespace host
