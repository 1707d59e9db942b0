// The upper half of report.html: what was done, and what it looks like.
#include <fmt/core.h>

#include "report/report_sections.hpp"
#include "report/text.hpp"

namespace host {
namespace {

std::string tile(const std::string& number, const std::string& what, const std::string& who) {
  return fmt::format("<div class=\"tile\"><span>{}</span><b>{}</b><em>{}</em></div>\n", what,
                     number, escape_markup(who));
}

/// The method (not the reference) with the smallest value, or null.
template <class Value>
const MethodResult* least(const BakeReport& report, Value&& value) {
  const MethodResult* best = nullptr;
  for (const MethodResult& method : report.methods)
    if (!method.reference && value(method) && (!best || *value(method) < *value(*best)))
      best = &method;
  return best;
}

std::string tiles(const BakeReport& report) {
  std::string out;
  if (const auto* m = least(report, [](const MethodResult& r) { return r.errors.b_rms; }))
    out += tile(percent(*m->errors.b_rms), "Closest to the exact light (rms)", m->label());
  if (const auto* m = least(report, [](const MethodResult& r) { return r.m0_instructions; }))
    out += tile(metric(*m->m0_instructions), "Fewest Cortex-M0 instructions", m->label());
  else if (const auto* fastest = least(report, [](const MethodResult& r) { return r.seconds; }))
    out += tile(metric(*fastest->seconds) + "s", "Fastest solve on this host", fastest->label());
  if (const auto* m = least(report, [](const MethodResult& r) { return r.ram_bytes; }))
    out += tile(bytes_text(*m->ram_bytes), "Least RAM", m->label());
  std::size_t audited = 0, exact = 0;
  for (const MethodResult& method : report.methods)
    if (method.audit) ++audited, exact += method.audit->exact();
  if (audited > 0)
    out += tile(exact == audited ? "exact" : fmt::format("{} of {}", exact, audited),
                "Energy ledger balances", "emitted = absorbed + unshot + escaped");
  return out.empty() ? out : "<div class=\"tiles\">\n" + out + "</div>\n";
}

std::string image(const std::string& png, const std::string& description) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">",
                     escape_markup(description), base64(png));
}

std::string card_heading(const MethodResult& method) {
  std::string line;
  const auto add = [&line](const std::string& text) { line += (line.empty() ? "" : " · ") + text; };
  if (method.reference) add("the measure of the others");
  if (!method.reference && method.errors.b_rms) add(percent(*method.errors.b_rms) + " rms");
  if (!method.reference && method.errors.b_max) add(percent(*method.errors.b_max) + " worst");
  return fmt::format("<header><h3>{}</h3><p>{}</p></header>\n", escape_markup(method.label()),
                     line);
}

std::string card(const MethodResult& method, bool comparable) {
  const MethodPictures& p = method.pictures;
  const std::string who = method.label();
  std::string out = "<div class=\"card\">" + card_heading(method);
  const bool swap = comparable && !method.reference;
  out += swap ? "<figure class=\"compare\" tabindex=\"0\">" : "<figure>";
  out += image(p.smooth, who + ": the scene with smooth colours") + "</figure>\n";
  if (!p.difference.empty()) {
    out += "<figure>" + image(p.difference, who + ": difference from the exact picture");
    if (p.difference_scale > 0) {
      const std::string scale = fmt::format("{:g} %", 100 * p.difference_scale);
      out += fmt::format("<figcaption class=\"scale\">−{}<i></i>+{}</figcaption></figure>\n", scale,
                         scale);
    } else {
      out += "<figcaption>no difference in any pixel</figcaption></figure>\n";
    }
    out += "<details><summary>By channel, and flat</summary><div class=\"channels\">";
    static constexpr const char* kNames[] = {"red", "green", "blue"};
    for (std::size_t k = 0; k < 3; ++k)
      out += "<figure>" + image(p.channel_difference[k], who + ": difference in " + kNames[k]) +
             "<figcaption>" + kNames[k] + "</figcaption></figure>";
    out += "</div>" + image(p.flat, who + ": one colour a patch") + "</details>";
  } else if (!p.flat.empty()) {
    out += "<figure>" + image(p.flat, who + ": one colour a patch") +
           "<figcaption>one colour a patch, as solved</figcaption></figure>";
  }
  return out + "</div>\n";
}

}  // namespace

std::string summary_html(const BakeReport& report) {
  std::string line;
  for (const Fact& fact : report.facts)
    line += fmt::format("{}{} {}", line.empty() ? "" : " · ", escape_markup(fact.name),
                        "<b>" + escape_markup(fact.value) + "</b>");
  std::string out;
  if (!line.empty()) out += "<p class=\"lead soft\">" + line + "</p>\n";
  if (!report.command.empty()) out += "<pre>" + escape_markup(report.command) + "</pre>\n";
  return out + tiles(report);
}

std::string pictures_html(const BakeReport& report) {
  const MethodResult* exact = report.reference();
  const bool comparable = exact && !exact->pictures.smooth.empty();
  std::string cards;
  for (const MethodResult& method : report.methods)
    if (!method.pictures.smooth.empty()) cards += card(method, comparable);
  if (cards.empty()) return {};
  std::string out = "<h2>Pictures</h2>\n<p class=\"sub\">The same exposure for all. ";
  if (comparable)
    out +=
        "Point at a method to see the exact picture in its place. Below each: its difference from "
        "the exact one, "
        "channel by channel; mid-grey means no error, white too bright, black too dark, at the "
        "scale written "
        "there (per cent of white).";
  return out + "</p>\n<div class=\"pictures\">\n" + cards + "</div>\n";
}

}  // namespace host
