#include "report/report_html.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "report/report_sections.hpp"
#include "report/report_style.hpp"
#include "report/text.hpp"

namespace host {
namespace {

std::string heading(const BakeReport& report) {
  return escape_markup(report.title.empty() ? report.scene : report.title);
}

std::string scene_article(const BakeReport& report, std::size_t number) {
  std::string out = fmt::format("<article id=\"scene{}\">\n<h1>{}</h1>\n", number, heading(report));
  out += summary_html(report);
  out += pictures_html(report);
  out += methods_html(report);
  out += plots_html(report);
  out += skips_html(report);
  out += energy_html(report);
  out += memory_html(report);
  out += reproduce_html(report);
  return out + "</article>\n";
}

}  // namespace

std::string report_html(const std::vector<BakeReport>& reports) {
  std::string title = "urad";
  for (const BakeReport& report : reports)
    title += (title == "urad" ? " · " : ", ") + heading(report);
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\n"
      "<title>" +
      title + "</title>\n<style>" + kReportStyle;
  // One copy of the exact picture per scene, which appears over a method's picture while it is
  // pointed at.
  for (std::size_t k = 0; k < reports.size(); ++k) {
    const MethodResult* exact = reports[k].reference();
    if (exact && !exact->pictures.smooth.empty())
      out += fmt::format(
          "#scene{} .compare::after{{background-image:url(data:image/png;base64,{})}}\n", k,
          base64(exact->pictures.smooth));
  }
  out += "</style>\n</head>\n<body>\n<nav><b>urad</b>";
  for (std::size_t k = 0; reports.size() > 1 && k < reports.size(); ++k)
    out += fmt::format("<a href=\"#scene{}\">{}</a>", k, heading(reports[k]));
  out += "<span>radiosity in integers: error and cost, side by side</span></nav>\n<main>\n";
  for (std::size_t k = 0; k < reports.size(); ++k) out += scene_article(reports[k], k);
  out += "<footer>Written by urad";
  if (!reports.empty() && !reports.front().version.empty())
    out += " " + escape_markup(reports.front().version);
  return out +
         ". This page needs no network; everything it shows is inside "
         "it.</footer>\n</main>\n</body>\n</html>\n";
}

}  // namespace host
