#include "accuracy/method_plots.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/svg_plot.hpp"
#include "report/text.hpp"

namespace host {

namespace {

constexpr double kPanelWidth = 620, kPanelHeight = 420, kTitleHeight = 28;
constexpr std::size_t kColumns = 2;

double cost_of(const MethodTrialRow& row, MethodCost cost) {
  return cost == MethodCost::host_ns ? row.ns : row.instructions.value_or(0);
}

/// Methods of one name at several settings share a colour.
std::size_t colour_of(const std::string& label) {
  static const std::vector<std::string> names{"auto",    "net",   "lambert",      "gauss",
                                              "contour", "fixed", "fixed-lambert"};
  const std::string name = label.substr(0, label.find_first_of(":,"));
  const auto at = std::find(names.begin(), names.end(), name);
  return std::size_t(at - names.begin());
}

std::vector<PlotPoint> points_of(const MethodTrialTable& table, MethodCost cost) {
  std::vector<PlotPoint> points;
  for (const MethodTrialRow& row : table.rows)
    points.push_back({row.label, cost_of(row, cost), row.p95, colour_of(row.label)});
  return points;
}

bool shown(const PlotPoint& point) { return point.cost > 0 && point.error > 0; }

/// Labels on the front of a table.
std::vector<std::string> front_of(const MethodTrialTable& table, MethodCost cost) {
  std::vector<PlotPoint> points = points_of(table, cost);
  std::erase_if(points, [](const PlotPoint& point) { return !shown(point); });
  std::vector<std::string> labels;
  for (const std::size_t k : pareto_front(points)) labels.push_back(points[k].label);
  return labels;
}

}  // namespace

std::string method_plots_svg(const MethodTrials& trials, MethodCost cost) {
  const bool host = cost == MethodCost::host_ns;
  std::string panels;
  std::size_t count = 0;
  for (const MethodTrialTable& table : trials.families) {
    std::vector<PlotPoint> points = points_of(table, cost);
    for (PlotPoint& point : points) point.cost *= host ? 1e-9 : 1;
    const std::string plot = error_cost_svg(
        points, {table.title, host ? "host time of a pair" : "Cortex-M0 instructions of a pair",
                 host ? "s" : "", "95 % of the pairs are off by less"});
    if (plot.empty()) continue;
    const double x = double(count % kColumns) * kPanelWidth;
    const double y = double(count / kColumns) * (kPanelHeight + kTitleHeight);
    panels += fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\" fill=\"currentColor\" "
        "style=\"font:bold 14px system-ui,sans-serif\">{}</text>\n"
        "<svg x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\">{}</svg>\n",
        x + kPanelWidth / 2, y + 20, escape_markup(table.title), x, y + kTitleHeight, kPanelWidth,
        kPanelHeight, plot);
    ++count;
  }
  if (count == 0) return {};
  const std::size_t rows = (count + kColumns - 1) / kColumns;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" color=\"#777\">\n"
      "{}</svg>\n",
      double(kColumns) * kPanelWidth, double(rows) * (kPanelHeight + kTitleHeight), panels);
}

std::string front_table(const MethodTrials& trials) {
  if (trials.families.empty()) return {};
  std::string text =
      "| method | on the front of host time in | on the front of instructions in |\n"
      "| --- | --- | --- |\n";
  for (const MethodTrialRow& row : trials.families.front().rows) {
    const auto families = [&](MethodCost cost) {
      std::string names;
      for (const MethodTrialTable& table : trials.families) {
        const std::vector<std::string> front = front_of(table, cost);
        if (std::find(front.begin(), front.end(), row.label) == front.end()) continue;
        names += (names.empty() ? "" : "; ") + table.title.substr(0, table.title.find(" ("));
      }
      return names.empty() ? std::string("none") : names;
    };
    text += fmt::format("| {} | {} | {} |\n", row.label, families(MethodCost::host_ns),
                        row.instructions ? families(MethodCost::m0_instructions) : "-");
  }
  return text;
}

}  // namespace host
