// Plots as inline SVG that follow the page's text colour: legible on light and on dark.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace host {

struct PlotPoint {
  std::string label;
  double cost = 0, error = 0;  ///< both > 0, or the point is left out
  std::size_t colour = 0;      ///< number of the method; the same in every plot
};

struct PlotAxes {
  std::string title;  ///< for readers who do not see the plot
  std::string cost;   ///< "host time per pair"
  std::string
      unit;  ///< of the cost, after a metric prefix: "s" gives ns and µs; empty: a plain count
  std::string error;  ///< "rms error of B"
};

/// Error (as per cent) against cost, both logarithmic, a labelled point per method and the Pareto
/// front: methods that no other beats in both are filled and joined by steps. Empty string when no
/// point can be shown.
std::string error_cost_svg(const std::vector<PlotPoint>& points, const PlotAxes& axes);

/// Indices of the points that no other beats in both, by rising cost.
std::vector<std::size_t> pareto_front(const std::vector<PlotPoint>& points);

struct PlotCurve {
  struct Point {
    double cost, error;  ///< both > 0
  };
  std::string label;
  std::vector<Point> points;  ///< by rising cost
};

/// Error (as per cent) against cost, both logarithmic, a line per curve and a legend. Empty string when
/// no curve has a point.
std::string curves_svg(const std::vector<PlotCurve>& curves, const PlotAxes& axes);

struct BarPart {
  std::string label;
  std::uint64_t value = 0;
  std::string colour;  ///< CSS
};
struct Bar {
  std::string label;
  std::vector<BarPart> parts;
};

/// Stacked horizontal bars, each scaled to its own sum, with a legend. Empty string when every bar
/// is empty.
std::string share_bars_svg(const std::vector<Bar>& bars, const std::string& title);

/// "#rrggbb", distinct for 8 numbers in a row, also to colour-blind eyes; mid lightness.
const char* plot_colour(std::size_t number);

}  // namespace host
