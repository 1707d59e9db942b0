// docs/ACCURACY.md and docs/METHODS.md as text: each promise is met or not by its own numbers alone,
// every row stands where it belongs, and nothing is said of what was not measured.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "accuracy/bounds.hpp"
#include "accuracy/document.hpp"
#include "accuracy/method_document.hpp"
#include "accuracy/method_plots.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "network/pair_kind.hpp"
#include "network_file.hpp"
#include "report/instructions.hpp"

namespace {

using host::AccuracyResults;

host::ErrorRow errors(const std::string& name, std::size_t pairs, double size) {
  host::ErrorRow row;
  row.name = name, row.pairs = pairs;
  row.median = size, row.p95 = 3 * size, row.p99 = 5 * size, row.max = 9 * size;
  row.std = size / 10, row.bias = size / 100;
  return row;
}

host::MethodTrialTable trials(const std::string& title, double scale) {
  return {title,
          {{"auto", 500, 5e-4 * scale, 5e-3, 0.01, 0.018, 1e-5, 300, 900, 12345,
            host::EstimateRow{0.005, 4, 40}},
           {"gauss:2", 500, 1e-3, 2e-2, 0.03, 0.2, -1e-4, 700, {}, {}, {}}}};
}

/// Every promise met.
AccuracyResults good() {
  AccuracyResults r;
  r.request.command = "urad accuracy --seeds 1,2";
  r.request.seeds = {1, 2};
  r.known = {31, 1e-13, 0.5, "two squares"};
  r.cube_rows = {1e-14, 0.200043776075403, 6.08e-5};
  r.hostile = {{"slivers", 100, 0, 0, 0, 1e-12}, {"needles", 50, 0, 0, 1, 1e-11}};
  r.scales.counts.draws = 70;
  r.closed_form = {{"free quads", true, 1000, 3, 0, 1e-12, 1e-11},
                   {"slivers", false, 100, 40, 0, 1e-11, 1e-10},
                   {"cube7", false, 86436, 0, 0, 1e-14, 1e-12}};
  r.squares = {{"corner", 0.15, 0.151, 0.1501, 0.1499}};
  r.l_room = {{"1-2", 0.11, 0.109, 0.1102, 0.11}, {"2-1", 0.33, 0.331, 0.33, 0.331}};
  for (const std::uint64_t seed : {1u, 2u}) {
    host::SceneNetTrial net{seed, test::network_file(4), {}};
    net.factors.std = 1e-5 * double(seed), net.factors.row_worst = 1e-3;
    net.factors.pairs = 72030, net.light = 1e-3, net.held_out_std = 2e-5, net.train_std = 1e-5;
    r.cube7.push_back(net);
    r.cornell.push_back({net, 0.02});
    r.chip.push_back({250, 240, 0.008, 9000, 400});
    r.near_hybrid.push_back(0.005);
  }
  r.cornell_general = 0.025;
  host::GeneralTrial general{"shipped", errors("all", 72030, 1e-3), {}, {}, {}, {}, 0.006};
  general.cube7.rows.emplace();
  r.general = {general};
  r.hemicube = {{}, 294, 294};
  r.hemicube.factors.std = 6e-4;
  for (const char* label : {"fixed-kernel", "fixed-moment", "lambert:1", "hemicube:64",
                            "net, general", "net, of cube7", "reference"}) {
    host::SceneMethodRow row{{label, errors("all", 72030, 0.02), 50}, {}};
    row.row.errors.rows.emplace();
    row.table = {errors("all", 72030, 0.02),
                 errors(std::string(host::name(host::PairKind::edge)), 588, 0.1)};
    r.cube7_methods.push_back(row);
  }
  r.free_quads = {{"F >= 0.1", {{"lambert:1", errors("all", 9, 1e-3), 40}}}};
  r.rooms = {"5000 pairs", {{"lambert:1", errors("all", 9, 1e-3), 40}}};
  for (const char* family : {"convex quads", "concave quads", "rooms", "shared edge", "slivers"})
    r.trials.families.push_back(trials(std::string(family) + " (500 pairs), F", 1));
  r.auto_light = 1e-4, r.auto_light_max = 1e-3;
  return r;
}

std::vector<std::size_t> broken(const AccuracyResults& results) {
  const std::vector<host::Bound> all = host::bounds(results);
  std::vector<std::size_t> wrong;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].met == false) wrong.push_back(k);
  return wrong;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("each promise is broken by its own numbers, and by no others") {
  const AccuracyResults fine = good();
  CHECK(broken(fine).empty());
  const std::vector<host::Bound> all = host::bounds(fine);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Damage {
    const char* promise;  // how its line begins
    std::function<void(AccuracyResults&)> make;
  };
  const std::vector<Damage> damages{
      {"reference, 31 ", [](auto& r) { r.known.of_bound = 1.01; }},
      {"reference, rows", [](auto& r) { r.cube_rows.worst = 1e-11; }},
      {"reference, rows", [](auto& r) { r.cube_rows.largest = 0.2001; }},
      {"reference, rows", [](auto& r) { r.cube_rows.smallest = 6.2e-5; }},
      {"reference, 2 degenerate", [](auto& r) { r.hostile[1].negative = 1; }},
      {"reference, 2 degenerate", [](auto& r) { r.hostile[0].not_finite = 1; }},
      {"reference, scales", [](auto& r) { r.scales.counts.not_finite = 1; }},
      {"closed form", [](auto& r) { r.closed_form[1].worst = 1e-8; }},
      {"closed form", [](auto& r) { r.closed_form[0].refused = 11; }},
      {"closed form", [](auto& r) { r.closed_form[2].refused = 1; }},
      {"square obstruction, in a corner and in the middle, hybrid",
       [](auto& r) { r.squares[0].hybrid = 0.17; }},
      {"L-room, 2 factors, rays:256 with", [](auto& r) { r.l_room[1].rays_cut = 0.325; }},
      {"L-room, 2 factors, rays:256", [](auto& r) { r.l_room[0].rays = 0.1; }},
      {"cube7, network trained", [](auto& r) { r.cube7[1].factors.std = 4e-5; }},
      {"the same, worst row", [](auto& r) { r.cube7[0].factors.row_worst = 0.004; }},
      {"cube7, general", [](auto& r) { r.general[0].cube7.std = 7e-4; }},
      {"cube7, general", [](auto& r) { r.cube7_methods[1].row.errors.std = 9e-5; }},
      {"cube7, hemicube", [](auto& r) { r.hemicube.factors.std = 9e-4; }},
      {"cube7, hemicube", [](auto& r) { r.hemicube.exact_rows = 293; }},
      {"auto, free quads", [](auto& r) { r.trials.families[2].rows[0].median = 2e-3; }},
      {"auto, free quads", [](auto& r) { r.trials.families[0].rows[0].p99 = 0.04; }},
      {"auto, free quads", [](auto& r) { r.trials.families[1].rows[0].max = 0.2; }},
      {"auto, walls", [](auto& r) { r.trials.families[3].rows[0].max = 0.03; }},
      {"auto, its estimate", [](auto& r) { r.trials.families[4].rows[0].estimate->missed = 0.1; }},
      {"radiosity of cube7 by auto", [](auto& r) { r.auto_light = 6e-4; }},
      {"radiosity of cube7 by auto", [](auto& r) { r.auto_light_max = 3e-3; }},
      {"radiosity of cube7 by network", [](auto& r) { r.cube7[1].light = 0.004; }},
      {"radiosity of cube7 by hemicube", [](auto& r) { r.near_hybrid[1] = 0.02; }},
      {"the same by a general", [](auto& r) { r.general[0].near_hybrid = 0.02; }},
      {"Cornell box", [](auto& r) { r.cornell[0].light = 0.04; }},
      {"Cornell box", [](auto& r) { r.cornell_general = 0.04; }},
      {"cube7 on the micro:bit", [](auto& r) { r.chip[1].light = 0.011; }},
      {"the same, memory", [](auto& r) { r.chip[0].ram_bytes = 16 * 1024 + 1; }},
      {"closed form",
       [=](auto& r) { r.closed_form[0].worst = nan, r.closed_form[0].refused = 99; }},
  };
  for (const Damage& damage : damages) {
    AccuracyResults results = good();
    damage.make(results);
    CAPTURE(damage.promise);
    const std::vector<std::size_t> wrong = broken(results);
    REQUIRE(wrong.size() == 1);
    CHECK(all[wrong[0]].what.rfind(damage.promise, 0) == 0);
    CHECK(count(host::accuracy_document(results), "**no**") == 1);
  }
}

TEST_CASE("what 8 bits cost is promised where it was measured, and instructions where counted") {
  AccuracyResults results = good();
  const std::size_t lines = host::bounds(results).size();
  results.general[0].int16 = errors("all", 9, 1e-3);
  results.general[0].int8 = errors("all", 9, 1.02e-3);
  CHECK(host::bounds(results).size() == lines + 1);
  CHECK(broken(results).empty());
  results.general[0].int8->p99 *= 1.05;
  CHECK(broken(results).size() == 1);
  CHECK(host::bounds(results).back().met == std::nullopt);
  results.solve_instructions = 1234567;
  CHECK(host::bounds(results).back().measured == "1,234,567 to 1 %");
  results.shot_instructions = 5000, results.pair_instructions = 999;
  CHECK(host::bounds(results).back().measured == "1,234,567 to 1 %, 5,000 a shot, 999 a pair");
  CHECK_THROWS_AS(host::row_of(results.cube7_methods, "nobody"), std::out_of_range);
}

TEST_CASE("the document of accuracy has a row for every seed, method, family and case") {
  AccuracyResults results = good();
  const std::string text = host::accuracy_document(results);
  CHECK(count(text, "**no**") == 0);
  CHECK(count(text, "\n| cube7 | 1 | 1e-05 |") == 1);
  CHECK(count(text, "\n| cube7 | 2 | 2e-05 |") == 1);
  CHECK(count(text, "\n| cornell | 2 | 2e-05 |") == 1);
  CHECK(count(text, "\n| needles | 50 | 0 | 0 | 1 | 1.0e-11 |") == 1);
  CHECK(count(text, "\n| free quads | 1000 | 3 | 1.0e-12 | 1.0e-11 | 0 |") == 1);
  CHECK(count(text, "\n| 2-1 | 0.3300000 | 0.33100 | 0.33000 | 0.33100 |") == 1);
  CHECK(count(text, "\n| reference | 50 | truth | truth |") == 1);
  CHECK(count(text, "the general network is the shipped one") == 1);
  CHECK(count(text, "588 of the 72030 pairs") == 1);
  results.request.general_seeds = {7, 8};
  results.general[0].train = errors("all", 9, 1e-3),
  results.general[0].held_out = errors("all", 9, 2e-3);
  const std::string seeded = host::accuracy_document(results);
  CHECK(count(seeded, "general networks from seeds 7, 8") == 1);
  CHECK(count(seeded, "| 0.001 | 0.002 | 0.005 | 0.01 |") == 1);
}

TEST_CASE("methods: who is dominated stands on no front, and what was not counted is not drawn") {
  host::MethodTrials all;
  all.families = {trials("convex <quads> (500 pairs), F", 1), trials("slivers (500 pairs), F", 4)};
  all.decades = {trials("F < 1e-5", 1)};
  const std::string fronts = host::front_table(all);
  CHECK(count(fronts, "| auto | convex <quads>; slivers | convex <quads>; slivers |") == 1);
  CHECK(count(fronts, "| gauss:2 | none | - |") == 1);
  all.families[1].rows[1].ns = 20;  // quicker there, if less accurate
  CHECK(count(host::front_table(all), "| gauss:2 | slivers | - |") == 1);
  CHECK(host::front_table({}).empty());

  const std::string by_time = host::method_plots_svg(all, host::MethodCost::host_ns);
  CHECK(count(by_time, "convex &lt;quads&gt; (500 pairs), F</text>") == 1);
  CHECK(count(by_time, "gauss:2") > 0);
  const std::string by_count = host::method_plots_svg(all, host::MethodCost::m0_instructions);
  CHECK(count(by_count, "gauss:2") == 0);
  CHECK(count(by_count, "auto") > 0);
  for (auto& family : all.families)
    for (auto& row : family.rows) row.instructions.reset();
  CHECK(host::method_plots_svg(all, host::MethodCost::m0_instructions).empty());

  all.families[0].rows[0].estimate = host::EstimateRow{0.02, 6, 60};
  all.ways = {"| slivers | auto | 1 | 2 | 3 | 4 | 5 | 85 |"};
  const std::string text = host::method_document(all, {"urad evaluate", "time.svg", ""});
  CHECK(count(text, "(time.svg)") == 1);
  CHECK(count(text, "](") == 2);  // the picture and ACCURACY.md
  CHECK(count(text, "| auto | 98.00 % | **no** | 6 | **no** | 60 | **no** |") == 1);
  CHECK(count(text, "| auto | 99.50 % | yes | 4 | yes | 40 | yes |") == 2);
  CHECK(count(text, "| gauss:2 | 0.001 | 0.02 | 0.03 | 0.2 | -0.0001 | 20 | - | - | - | - |") == 1);
  CHECK(count(text, "| M0 instructions |") == 1);  // of the decade alone
  CHECK(count(text, "| slivers | auto | 1 | 2 | 3 | 4 | 5 | 85 |") == 1);
  all.ways.clear();
  CHECK(count(host::to_markdown(all), "Ways that auto took") == 0);
}

TEST_CASE("counted instructions: of the methods that were counted, from a file that holds them") {
  const std::string path = std::string(URAD_SCRATCH_DIR) + "/icount_test.json";
  host::write_file_atomically(
      path, R"({"microbit": {"pair_network": {"mean": 5100.5}, "pair_point": {"mean": 700},
               "shot_table": {"mean": 60000}, "shot_hemicube_64": {"mean": 9e6}}})");
  const host::InstructionCounts counts(path);
  CHECK(counts.per_pair("net") == 5100.5);
  CHECK(counts.per_point() == 700);
  CHECK(counts.per_shot("table") == 60000);
  CHECK(counts.per_shot("hemicube:64") == 9e6);
  CHECK(counts.per_pair("auto") == std::nullopt);     // known, not counted
  CHECK(counts.per_pair("gauss:2") == std::nullopt);  // no such thing on a chip
  CHECK(counts.per_shot("hemicube:7") == std::nullopt);
  for (const char* wrong : {"", "[1, 2]", "{\"lm3s6965evb\": {}}", "{\"microbit\": "}) {
    host::write_file_atomically(path, wrong);
    CHECK_THROWS_WITH_AS(host::InstructionCounts{path}, doctest::Contains("icount_test.json"),
                         host::Error);
  }
  std::filesystem::remove(path);
  CHECK_THROWS_AS(host::InstructionCounts{path}, host::Error);
}
