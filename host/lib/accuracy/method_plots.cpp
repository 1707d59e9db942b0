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

/// A table's title without its number of pairs.
std::string kind_of(const std::string& title) {
  return title.substr(0, std::min(title.find(" ("), title.rfind(", ")));
}

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
    const std::size_t column = count % kColumns, row = count / kColumns;
    const double x = double(column) * kPanelWidth;
    const double y = double(row) * (kPanelHeight + kTitleHeight);
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
        names += (names.empty() ? "" : "; ") + kind_of(table.title);
      }
      return names.empty() ? std::string("none") : names;
    };
    text += fmt::format("| {} | {} | {} |\n", row.label, families(MethodCost::host_ns),
                        row.instructions ? families(MethodCost::m0_instructions) : "-");
  }
  return text;
}

/// Figures of a survey on another machine, copied: time in ns, error on the cube, on free quads.
std::string peer_table() {
  struct Peer {
    const char *program, *setting, *ns, *cube_rms, *quads_median, *quads_p95;
  };
  constexpr Peer kPeers[] = {
      {"View3D 4.0", "eps 1e-2", "160", "3.4e-5", "-", "-"},
      {"View3D 4.0", "eps 1e-4, its default", "115 to 187", "5.0e-6", "3.8e-6 (convex)",
       "1.4e-4 (convex)"},
      {"View3D 4.0", "eps 1e-6", "265 to 377", "2.6e-8", "7e-8 (convex)", "3.3e-6 (convex)"},
      {"OpenViewFactor 0.3", "DAI", "105", "3.7e-3", "0.14", "1.1"},
      {"OpenViewFactor 0.3", "SAI", "291", "4.8e-4", "0.071", "1.1"},
  };
  std::string text =
      "| not measured in this run: figures of a survey | setting | ns per factor of the cube | "
      "cube, RMS | free quads, median | p95 |\n| --- | --- | ---: | ---: | ---: | ---: |\n";
  for (const Peer& p : kPeers)
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", p.program, p.setting, p.ns, p.cube_rms,
                        p.quads_median, p.quads_p95);
  return text;
}

}  // namespace host
