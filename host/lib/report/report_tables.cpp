// The lower half of report.html: numbers.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "report/counters_json.hpp"
#include "report/report_sections.hpp"
#include "report/svg_plot.hpp"
#include "report/text.hpp"

namespace host {
namespace {

using Value = std::optional<double>;

constexpr const char *kAbsorbed = "#2f6f8f", *kEscaped = "#8b8f98", *kUnshot = "#c2572b";

struct Column {
  const char* title;
  std::function<Value(const MethodResult&)> value;
  std::function<std::string(double)> text;
  bool rank = true;  ///< whether less is better
};

Value real(const auto& value) { return value ? Value(double(*value)) : Value(); }

std::string count_text(double value) { return grouped(std::llround(value)); }
std::string seconds_text(double value) {
  return metric(value) + (value == 0 ? " s" : value < 1 ? "s" : " s");
}
std::string whole_bytes(double value) { return bytes_text(std::llround(value)); }

std::string row_title(const MethodResult& method, std::size_t number) {
  std::string out =
      fmt::format("<th scope=\"row\"><span class=\"dot\" style=\"background:{}\"></span>{}",
                  plot_colour(number), escape_markup(method.label()));
  if (!method.title.empty()) out += "<code>" + escape_markup(method.name) + "</code>";
  return out + "</th>";
}

/// A table with a row per method; columns that nobody fills are left out, the best of a column
/// stands out.
std::string table(const BakeReport& report, const std::vector<Column>& all) {
  std::vector<Column> columns;
  for (const Column& column : all)
    if (std::any_of(report.methods.begin(), report.methods.end(),
                    [&](const MethodResult& m) { return column.value(m).has_value(); }))
      columns.push_back(column);
  if (columns.empty()) return {};
  std::string out = "<div class=\"wide\"><table>\n<thead><tr><th>Method</th>";
  for (const Column& column : columns) out += fmt::format("<th>{}</th>", column.title);
  out += "</tr></thead>\n<tbody>\n";
  for (std::size_t row = 0; row < report.methods.size(); ++row) {
    const MethodResult& method = report.methods[row];
    if (std::none_of(columns.begin(), columns.end(),
                     [&](const Column& column) { return column.value(method).has_value(); }))
      continue;
    out += method.reference ? "<tr class=\"reference\">" : "<tr>";
    out += row_title(method, row);
    for (const Column& column : columns) {
      const Value value = column.value(method);
      if (!value) {
        out += "<td class=\"none\">–</td>";
        continue;
      }
      const auto beats = [&](const MethodResult& m) {
        return !m.reference && column.value(m) && *column.value(m) < *value;
      };
      const bool best = column.rank && !method.reference &&
                        std::none_of(report.methods.begin(), report.methods.end(), beats);
      out += fmt::format("<td{}>{}</td>", best ? " class=\"best\"" : "", column.text(*value));
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string plot(const BakeReport& report, const char* title, const char* cost, const char* unit,
                 double factor, const std::function<Value(const MethodResult&)>& value) {
  std::vector<PlotPoint> points;
  for (std::size_t k = 0; k < report.methods.size(); ++k) {
    const MethodResult& method = report.methods[k];
    if (value(method) && method.errors.b_rms && !method.reference)
      points.push_back({method.label(), factor * *value(method), *method.errors.b_rms, k});
  }
  const std::string svg = error_cost_svg(points, {title, cost, unit, "rms error of B"});
  return svg.empty() ? svg : "<figure>" + svg + "</figure>\n";
}

std::string facts_list(const std::vector<Fact>& facts, bool code) {
  std::string out;
  for (const Fact& fact : facts)
    out += fmt::format("<dt{}>{}</dt><dd>{}</dd>\n", code ? " class=\"code\"" : "",
                       escape_markup(fact.name), escape_markup(fact.value));
  return out.empty() ? out : "<dl>\n" + out + "</dl>\n";
}

/// Where the emitted power went, as a bar.
std::string energy_bar(const EnergyAudit& audit, std::size_t channel) {
  const double whole = double(std::max<std::int64_t>(1, audit.emitted[channel]));
  std::string out = "<span class=\"share\">";
  const auto part = [&](std::int64_t value, const char* colour) {
    const double width = std::clamp(100 * double(value) / whole, 0.0, 100.0);
    out += fmt::format("<i style=\"width:{:.2f}%;background:{}\"></i>", width, colour);
  };
  part(audit.absorbed[channel], kAbsorbed);
  part(audit.escaped[channel], kEscaped);
  part(audit.unshot[channel], kUnshot);
  return out + "</span>";
}

}  // namespace

std::string methods_html(const BakeReport& report) {
  const auto error = [](std::optional<double> MethodErrors::*field) {
    return [field](const MethodResult& m) { return m.errors.*field; };
  };
  const auto small = [](double value) { return fmt::format("{:.2g}", value); };
  const auto instructions = [](double value) { return metric(value); };
  const std::string rows = table(
      report, {{"Error of B<br>rms", error(&MethodErrors::b_rms), percent},
               {"Error of B<br>worst", error(&MethodErrors::b_max), percent},
               {"Error of F<br>std", error(&MethodErrors::f_std), small},
               {"Error of F<br>worst", error(&MethodErrors::f_max), small},
               {"Row sums off<br>mean", error(&MethodErrors::row_mean), percent},
               {"Row sums off<br>worst", error(&MethodErrors::row_worst), percent},
               {"Shots", [](const MethodResult& m) { return real(m.shots); }, count_text},
               {"Solve<br>host", [](const MethodResult& m) { return m.seconds; }, seconds_text},
               {"Pair<br>host", [](const MethodResult& m) { return m.ns_per_pair; },
                [](double ns) { return seconds_text(ns * 1e-9); }},
               {"Pair<br>M0 instr.",
                [](const MethodResult& m) { return m.m0_instructions_per_pair; }, instructions},
               {"Solve<br>M0 instr.", [](const MethodResult& m) { return m.m0_instructions; },
                instructions},
               {"RAM", [](const MethodResult& m) { return real(m.ram_bytes); }, whole_bytes}});
  if (rows.empty()) return {};
  return "<h2>Error and cost</h2>\n<p class=\"sub\">From this run. B is the radiosity, F a form "
         "factor; errors of B "
         "are fractions of the rms of the exact B, row sums are taken before any repair. The best "
         "of a column is "
         "marked; the exact solution does not compete.</p>\n" +
         rows;
}

std::string plots_html(const BakeReport& report) {
  const std::string host_pair =
      plot(report, "Error against host time per pair", "host time per form factor", "s", 1e-9,
           [](const MethodResult& m) { return m.ns_per_pair; });
  const std::string host_solve =
      plot(report, "Error against host time per solve", "host time of the solve", "s", 1,
           [](const MethodResult& m) { return m.seconds; });
  std::string chip = plot(report, "Error against Cortex-M0 instructions per solve",
                          "Cortex-M0 instructions of the solve", "", 1,
                          [](const MethodResult& m) { return m.m0_instructions; });
  if (chip.empty())
    chip = plot(report, "Error against Cortex-M0 instructions per pair",
                "Cortex-M0 instructions per form factor", "", 1,
                [](const MethodResult& m) { return m.m0_instructions_per_pair; });
  const std::string plots = (host_pair.empty() ? host_solve : host_pair) + chip;
  if (plots.empty()) return {};
  return "<h2>Error against cost</h2>\n<p class=\"sub\">Down and to the left is better. Filled: no "
         "other method is "
         "both cheaper and closer.</p>\n<div class=\"plots\">\n" +
         plots + "</div>\n";
}

std::string skips_html(const BakeReport& report) {
  std::vector<Bar> bars;
  for (const MethodResult& method : report.methods) {
    if (!method.counters) continue;
    const urad_counters& c = *method.counters;
    bars.push_back({method.label(),
                    {{"evaluated", c.evaluated, "#2f6f8f"},
                     {"same surface", c.skipped_same, "#7a5c8e"},
                     {"facing away", c.skipped_facing, "#8b8f98"},
                     {"below the bound", c.skipped_small, "#b9a04a"}}});
  }
  const std::string svg = share_bars_svg(bars, "Pairs evaluated and skipped, by method");
  const auto counter = [](std::uint32_t urad_counters::*field) {
    return [field](const MethodResult& m) {
      return m.counters ? Value((*m.counters).*field) : Value();
    };
  };
  const auto solver = [](std::uint32_t urad_radiosity_counters::*field) {
    return
        [field](const MethodResult& m) { return m.solver ? Value((*m.solver).*field) : Value(); };
  };
  const auto pairs = [](const MethodResult& m) {
    return m.counters ? Value(double(counted_pairs(*m.counters))) : Value();
  };
  const std::string rows = table(
      report,
      {{"Pairs<br>accounted for", pairs, count_text, false},
       {"Evaluated", counter(&urad_counters::evaluated), count_text, false},
       {"Clipped", counter(&urad_counters::clipped), count_text, false},
       {"Far,<br>kernel alone", counter(&urad_counters::far_pairs), count_text, false},
       {"Loaded:<br>pose seen", counter(&urad_counters::poses), count_text, false},
       {"Networks", counter(&urad_counters::networks), count_text, false},
       {"No blockers:<br>convex", counter(&urad_counters::skipped_convex), count_text, false},
       {"Blocked", counter(&urad_counters::blocked), count_text, false},
       {"Rays", counter(&urad_counters::rays), count_text, false},
       {"spared", counter(&urad_counters::rays_spared), count_text, false},
       {"Ray tests", counter(&urad_counters::ray_tests), count_text, false},
       {"Blockers<br>rejected", counter(&urad_counters::blockers_rejected), count_text, false},
       {"Hemicube<br>faces", counter(&urad_counters::faces), count_text, false},
       {"of them<br>empty", counter(&urad_counters::faces_empty), count_text, false},
       {"Rows", counter(&urad_counters::rows), count_text, false},
       {"of them<br>empty", counter(&urad_counters::rows_empty), count_text, false},
       {"Cells", counter(&urad_counters::cells), count_text, false},
       {"Updates of<br>the solver", solver(&urad_radiosity_counters::updates), count_text, false},
       {"skipped: channel<br>without power", solver(&urad_radiosity_counters::skipped_channel),
        count_text, false},
       {"skipped: receiver<br>reflects nothing", solver(&urad_radiosity_counters::skipped_black),
        count_text, false},
       {"skipped: run<br>without light", solver(&urad_radiosity_counters::skipped_dark), count_text,
        false}});
  if (rows.empty()) return {};
  return "<h2>What was left out</h2>\n<p class=\"sub\">Ordered pairs over all shots. Skipping "
         "leaves the integers as "
         "they are; evaluated and skipped pairs add up to all pairs of the sweeps.</p>\n" +
         (svg.empty() ? svg : "<div class=\"panel\">" + svg + "</div>\n") + rows;
}

std::string energy_html(const BakeReport& report) {
  static constexpr const char* kChannels[] = {"red", "green", "blue"};
  std::string rows;
  for (std::size_t k = 0; k < report.methods.size(); ++k) {
    if (!report.methods[k].audit) continue;
    const EnergyAudit& audit = *report.methods[k].audit;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      rows += "<tr>";
      rows += channel == 0 ? row_title(report.methods[k], k) : "<th></th>";
      rows += fmt::format("<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
                          kChannels[channel], grouped(audit.emitted[channel]),
                          grouped(audit.absorbed[channel]), grouped(audit.unshot[channel]),
                          grouped(audit.escaped[channel]), energy_bar(audit, channel));
      rows += audit.gap(channel) == 0 ? "<td class=\"good\">exact</td></tr>\n"
                                      : fmt::format("<td class=\"bad\">off by {}</td></tr>\n",
                                                    grouped(audit.gap(channel)));
    }
  }
  if (rows.empty()) return {};
  return fmt::format(
      "<h2>Energy</h2>\n<p class=\"sub\">Integer power units, each column summed on its own; exact "
      "means that "
      "absorbed + unshot + escaped is the emitted integer itself. "
      "<span class=\"key\" style=\"background:{}\"></span>absorbed"
      "<span class=\"key\" style=\"background:{}\"></span>escaped"
      "<span class=\"key\" style=\"background:{}\"></span>unshot</p>\n"
      "<div "
      "class=\"wide\"><table>\n<thead><tr><th>Method</th><th>Channel</th><th>Emitted</"
      "th><th>Absorbed</th>"
      "<th>Unshot</th><th>Escaped</th><th>Where it "
      "went</th><th>Balance</th></tr></thead>\n<tbody>\n{}"
      "</tbody></table></div>\n",
      kAbsorbed, kEscaped, kUnshot, rows);
}

std::string memory_html(const BakeReport& report) {
  std::string rows;
  for (std::size_t k = 0; k < report.methods.size(); ++k) {
    const MethodResult& method = report.methods[k];
    if (!method.ram_bytes && !method.flash_bytes && method.memory.empty()) continue;
    const auto cell = [](const std::optional<std::int64_t>& bytes) {
      return bytes ? fmt::format("<td>{} B</td>", grouped(*bytes)) : "<td class=\"none\">–</td>";
    };
    std::string parts;
    for (const Fact& part : method.memory)
      parts += fmt::format("{}{} {}", parts.empty() ? "" : " · ", escape_markup(part.name),
                           "<b>" + escape_markup(part.value) + "</b>");
    rows += "<tr>" + row_title(method, k) + cell(method.ram_bytes) + cell(method.flash_bytes) +
            "<td class=\"text\">" + parts + "</td></tr>\n";
  }
  if (rows.empty()) return {};
  return "<h2>Memory</h2>\n<p class=\"sub\">All RAM is the caller's; the engine has no heap and no "
         "static "
         "state.</p>\n<div "
         "class=\"wide\"><table>\n<thead><tr><th>Method</th><th>RAM</th><th>Flash</th>"
         "<th style=\"text-align:left\">What it holds</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string reproduce_html(const BakeReport& report) {
  std::string out;
  if (!report.network.empty()) out += "<h2>The network</h2>\n" + facts_list(report.network, false);
  if (!report.files.empty())
    out += "<h2>Files beside this page</h2>\n" + facts_list(report.files, true);
  if (report.reproduce.empty()) return out;
  out += "<h2>Do it again</h2>\n<pre>";
  for (const std::string& line : report.reproduce) out += escape_markup(line) + "\n";
  return out + "</pre>\n";
}

}  // namespace host
