#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hand_made_scene.hpp"
#include "report/report_html.hpp"
#include "report/svg_plot.hpp"
#include "report/text.hpp"

namespace {

using host::BakeReport;
using host::MethodResult;

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++count;
  return count;
}

/// Whether every element that is opened is closed, in order. `empty` lists elements that have no
/// end.
bool balanced(const std::string& markup, const std::vector<std::string>& empty) {
  std::vector<std::string> open;
  for (std::size_t at = 0; (at = markup.find('<', at)) != std::string::npos;) {
    const std::size_t end = markup.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = markup.substr(at + 1, end - at - 1);
    at = end;
    if (tag.empty() || tag[0] == '!' || tag.back() == '/') continue;
    const std::string name =
        tag.substr(tag[0] == '/', tag.find_first_of(" >", 1) - (tag[0] == '/'));
    if (std::find(empty.begin(), empty.end(), name) != empty.end()) continue;
    if (tag[0] != '/') {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != name) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

MethodResult method(const std::string& name, double rms, double seconds) {
  MethodResult m;
  m.name = name;
  m.errors.b_rms = rms;
  m.seconds = seconds;
  m.m0_instructions = 1e9 * seconds;
  m.counters = urad_counters{};
  m.counters->evaluated = 72030;
  m.counters->skipped_same = 14112;
  m.audit = host::EnergyAudit{{1000, 1000, 1000}, {900, 900, 900}, {60, 60, 60}, {40, 40, 40}};
  m.ram_bytes = 7056;
  return m;
}

BakeReport small_report() {
  BakeReport report;
  report.scene = "cube7";
  report.methods = {method("exact", 0, 3), method("net", 0.0021, 0.03),
                    method("hemicube:32", 0.013, 0.012)};
  report.methods[0].reference = true;
  return report;
}

TEST_CASE("text from outside cannot become markup") {
  CHECK(host::escape_markup("a<b>&\"c\"'d'") == "a&lt;b&gt;&amp;&quot;c&quot;&#39;d&#39;");
  CHECK(host::escape_markup(std::string("x\0y\x1b", 4)) == "x\xEF\xBF\xBDy\xEF\xBF\xBD");
  const std::string evil = "</title><script>alert('&')</script>\"'";
  BakeReport report = small_report();
  report.title = report.scene = report.version = report.command = evil;
  report.facts = report.network = report.files = {{evil, evil}};
  report.reproduce = {evil};
  const host::Scene scene = test::cube(2);
  for (MethodResult& m : report.methods) {
    m.name = m.title = evil;
    m.memory = {{evil, evil}};
    m.B.assign(scene.patches.size(), host::Vec3(m.errors.b_rms.value() + 0.5));
  }
  host::add_pictures(scene, {16, 16, 2, 1}, &report);
  const std::string page = host::report_html({report, report});
  CHECK_FALSE(holds(page, "<script"));
  CHECK(holds(page, "&lt;script&gt;"));
  CHECK(balanced(page, {"meta", "img", "br"}));
}

TEST_CASE("base64 of RFC 4648, section 10") {
  CHECK(host::base64("") == "");
  CHECK(host::base64("f") == "Zg==");
  CHECK(host::base64("fo") == "Zm8=");
  CHECK(host::base64("foo") == "Zm9v");
  CHECK(host::base64("foobar") == "Zm9vYmFy");
  CHECK(host::base64("\xff\xfe\xfd") == "//79");
}

TEST_CASE("numbers for people") {
  CHECK(host::grouped(0) == "0");
  CHECK(host::grouped(999) == "999");
  CHECK(host::grouped(1234567) == "1,234,567");
  CHECK(host::grouped(-1234) == "-1,234");
  CHECK(host::grouped(-123) == "-123");
  CHECK(host::metric(0) == "0");
  CHECK(host::metric(789) == "789");
  CHECK(host::metric(12345) == "12.3 k");
  CHECK(host::metric(999.96) == "1.00 k");
  CHECK(host::metric(4.2e-6) == "4.20 µ");
  CHECK(host::metric(1e-30) == "0.00 p");
  CHECK(host::percent(0.0021) == "0.21 %");
  CHECK(host::percent(0.12) == "12 %");
  CHECK(host::percent(0.0999) == "10 %");
  CHECK(host::percent(0) == "0 %");
  CHECK(host::percent(3e-9) == "3.0e-07 %");
  CHECK(host::bytes_text(812) == "812 B");
  CHECK(host::bytes_text(16384) == "16.0 KB");
}

TEST_CASE("a plot fills the points of the Pareto front and no others") {
  const std::vector<host::PlotPoint> points{{"cheap", 10, 0.1, 0},
                                            {"good", 100, 0.001, 1},
                                            {"beaten", 200, 0.01, 2},
                                            {"free", 0, 0.1, 3},
                                            {"a<b", 50, 0.05, 4}};
  const std::string svg = host::error_cost_svg(points, {"t", "cost", "s", "error"});
  CHECK(balanced(svg, {}));
  CHECK(occurrences(svg, "<circle") == 4);  // nothing can be drawn at cost 0
  for (const std::size_t k : {0U, 1U, 4U})
    CHECK(holds(svg, std::string("fill=\"") + host::plot_colour(k) + "\""));
  CHECK(holds(svg, std::string("stroke=\"") + host::plot_colour(2) +
                       "\" stroke-width=\"2\" fill=\"none\""));
  CHECK(holds(svg, ">a&lt;b</text>"));
  CHECK_FALSE(holds(svg, ">free</text>"));
  CHECK(host::error_cost_svg({{"none", 0, 0, 0}}, {}).empty());
  CHECK(occurrences(host::error_cost_svg({{"one", 5, 0.1, 0}}, {}), "<circle") == 1);
}

TEST_CASE("points and labels of a plot stay inside it, over ranges narrow and wide") {
  for (const double range : {1.0, 1.01, 3.0, 1e3, 1e12}) {
    std::vector<host::PlotPoint> points;
    points.reserve(9);
    for (int k = 0; k < 9; ++k)
      points.push_back({"method " + std::to_string(k), std::pow(range, k / 8.0),
                        0.5 * std::pow(range, -k / 8.0), std::size_t(k)});
    const std::string svg = host::error_cost_svg(points, {"t", "cost", "", "error"});
    CAPTURE(range);
    CHECK(balanced(svg, {}));
    CHECK(occurrences(svg, "<path class=\"g\"") >= 2);
    for (std::size_t at = 0; (at = svg.find("cx=\"", at)) != std::string::npos; ++at) {
      const double x = std::stod(svg.substr(at + 4));
      CHECK(x > 74);
      CHECK(x < 602);
    }
  }
}

TEST_CASE("the bars of a method share its width by its counters") {
  const std::string svg = host::share_bars_svg(
      {{"net", {{"done", 75, "#111111"}, {"left", 25, "#222222"}}}, {"idle", {{"done", 0, ""}}}},
      "t");
  CHECK(balanced(svg, {}));
  CHECK(holds(svg, "width=\"324.00\" height=\"20\" fill=\"#111111\""));
  CHECK(holds(svg, "width=\"108.00\" height=\"20\" fill=\"#222222\""));
  CHECK_FALSE(holds(svg, ">idle<"));
  CHECK(host::share_bars_svg({{"idle", {{"done", 0, ""}}}}, "t").empty());
}

TEST_CASE("a ledger balances to the unit or not at all") {
  BakeReport report = small_report();
  CHECK(report.methods[1].audit->exact());
  CHECK_FALSE(holds(host::report_html({report}), "off by"));
  report.methods[1].audit->unshot[2] -= 7;
  CHECK_FALSE(report.methods[1].audit->exact());
  const std::string page = host::report_html({report});
  CHECK(holds(page, "off by -7"));
  CHECK(holds(page, "2 of 3"));
}

TEST_CASE("the page is whole: pictures inside, nothing fetched, nothing invented") {
  const host::Scene scene = test::cube(2);
  BakeReport report = small_report();
  for (MethodResult& m : report.methods)
    m.B.assign(scene.patches.size(), host::Vec3(0.5 + m.errors.b_rms.value()));
  host::add_pictures(scene, {16, 16, 2, 1}, &report);
  CHECK(report.methods[0].pictures.difference.empty());
  CHECK(report.methods[1].pictures.difference_scale ==
        doctest::Approx(0.005));  // 0.0021 of white 0.5
  const std::string page = host::report_html({report});
  CHECK(balanced(page, {"meta", "img", "br"}));
  for (const MethodResult& m : report.methods) CHECK(holds(page, host::base64(m.pictures.smooth)));
  CHECK(occurrences(page, "<img") == occurrences(page, "src=\"data:image/png;base64,"));
  CHECK_FALSE(holds(page, "<script"));
  CHECK_FALSE(holds(page, "<link"));
  CHECK(occurrences(page, "http") ==
        occurrences(page, "http://www.w3.org/2000/svg") + 1);  // and http-equiv
  CHECK_FALSE(holds(page, "Row sums off"));                    // nobody measured them
  CHECK(holds(page, "<td class=\"best\">0.21 %</td>"));

  CHECK(balanced(host::report_html({BakeReport{}}), {"meta", "img", "br"}));
  CHECK(balanced(host::report_html({}), {"meta", "img", "br"}));
}

TEST_CASE("report.json holds the same numbers") {
  BakeReport report = small_report();
  report.facts = {{"patches", "294"}};
  report.title = "not UTF-8: \xff";
  const auto json = nlohmann::json::parse(host::report_json({report}));
  CHECK(json["scene"] == "cube7");
  CHECK(json["facts"]["patches"] == "294");
  REQUIRE(json["methods"].size() == 3);
  const auto& net = json["methods"][1];
  CHECK(net["b_rms"] == 0.0021);
  CHECK(net["counters"]["pairs"] == 294 * 293);
  CHECK(net["energy"]["absorbed"][2] == 900);
  CHECK(net["energy"]["exact"] == true);
  CHECK(net["ram_bytes"] == 7056);
  CHECK_FALSE(net.contains("f_std"));
  CHECK(nlohmann::json::parse(host::report_json({report, report}))["scenes"].size() == 2);
}

}  // namespace
