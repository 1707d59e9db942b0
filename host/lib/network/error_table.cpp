#include "network/error_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quantile.hpp"

namespace host {

namespace {

constexpr double kDecades[] = {0, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 2};
constexpr const char* kDecadeNames[] = {"F < 1e-5",     "F 1e-5..1e-4", "F 1e-4..1e-3",
                                        "F 1e-3..1e-2", "F 1e-2..0.1",  "F >= 0.1"};

}  // namespace

ErrorRow error_row(const std::string& name, const std::vector<Measured>& pairs) {
  ErrorRow row;
  row.name = name;
  row.pairs = pairs.size();
  std::vector<double> relative;
  double sum = 0, square = 0;
  for (const Measured& pair : pairs) {
    const double error = pair.value - pair.exact;
    sum += error;
    square += error * error;
    if (pair.exact > 0) relative.push_back(std::fabs(error) / pair.exact);
  }
  std::sort(relative.begin(), relative.end());
  row.median = quantile_of_sorted(relative, 0.5);
  row.p95 = quantile_of_sorted(relative, 0.95);
  row.p99 = quantile_of_sorted(relative, 0.99);
  row.max = quantile_of_sorted(relative, 1);
  if (!pairs.empty()) {
    const auto n = double(pairs.size());
    row.bias = sum / n;
    row.std = std::sqrt(std::max(0.0, square / n - row.bias * row.bias));
  }
  return row;
}

std::vector<ErrorRow> error_table(const std::string& name, const std::vector<Measured>& pairs) {
  std::vector<ErrorRow> table{error_row(name, pairs)};
  const auto add = [&](const std::string& group, const auto& belongs) {
    std::vector<Measured> part;
    std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(part), belongs);
    if (!part.empty()) table.push_back(error_row(group, part));
  };
  for (std::size_t k = 0; k < std::size(kDecadeNames); ++k)
    add(kDecadeNames[k], [=](const Measured& pair) {
      return pair.exact >= kDecades[k] && pair.exact < kDecades[k + 1];
    });
  for (const PairKind kind : kPairKinds)
    add(std::string(host::name(kind)), [=](const Measured& pair) { return pair.kind == kind; });
  return table;
}

std::string to_text(const std::vector<ErrorRow>& table) {
  std::string text =
      fmt::format("{:<24}{:>9}{:>10}{:>10}{:>10}{:>10}{:>10}{:>11}{:>10}{:>10}\n", "pairs", "count",
                  "median", "p95", "p99", "max", "std", "bias", "row mean", "row worst");
  for (const ErrorRow& row : table) {
    text +=
        fmt::format("{:<24}{:>9}{:>10.2g}{:>10.2g}{:>10.2g}{:>10.2g}{:>10.2g}{:>11.2g}", row.name,
                    row.pairs, row.median, row.p95, row.p99, row.max, row.std, row.bias);
    if (row.rows)
      text += fmt::format("{:>9.3f}%{:>9.3f}%", 100 * row.rows->mean, 100 * row.rows->worst);
    text += '\n';
  }
  return text;
}

std::string to_line(const ErrorRow& row) {
  std::string line =
      fmt::format("median {:.2g}  p99 {:.2g}  std {:.2g}", row.median, row.p99, row.std);
  if (row.rows)
    line += fmt::format("  row sums mean {:.2g} worst {:.2g}", row.rows->mean, row.rows->worst);
  return line;
}

}  // namespace host
