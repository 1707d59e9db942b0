// Tables of method trials, as Markdown.
#include <fmt/format.h>

#include <algorithm>

#include "accuracy/method_trials.hpp"

namespace host {

namespace {

constexpr std::size_t kMethodWidth = 1;  // columns to the left

std::string number(double x) { return fmt::format("{:.2g}", x); }

std::string table_of(const MethodTrialTable& table) {
  const auto any = [&](auto has) { return std::any_of(table.rows.begin(), table.rows.end(), has); };
  const bool counted = any([](const auto& row) { return row.instructions.has_value(); });
  const bool sure = any([](const auto& row) { return row.estimate.has_value(); });
  std::vector<std::string> head{"method", "median", "p95", "p99", "max", "bias", "ns", "MAC"};
  if (counted) head.push_back("M0 instructions");
  if (sure) head.insert(head.end(), {"error above estimate", "estimate / error, median", "p90"});
  const auto line = [](const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text + "\n";
  };
  std::string text = "\n" + table.title + ":\n\n" + line(head) + "|";
  for (std::size_t k = 0; k < head.size(); ++k) text += k < kMethodWidth ? " --- |" : " ---: |";
  text += "\n";
  for (const MethodTrialRow& row : table.rows) {
    std::vector<std::string> cells{row.label,
                                   number(row.median),
                                   number(row.p95),
                                   number(row.p99),
                                   number(row.max),
                                   number(row.bias),
                                   fmt::format("{:.0f}", row.ns)};
    const auto whole = [](const std::optional<double>& x) {
      return x ? fmt::format("{:.0f}", *x) : std::string("-");
    };
    cells.push_back(whole(row.multiply_adds));
    if (counted) cells.push_back(whole(row.instructions));
    if (sure && row.estimate) {
      cells.push_back(fmt::format("{:.2f} %", 100 * row.estimate->missed));
      cells.push_back(number(row.estimate->median));
      cells.push_back(number(row.estimate->p90));
    } else if (sure) {
      cells.insert(cells.end(), {"-", "-", "-"});
    }
    text += line(cells);
  }
  return text;
}

}  // namespace

std::string to_markdown(const MethodTrials& trials) {
  std::string text;
  for (const auto* tables : {&trials.families, &trials.decades})
    for (const MethodTrialTable& table : *tables) text += table_of(table);
  if (trials.ways.empty()) return text;
  text +=
      "\nWays that auto took, % of the pairs:\n\n| pairs | method | kernel | network | point | "
      "four "
      "points | nine points | refined |\n| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const std::string& line : trials.ways) text += line + "\n";
  return text;
}

}  // namespace host
