#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "accuracy/network_trials.hpp"

namespace host {

namespace {

using Statistic = std::function<double(const NetworkErrors&)>;

struct Named {
  const char* name;
  Statistic of;
};

const std::vector<Named>& statistics() {
  static const std::vector<Named> all = {
      {"pairs: median", [](const NetworkErrors& e) { return e.pairs.median; }},
      {"pairs: p95", [](const NetworkErrors& e) { return e.pairs.p95; }},
      {"pairs: p99", [](const NetworkErrors& e) { return e.pairs.p99; }},
      {"pairs: std", [](const NetworkErrors& e) { return e.pairs.std; }},
      {"cube7: median", [](const NetworkErrors& e) { return e.cube.median; }},
      {"cube7: p99", [](const NetworkErrors& e) { return e.cube.p99; }},
      {"cube7: std", [](const NetworkErrors& e) { return e.cube.std; }},
      {"cube7: std, no edge in common", [](const NetworkErrors& e) { return e.cube_apart_std; }},
      {"cube7: worst row", [](const NetworkErrors& e) { return e.cube.rows->worst; }},
  };
  return all;
}

using Width = std::vector<const NetworkTrial*>;

/// Seeds of one width, least statistic first.
std::vector<double> sorted(const Width& seeds,
                           const std::function<double(const NetworkTrial&)>& of) {
  std::vector<double> values;
  for (const NetworkTrial* trial : seeds) values.push_back(of(*trial));
  std::sort(values.begin(), values.end());
  return values;
}

std::string errors_table(const std::map<int, Width>& widths) {
  std::string text = "| hidden | bytes of int16, int8 | seeds |";
  for (const Named& s : statistics()) text += fmt::format(" {} |", s.name);
  text += "\n| ---: | ---: | ---: |";
  for (std::size_t k = 0; k < statistics().size(); ++k) text += " ---: |";
  for (const auto& [hidden, seeds] : widths) {
    text +=
        fmt::format("\n| {} | {}, {} | {} |", hidden, seeds.front()->net.quantised16.flash_bytes(),
                    seeds.front()->net.quantised8.flash_bytes(), seeds.size());
    for (const Named& s : statistics()) {
      const auto values = sorted(seeds, [&](const NetworkTrial& t) { return s.of(t.int16); });
      text += fmt::format(" {:.2g} .. {:.2g} |", values.front(), values.back());
    }
  }
  return text + "\n";
}

std::string loss_table(const std::map<int, Width>& widths) {
  std::string text = "| hidden | form |";
  for (const Named& s : statistics()) text += fmt::format(" {} |", s.name);
  text += "\n| ---: | --- |";
  for (std::size_t k = 0; k < statistics().size(); ++k) text += " ---: |";
  for (const auto& [hidden, seeds] : widths)
    for (const bool narrow : {false, true}) {
      text += fmt::format("\n| {} | {} |", hidden, narrow ? "int8" : "int16");
      for (const Named& s : statistics()) {
        const auto values = sorted(seeds, [&](const NetworkTrial& t) {
          return 100 * (s.of(narrow ? t.int8 : t.int16) / s.of(t.real) - 1);
        });
        text += fmt::format(" {:+.1f} %, {:+.1f} % |", values[values.size() / 2], values.back());
      }
    }
  return text + "\n";
}

/// No other method has 95 % of the pairs closer for as few multiply-adds.
bool on_front(const MethodTrialTable& table, const MethodTrialRow& row) {
  return std::none_of(table.rows.begin(), table.rows.end(), [&](const MethodTrialRow& other) {
    return &other != &row && *other.multiply_adds <= *row.multiply_adds && other.p95 <= row.p95 &&
           (*other.multiply_adds < *row.multiply_adds || other.p95 < row.p95);
  });
}

/// "random quads, convex, 500 pairs" without number and remarks.
std::string kind_of(const std::string& title) {
  return title.substr(0, std::min(title.find(" ("), title.rfind(',')));
}

std::string fronts_table(const MethodTrials& fronts) {
  std::string text =
      "| method | on the front of | multiply-adds, convex quads | 95 % off by less than | two "
      "walls "
      "of a room | 95 % off by less than |\n| --- | --- | ---: | ---: | ---: | ---: |";
  const MethodTrialTable& quads = fronts.families[0];
  const MethodTrialTable& rooms = fronts.families[2];
  for (std::size_t m = 0; m < quads.rows.size(); ++m) {
    std::string names;
    for (const MethodTrialTable& table : fronts.families)
      if (on_front(table, table.rows[m]))
        names += (names.empty() ? "" : "; ") + kind_of(table.title);
    text += fmt::format("\n| {} | {} | {:.0f} | {:.2g} | {:.0f} | {:.2g} |", quads.rows[m].label,
                        names.empty() ? "none" : names, *quads.rows[m].multiply_adds,
                        quads.rows[m].p95, *rooms.rows[m].multiply_adds, rooms.rows[m].p95);
  }
  return text + "\n";
}

}  // namespace

std::string network_document(const std::vector<NetworkTrial>& trials, const MethodTrials& fronts,
                             const std::vector<TrainingTrial>& optimisers,
                             const std::vector<TrainingTrial>& inputs, const std::string& command) {
  std::map<int, Width> widths;
  for (const NetworkTrial& trial : trials) widths[trial.net.net.hidden()].push_back(&trial);
  return fmt::format(
      R"(# General networks, by width

Written by `{}`, which trains every network afresh. Errors of `urad train --general`: least and greatest of the seeds.
pairs: random pairs of six families that no network has seen, |F - exact| / exact, those included that are handed over to the
exact sum (rho above 0.3, cut); std is of F - exact. cube7 is among nobody's pairs.

## Errors, int16

{}
## What integers cost

The same statistic of the integers by that of the network in double, less 1: the median of the seeds and the worst. int8:
hidden weights of 8 bits, a scale a neuron; as each is rounded, the rest learns to say what the network in double says, and
then all walk by whole steps to where that is said best.

{}
## Who stands on a front

Of each width the best network of all seeds (p95 of pairs), by itself and handing near and cut pairs over, on {} test pairs of
each family of [METHODS.md](METHODS.md). On a front: no other method has 95 % of the pairs closer for as few multiply-adds.
What stands on none is not shipped as a method of its own.

{}
## Other ways to train

Eight hidden neurons, {} seeds; one random start each, the same for all. Losses are roots of the robust loss in units of log2, of
pairs trained on and of others; the state that is best on the others counts. L-BFGS is NLopt's, on all pairs at once; Adam takes
batches of a 32nd, its step falling to zero along a cosine.

{}
## Whether every input is needed

The same by Levenberg-Marquardt with one input at a time held at 0.

{})",
      command, errors_table(widths), loss_table(widths),
      fronts.families.empty() ? 0 : fronts.families.front().rows.front().pairs,
      fronts_table(fronts), optimisers.front().validation.size(), training_table(optimisers),
      training_table(inputs));
}

}  // namespace host
