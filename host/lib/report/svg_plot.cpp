#include "report/svg_plot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report/text.hpp"

namespace host {
namespace {

constexpr double kWidth = 620, kHeight = 420;
constexpr double kLeft = 74, kRight = 18, kTop = 16, kBottom = 56;
constexpr double kLetter = 6.7, kLine = 14;  // of 12 px text: mean width, height

/// One logarithmic axis: value -> pixel, and where its ticks stand.
class LogAxis {
 public:
  LogAxis(double low, double high, double from, double to) : from_(from), to_(to) {
    low_ = std::log10(low), high_ = std::log10(high);
    const double pad = std::max(0.12 * (high_ - low_), 0.15);
    low_ -= pad, high_ += pad;
  }
  double at(double value) const {
    return from_ + (std::log10(value) - low_) / (high_ - low_) * (to_ - from_);
  }
  struct Tick {
    double value;
    bool labelled;
  };
  std::vector<Tick> ticks() const {
    // Less than two decades: 1, 2 and 5 get labels; many decades: only each second or third power
    // of ten.
    const double span = high_ - low_;
    const int stride = std::max(1, int(std::ceil(span / 7)));
    std::vector<Tick> out;
    for (int power = int(std::floor(low_)); power <= int(std::ceil(high_)); ++power)
      for (int digit = 1; digit <= 9; ++digit) {
        const double value = digit * std::pow(10.0, power);
        const double place = std::log10(value);
        if (place < low_ || place > high_) continue;
        const bool half = digit == 2 || digit == 5;
        out.push_back({value, (digit == 1 && power % stride == 0) || (half && span < 1.9)});
      }
    return out;
  }

 private:
  double low_, high_, from_, to_;
};

struct Rectangle {
  double x, y, width, height;
  double overlap(const Rectangle& o) const {
    const double w = std::min(x + width, o.x + o.width) - std::max(x, o.x);
    const double h = std::min(y + height, o.y + o.height) - std::max(y, o.y);
    return w > 0 && h > 0 ? w * h : 0;
  }
};

/// Letters, not bytes, of UTF-8 text.
double text_width(const std::string& text) {
  return kLetter * double(std::count_if(text.begin(), text.end(), [](char c) {
           return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
         }));
}

struct Label {
  Rectangle box;
  double x;
  const char* anchor;  ///< the box is an estimate: text starts or ends exactly beside its point
};

/// Puts the label beside its point where it covers least of what is there already.
Label place_label(double x, double y, double width, const std::vector<Rectangle>& taken) {
  static constexpr std::array<std::array<double, 2>, 8> kSides{
      {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}}};
  const Rectangle frame{kLeft + 2, kTop + 2, kWidth - kLeft - kRight - 4,
                        kHeight - kTop - kBottom - 4};
  Label best{};
  double least = std::numeric_limits<double>::infinity();
  for (const double distance : {1.0, 2.2})
    for (const auto& [dx, dy] : kSides) {
      const double at = x + dx * 10 * distance;
      const Rectangle box{at + (dx - 1) / 2 * width, y + dy * (10 * distance + 3) - kLine / 2,
                          width, kLine};
      double cost = 0.01 * distance + (width * kLine - box.overlap(frame)) * 4;
      for (const Rectangle& other : taken) cost += box.overlap(other);
      if (cost >= least) continue;
      least = cost;
      best = {box, at, dx > 0 ? "start" : dx < 0 ? "end" : "middle"};
    }
  return best;
}

std::string tick_text(double value, const std::string& unit) {
  std::string text = metric(value, 1);
  if (unit.empty()) return text;
  return text.find(' ') == std::string::npos ? text + " " + unit : text + unit;
}

std::string axes_svg(const LogAxis& x, const LogAxis& y, const PlotAxes& axes) {
  const double bottom = kHeight - kBottom, right = kWidth - kRight;
  std::string out;
  for (const auto& [value, labelled] : x.ticks()) {
    out += fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>", labelled ? "g" : "m",
                       x.at(value), bottom, labelled ? kTop : bottom - 4);
    if (labelled)
      out += fmt::format(
          "<text class=\"t\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
          x.at(value), bottom + 18, escape_markup(tick_text(value, axes.unit)));
  }
  for (const auto& [value, labelled] : y.ticks()) {
    out += fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", labelled ? "g" : "m",
                       kLeft, y.at(value), labelled ? right : kLeft + 4);
    if (labelled)
      out += fmt::format(
          "<text class=\"t\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:g} %</text>\n",
          kLeft - 8, y.at(value) + 4, 100 * value);
  }
  out += fmt::format("<path class=\"a\" d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\"/>\n", kLeft, kTop,
                     bottom, right);
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                     (kLeft + right) / 2, kHeight - 12, escape_markup(axes.cost));
  out += fmt::format(
      "<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
      (kTop + bottom) / 2, escape_markup(axes.error));
  return out;
}

std::string open_svg(double height, const std::string& title) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" "
      "role=\"img\" "
      "aria-label=\"{}\">\n<title>{}</title>\n"
      "<style>.plot{{font:12px system-ui,sans-serif}}.plot text{{fill:currentColor}}.plot "
      ".t{{opacity:.7}}"
      ".plot path{{fill:none;stroke:currentColor}}.plot .g{{opacity:.12}}.plot .m{{opacity:.35}}"
      ".plot .a{{opacity:.6}}.plot .f{{opacity:.55;stroke-width:1.5;stroke-dasharray:5 "
      "4}}</style>\n",
      kWidth, height, escape_markup(title), escape_markup(title));
}

}  // namespace

const char* plot_colour(std::size_t number) {
  // After Okabe and Ito, evened out in lightness.
  static constexpr std::array<const char*, 8> kColours{"#3b82c4", "#d97b29", "#2f9e6e", "#9a6dd7",
                                                       "#d1495b", "#1f9bb0", "#94891f", "#7a7f87"};
  return kColours[number % kColours.size()];
}

std::vector<std::size_t> pareto_front(const std::vector<PlotPoint>& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(points[a].cost, points[a].error) < std::pair(points[b].cost, points[b].error);
  });
  std::vector<std::size_t> front;
  for (const std::size_t k : order)
    if (front.empty() || points[k].error < points[front.back()].error) front.push_back(k);
  return front;
}

std::string error_cost_svg(const std::vector<PlotPoint>& all, const PlotAxes& axes) {
  std::vector<PlotPoint> points;
  for (const PlotPoint& p : all)
    if (p.cost > 0 && p.error > 0 && std::isfinite(p.cost) && std::isfinite(p.error))
      points.push_back(p);
  if (points.empty()) return {};
  const auto [cheap, dear] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  const auto [good, bad] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
  const LogAxis x(cheap->cost, dear->cost, kLeft, kWidth - kRight);
  const LogAxis y(good->error, bad->error, kHeight - kBottom, kTop);
  std::string out = open_svg(kHeight, axes.title) + axes_svg(x, y, axes);

  const std::vector<std::size_t> front = pareto_front(points);
  std::string steps;
  for (const std::size_t k : front)
    steps += steps.empty()
                 ? fmt::format("M{:.1f} {:.1f}", x.at(points[k].cost), y.at(points[k].error))
                 : fmt::format("H{:.1f}V{:.1f}", x.at(points[k].cost), y.at(points[k].error));
  if (front.size() > 1) out += fmt::format("<path class=\"f\" d=\"{}\"/>\n", steps);

  std::vector<Rectangle> taken;
  for (std::size_t k = 1; k < front.size(); ++k) {  // the steps of the front are no place for text
    const double from = x.at(points[front[k - 1]].cost), to = x.at(points[front[k]].cost);
    const double high = y.at(points[front[k - 1]].error), low = y.at(points[front[k]].error);
    taken.push_back({from, high - 2, to - from, 4});
    taken.push_back({to - 2, high, 4, low - high});
  }
  for (const PlotPoint& p : points) taken.push_back({x.at(p.cost) - 7, y.at(p.error) - 7, 14, 14});
  for (std::size_t k = 0; k < points.size(); ++k) {
    const PlotPoint& p = points[k];
    const char* colour = plot_colour(p.colour);
    const bool best = std::find(front.begin(), front.end(), k) != front.end();
    out += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5.5\" stroke=\"{}\" stroke-width=\"2\" "
        "fill=\"{}\">"
        "<title>{}: {}, {}</title></circle>\n",
        x.at(p.cost), y.at(p.error), colour, best ? colour : "none", escape_markup(p.label),
        percent(p.error), escape_markup(metric(p.cost) + axes.unit));
    const Label label = place_label(x.at(p.cost), y.at(p.error), text_width(p.label), taken);
    taken.push_back(label.box);
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", label.x,
                       label.box.y + kLine - 3, label.anchor, escape_markup(p.label));
  }
  return out + "</svg>\n";
}

std::string curves_svg(const std::vector<PlotCurve>& curves, const PlotAxes& axes) {
  double low_x = std::numeric_limits<double>::infinity(), high_x = 0, low_y = low_x, high_y = 0;
  for (const PlotCurve& curve : curves)
    for (const auto& [cost, error] : curve.points) {
      low_x = std::min(low_x, cost), high_x = std::max(high_x, cost);
      low_y = std::min(low_y, error), high_y = std::max(high_y, error);
    }
  if (high_x <= 0) return {};
  const LogAxis x(low_x, high_x, kLeft, kWidth - kRight), y(low_y, high_y, kHeight - kBottom, kTop);
  std::string body, key;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const char* const colour = plot_colour(k);
    std::string path;
    for (const auto& [cost, error] : curves[k].points)
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x.at(cost), y.at(error));
    if (!path.empty())
      body += fmt::format("<path style=\"stroke:{};stroke-width:2\" d=\"{}\"/>\n", colour, path);
    const double top = kHeight - kBottom - 12 - kLine * double(curves.size() - 1 - k);
    key += fmt::format(
        "<rect x=\"{:.0f}\" y=\"{:.1f}\" width=\"11\" height=\"4\" fill=\"{}\"/>"
        "<text x=\"{:.0f}\" y=\"{:.1f}\">{}</text>\n",
        kLeft + 10, top - 6, colour, kLeft + 26, top, escape_markup(curves[k].label));
  }
  return open_svg(kHeight, axes.title) + axes_svg(x, y, axes) + body + key + "</svg>\n";
}

std::string share_bars_svg(const std::vector<Bar>& bars, const std::string& title) {
  constexpr double kLabel = 170, kBarHeight = 20, kStep = 30;
  const double span = kWidth - kLabel - kRight;
  std::string body;
  std::vector<BarPart> legend;
  double top = 30;
  for (const Bar& bar : bars) {
    double sum = 0;
    for (const BarPart& part : bar.parts) sum += double(part.value);
    if (sum <= 0) continue;
    body += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>",
                        kLabel - 10, top + 14, escape_markup(bar.label));
    double x = kLabel;
    for (const BarPart& part : bar.parts) {
      const auto same = [&](const BarPart& p) { return p.label == part.label; };
      if (std::none_of(legend.begin(), legend.end(), same)) legend.push_back(part);
      if (part.value == 0) continue;
      const double width = span * double(part.value) / sum;
      body += fmt::format(
          "<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.0f}\" fill=\"{}\">"
          "<title>{}: {} ({})</title></rect>",
          x, top, width, kBarHeight, escape_markup(part.colour), escape_markup(part.label),
          grouped(std::int64_t(part.value)), percent(double(part.value) / sum));
      const std::string share = percent(double(part.value) / sum);
      if (width > text_width(share) + 8)
        body += fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" style=\"fill:#fff\">{}</text>",
            x + width / 2, top + 14, share);
      x += width;
    }
    body += "\n";
    top += kStep;
  }
  if (body.empty()) return {};
  std::string key;
  double x = kLabel;
  for (const BarPart& part : legend) {
    key += fmt::format(
        "<rect x=\"{:.1f}\" y=\"6\" width=\"11\" height=\"11\" fill=\"{}\"/>"
        "<text x=\"{:.1f}\" y=\"16\">{}</text>",
        x, escape_markup(part.colour), x + 16, escape_markup(part.label));
    x += 16 + text_width(part.label) + 16;
  }
  return open_svg(top + 4, title) + key + "\n" + body + "</svg>\n";
}

}  // namespace host
