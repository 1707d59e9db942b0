#include "stress/stress_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace host {
namespace {

std::string number(double value) {
  return std::isinf(value) ? "infinite" : fmt::format("{:.3g}", value);
}

std::string limit_of(double limit) {
  return std::isinf(limit) ? "-" : fmt::format("{:.3g}", limit);
}

/// With blanks between thousands.
std::string grouped(std::uint64_t count) {
  std::string digits = fmt::format("{}", count);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return digits;
}

/// Failed rows come first, then those with a limit; the order of the run otherwise.
std::vector<StressRow> sorted(std::vector<StressRow> rows) {
  std::stable_partition(rows.begin(), rows.end(),
                        [](const StressRow& row) { return !row.holds(); });
  return rows;
}

/// One row for every kind and check: the worst of all families.
std::vector<StressRow> by_check(const std::vector<StressRow>& rows) {
  std::vector<StressRow> merged;
  for (const StressRow& row : rows) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const StressRow& other) {
      return other.kind == row.kind && other.what == row.what;
    });
    if (same == merged.end()) {
      merged.push_back(row);
      continue;
    }
    if (row.worst > same->worst)
      same->worst = row.worst, same->where = row.where, same->family = row.family;
    same->cases += row.cases, same->failures += row.failures, same->sum += row.sum;
  }
  return merged;
}

/// Of every family of pairs: the worst of `auto`, and what goes beyond its own estimate.
std::string auto_table(const std::vector<StressRow>& rows) {
  std::string text;
  for (const StressRow& row : rows) {
    if (row.what != "auto: relative error, F > 1e-6") continue;
    const auto beyond = std::find_if(rows.begin(), rows.end(), [&](const StressRow& other) {
      return other.family == row.family && other.what.starts_with("auto: error beyond");
    });
    text += fmt::format("| {} | {} | {} | {} | {}#{} |\n", row.family, grouped(row.cases),
                        number(row.worst), beyond == rows.end() ? "-" : number(beyond->worst),
                        row.family, row.where);
  }
  constexpr const char* kHead = R"(
### `auto` under stress

Worst relative error above F = 1e-6; the goal is 10 %, or an estimate that says so. "beyond": what is left of an error
past 10 % and past three times the error that `auto` returns beside the factor.

| family | cases | worst | beyond | where |
| --- | --: | --: | --: | --- |
)";
  return text.empty() ? text : kHead + text;
}

}  // namespace

std::string stress_table(const StressReport& report) {
  std::string text = fmt::format("{:<9} {:<36} {:<46} {:>11} {:>9} {:>9}  {}\n", "kind", "family",
                                 "check", "cases", "worst", "limit", "where");
  for (const StressRow& row : sorted(report.rows))
    text +=
        fmt::format("{:<9} {:<36} {:<46} {:>11} {:>9} {:>9}  #{}{}\n", row.kind, row.family,
                    row.what, grouped(row.cases), number(row.worst), limit_of(row.limit), row.where,
                    row.holds() ? "" : fmt::format("  FAILED {} times", grouped(row.failures)));
  for (const std::string& file : report.files) text += "urad stress --replay " + file + "\n";
  return text;
}

std::string check_table(const std::vector<StressCheck>& checks) {
  std::string text;
  for (const StressCheck& check : checks)
    text += fmt::format("{:<60} {:>9} {:>9}{}\n", check.what, number(check.value),
                        limit_of(check.limit), check.holds() ? "" : "  FAILED");
  return text;
}

std::string stress_document(const StressReport& report) {
  std::string text = fmt::format(
      "Written by `{}`: {:.1f} minutes on {} threads, seed {}. A value is the worst "
      "of all cases of its\nkind; a dash for the limit means that it is only shown. Case N of a "
      "family is the same in every run with\nthis seed: `urad stress --seed {} --case "
      "'FAMILY#N'`.\n\n| kind | cases | failures |\n| --- | --: | --: |\n",
      report.request.command, report.seconds / 60, report.request.threads, report.request.seed,
      report.request.seed);
  for (std::size_t k = 0; k < report.request.kinds.size(); ++k) {
    std::uint64_t failures = 0;
    for (const StressRow& row : report.rows)
      if (row.kind == report.request.kinds[k]) failures += row.failures;
    text += fmt::format("| {} | {} | {} |\n", report.request.kinds[k],
                        grouped(report.kind_cases[k]), grouped(failures));
  }
  const std::vector<StressRow> merged = by_check(report.rows);
  for (const std::string& kind : report.request.kinds) {
    text += fmt::format(
        "\n### {}\n\n| check | cases | worst | limit | where |\n| --- | --: | --: | --: | --- |\n",
        kind);
    for (const StressRow& row : merged)
      if (row.kind == kind)
        text += fmt::format("| {} | {} | {} | {} | {}#{}{} |\n", row.what, grouped(row.cases),
                            number(row.worst), limit_of(row.limit), row.family, row.where,
                            row.holds() ? "" : fmt::format(", failed {}", grouped(row.failures)));
  }
  return text + auto_table(report.rows);
}

}  // namespace host
