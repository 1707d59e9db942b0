#include "accuracy/method_document.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "accuracy/method_plots.hpp"

namespace host {

namespace {

constexpr double kCovered = 0.99, kUsefulMedian = 5, kUsefulP90 = 50;

const char* yes(bool met) { return met ? "yes" : "**no**"; }

/// What auto says of its error, a line a kind and a decade, for every setting of it.
std::string estimate_table(const MethodTrials& trials) {
  std::string text =
      "| pairs | method | estimate holds | 99 % | estimate / error, median | at most 5 | p90 | at "
      "most 50 |\n| --- | --- | ---: | --- | ---: | --- | ---: | --- |\n";
  for (const auto* tables : {&trials.families, &trials.decades})
    for (const MethodTrialTable& table : *tables)
      for (const MethodTrialRow& row : table.rows) {
        if (!row.estimate) continue;
        const EstimateRow& e = *row.estimate;
        text +=
            fmt::format("| {} | {} | {:.2f} % | {} | {:.2g} | {} | {:.2g} | {} |\n", table.title,
                        row.label, 100 - 100 * e.missed, yes(1 - e.missed >= kCovered), e.median,
                        yes(e.median <= kUsefulMedian), e.p90, yes(e.p90 <= kUsefulP90));
      }
  return text;
}

}  // namespace

std::string method_document(const MethodTrials& trials, const MethodDocument& document) {
  std::string text = fmt::format(
      R"(# Methods, by kind of pair

Written by `{}`:
every method on the same pairs, in one run, against the reference. Free quads with their decades of F in equal parts, rooms,
and what makes form factors go wrong. Median, p95, p99 and max are of |F - exact| / exact, bias is the mean of (F - exact) /
exact. ns: processor time of a pair on this host; compare rows, not machines. MAC: multiply-adds of one pair, counted in the
formulas. The engine's methods (fixed-, net, auto, legacy) start from a scene as it stands in flash, the others from vertices.
legacy is the report's network: it reads the box of the pair as its unit cube, a triangle as a quad with its last corner
twice, and no pentagons, which are left out of its rows. Hemicubes, which serve all receivers of a scene at once,
stand beside the others on cube7 in [ACCURACY.md](ACCURACY.md). Auto's constants were fitted on other pairs (`urad evaluate
--fit-auto`); its guesses at errors are counted in its cost.
)",
      document.command);
  for (const std::string& chart : {document.time_chart, document.instruction_chart})
    if (!chart.empty())
      text += fmt::format("\n![error against cost of every method, a plot a kind]({})\n", chart);
  text += R"(
## Who stands on a front

No other method has 95 % of the pairs of that kind closer at less cost. What stands on none is recommended nowhere.

)" + front_table(trials) +
          R"(
## What others measured

For the same cube and for pairs made by the same recipe, on another machine.

)" + peer_table();
  const std::string estimates = estimate_table(trials);
  return text + "\n## What auto says of its error\n\n" + estimates + "\n## Tables\n" +
         to_markdown(trials);
}

}  // namespace host
