#include "accuracy/document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "accuracy/bounds.hpp"
#include "report/text.hpp"

namespace host {

namespace {

using Cells = std::vector<std::string>;

std::string line(const Cells& cells) { return fmt::format("| {} |\n", fmt::join(cells, " | ")); }

/// Head and rule; numbers to the right.
std::string head(const Cells& cells, std::size_t left) {
  std::string rule = "|";
  for (std::size_t k = 0; k < cells.size(); ++k) rule += k < left ? " --- |" : " ---: |";
  return line(cells) + rule + "\n";
}

std::string number(double x) { return fmt::format("{:.2g}", x); }

std::string yes(const std::optional<bool>& met) { return !met ? "-" : *met ? "yes" : "**no**"; }

std::string promises(const AccuracyResults& results) {
  std::string text = head({"what", "bound", "measured", "met"}, 4);
  for (const Bound& bound : bounds(results))
    text += line({bound.what, bound.bound, bound.measured, yes(bound.met)});
  return text;
}

std::string scene_nets(const AccuracyResults& results) {
  std::string text = head(
      {"scene", "seed", "std", "worst row", "std, 80 % trained on", "std, 20 % held out", "B rms"},
      1);
  const auto add = [&](const char* scene, const SceneNetTrial& t) {
    text +=
        line({scene, std::to_string(t.seed), number(t.factors.std), percent(t.factors.row_worst),
              number(t.train_std), number(t.held_out_std), percent(t.light)});
  };
  for (const SceneNetTrial& trial : results.cube7) add("cube7", trial);
  for (const CornellTrial& trial : results.cornell) add("cornell", trial.net);
  return text;
}

std::string cornell_light(const AccuracyResults& results) {
  std::string text = head({"network of seed", "B rms by hybrid:64"}, 0);
  for (const CornellTrial& trial : results.cornell)
    text += line({std::to_string(trial.net.seed), percent(trial.light)});
  return text + line({"general", percent(results.cornell_general)});
}

std::string general_nets(const AccuracyResults& results) {
  std::string text =
      head({"general network", "cube7: std", "worst row", "median", "p99",
            "random pairs: median, trained on", "held out", "p99, trained on", "held out"},
           1);
  for (const GeneralTrial& t : results.general) {
    Cells cells{t.origin, number(t.cube7.std), t.cube7.rows ? percent(t.cube7.rows->worst) : "",
                number(t.cube7.median), number(t.cube7.p99)};
    for (const auto value : {&ErrorRow::median, &ErrorRow::p99})
      for (const auto* row : {&t.train, &t.held_out})
        cells.push_back(*row ? number((**row).*value) : "");
    text += line(cells);
  }
  return text;
}

std::string method_table(const std::vector<MethodRow>& rows) {
  const bool sums = !rows.empty() && rows.front().errors.rows.has_value();
  Cells titles{"method", "ns", "median", "p95", "p99", "max", "RMS", "std", "bias"};
  if (sums) titles.push_back("worst row");
  std::string text = head(titles, 1);
  for (const MethodRow& row : rows) {
    const ErrorRow& e = row.errors;
    Cells cells{row.label, fmt::format("{:.0f}", row.ns)};
    if (row.label == "reference") {
      cells.resize(titles.size(), "truth");
    } else {
      for (const double x : {e.median, e.p95, e.p99, e.max, rms(e), e.std, e.bias})
        cells.push_back(number(x));
      if (sums) cells.push_back(percent(e.rows->worst));
    }
    text += line(cells);
  }
  return text;
}

std::string cube_methods(const AccuracyResults& results) {
  std::vector<MethodRow> rows;
  for (const SceneMethodRow& row : results.cube7_methods) rows.push_back(row.row);
  return method_table(rows);
}

/// Where the error is: computed, in words.
std::string concentration(const AccuracyResults& results) {
  const auto& table = results.cube7_methods;
  const auto part = [&](const char* label, PairKind kind) {
    return error_share(row_of(table, label).table, kind);
  };
  Cells shares;
  for (const char* label : {"fixed-kernel", "fixed-moment", "lambert:1", "hemicube:64",
                            "net, general", "net, of cube7"})
    shares.push_back(
        fmt::format("{:.1f} % for {}", 100 * part(label, PairKind::edge).share, label));
  const ErrorShare corner = part("fixed-moment", PairKind::corner);
  return fmt::format(
      "Errors concentrate in pairs that share an edge: {} of the {} pairs hold this much of the "
      "sum of squared "
      "errors: {}. For fixed-moment, the {} pairs that touch in a corner hold another {:.1f} %.\n",
      part("fixed-moment", PairKind::edge).pairs, table.front().row.errors.pairs,
      fmt::join(shares, ", "), corner.pairs, 100 * corner.share);
}

std::string hostile_table(const AccuracyResults& results) {
  std::string text = head({"family", "pairs", "not finite", "negative", "above 1", "asymmetry"}, 1);
  const auto add = [&](const std::string& name, const HostileCheck& c) {
    text += line({name, std::to_string(c.draws), std::to_string(c.not_finite),
                  std::to_string(c.negative), std::to_string(c.above_one),
                  fmt::format("{:.1e}", c.asymmetry)});
  };
  for (const HostileCheck& check : results.hostile) add(check.name, check);
  add("these and free quads, scales 1e-12, 1e-9 ... 1e12", results.scales.counts);
  return text;
}

std::string closed_form_table(const AccuracyResults& results) {
  std::string text =
      head({"pairs", "number", "refused", "worst difference", "largest bound", "beyond bounds"}, 1);
  for (const ClosedFormCheck& c : results.closed_form)
    text += line({c.name, std::to_string(c.pairs), std::to_string(c.refused),
                  fmt::format("{:.1e}", c.worst), fmt::format("{:.1e}", c.largest_bound),
                  std::to_string(c.understated)});
  return text;
}

std::string occluded_table(const AccuracyResults& results) {
  std::string text =
      head({"case", "F", "hybrid:64, 4 x 4 pieces", "rays:256", "rays:256, 4 x 4 pieces"}, 1);
  for (const auto* checks : {&results.squares, &results.l_room})
    for (const OccludedCheck& c : *checks)
      text += line({c.name, fmt::format("{:.7f}", c.f), fmt::format("{:.5f}", c.hybrid),
                    fmt::format("{:.5f}", c.rays), fmt::format("{:.5f}", c.rays_cut)});
  return text;
}

}  // namespace

std::string accuracy_document(const AccuracyResults& results) {
  const AccuracyRequest& request = results.request;
  const std::string generals =
      request.general_seeds.empty()
          ? "the general network is the shipped one"
          : fmt::format("general networks from seeds {}", fmt::join(request.general_seeds, ", "));
  std::string text = fmt::format(
      "# Accuracy\n\nWritten by `./run accuracy`, which runs `{}`: it trains the networks afresh, "
      "measures, and copies no number "
      "from anywhere else. Scene networks from seeds {}; {}; random pairs from seed {}. Networks, "
      "kernels (fixed-), hemicubes, "
      "rays and light are the engine's integers, the same on every target.\n\n",
      request.command, fmt::join(request.seeds, ", "), generals, request.pair_seed);
  text +=
      "## What was promised\n\nThe worst of the seeds where a network is involved. B rms: relative "
      "rms error of the "
      "radiosity that is reflected, all patches and channels, against the exact solution in "
      "double.\n\n" +
      promises(results);
  text += fmt::format(
      "\nFor the cube of the 1996 report, with all 86,436 pairs, the same ones of a wall included, "
      "its network had a std of 5.3e-3 "
      "and a mean row error of 12 %.\n\n## Networks, seed by seed\n\nTrained for one scene, H = "
      "{}: `urad train --scene SCENE --hidden {} "
      "--seed SEED`. std: of F - exact over all pairs in different planes; in the Cornell box with "
      "what stands between, by rays, so "
      "that the rays' error counts. The last two std are those of a second net, trained on 80 % of "
      "the configurations, without "
      "occlusion.\n\n",
      request.scene_hidden, request.scene_hidden);
  text += scene_nets(results) + "\nThe Cornell box by hybrid:\n\n" + cornell_light(results);
  text += fmt::format(
              "\nFor any scene, H = {}: `urad train --general --hidden {} --seed SEED`; cube7 is "
              "not among its pairs.\n\n",
              request.general_hidden, request.general_hidden) +
          general_nets(results);
  text +=
      "\n## Methods\n\nMedian, p95, p99 and max are of |F - exact| / exact; RMS, std and bias are "
      "of F - exact. ns: host time "
      "for one F on one core, in this run, of the fastest pass; compare rows, not machines. "
      "Methods in double start from the "
      "vertices; those of the engine (hemicube, fixed-, net, legacy) from a scene as it stands in "
      "flash. legacy is the 1996 report's network: it reads the box of the scene, here of the "
      "pair, "
      "as its unit cube.\n\n### cube7, all off-wall "
      "pairs\n\nThe hemicube serves 245 receivers with one pass.\n\n" +
      cube_methods(results) + "\n" + concentration(results);
  text +=
      "\n### Free quads\n\nRandom walks in random planes of the unit cube [Martin 1996, 3.2], each "
      "wholly in front of the "
      "other's plane. The network of cube7 was not made for them. The hemicube has one receiver "
      "here.\n";
  for (const MethodTable& table : results.free_quads)
    text += "\n" + table.title + ":\n\n" + method_table(table.rows);
  text +=
      "\n### Room pairs\n\nPatches of adjoining and opposite walls, free sides, angles and "
      "meshes. " +
      results.rooms.title + ":\n\n" + method_table(results.rooms.rows);
  text +=
      "\n### Kinds of pairs\n\nWalls that touch, slivers, cut and tiny patches, by decade of F and "
      "by "
      "kind, with every method's cost: [METHODS.md](METHODS.md).\n";
  text += "\n## Occlusion\n\n" + occluded_table(results);
  text +=
      "\n## Hostile input to the reference\n\nAsymmetry: largest |A_p F_pq - A_q F_qp| over the "
      "smaller area.\n\n" +
      hostile_table(results);
  text +=
      "\n## The closed form against the reference\n\nDifferences of F where `closed-form` answers, "
      "the largest error it admits with an answer, and how many answers lie further from the "
      "reference than both admit.\n\n" +
      closed_form_table(results);
  return text;
}

}  // namespace host
