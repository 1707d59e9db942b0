// legacy:NAME on the command line: pairs, scenes, files, and what is refused.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/csv.hpp"
#include "base/file.hpp"
#include "legacy/legacy_fixed.hpp"
#include "legacy/legacy_json.hpp"
#include "program.hpp"
#include "scene/builtin.hpp"

namespace {

namespace fs = std::filesystem;

using test::urad;

std::string scratch(const std::string& name) { return test::scratch(name).string(); }

const std::string kWeights = URAD_SOURCE_DIR "/weights/legacy_linear50.json";

}  // namespace

TEST_CASE("pairs get the network's integers, or the reason why it cannot read them") {
  const std::string folder = scratch("legacy_pairs");
  const std::string near = "0 0 0;1 0 0;1 1 0;0 1 0", far = "0 0 1;0 1 1;1 1 1;1 0 1";
  host::write_file_atomically(
      folder + "/pairs.csv",
      "id,p,q\nfacing," + near + "," + far + "\nback," + far + "," +
          "0 0 1;1 0 1;1 1 1;0 1 1\npentagon,0 0 0;1 0 0;1 1 0;.5 1 0;0 .5 0," + far +
          "\noutside," + near + ",0 0 2;0 1 2;1 1 2;1 0 2\ntriangle," + near +
          ",0 0 1;0 1 1;1 1 1\n");
  REQUIRE(urad("formfactor --method legacy:linear50 --in " + folder + "/pairs.csv --out " + folder +
               "/f.csv")
              .status == 0);
  const host::CsvTable f = host::read_csv(folder + "/f.csv");
  REQUIRE(f.rows.size() == 5);
  const auto net = host::legacy_from_json(host::read_file(kWeights), kWeights);
  const host::LegacyInput input{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                                0, 0, 1, 0, 1, 1, 1, 1, 1, 1, 0, 1};
  host::LegacyInput last_twice = input;
  last_twice[22] = 1;
  CHECK(std::stod(f.rows[0].cells[1]) == host::LegacyFixed(net.fixed).form_factor(input));
  CHECK(f.rows[1].cells[1] == "0");
  CHECK(f.rows[2].cells[2] == "unsupported_not_a_quad");
  CHECK(f.rows[3].cells[2] == "unsupported_outside_unit_cube");
  CHECK(std::stod(f.rows[4].cells[1]) == host::LegacyFixed(net.fixed).form_factor(last_twice));
}

TEST_CASE("the cube is solved by a shipped network and by its file, with the same light") {
  const std::string folder = scratch("legacy_solve");
  REQUIRE(urad("solve cube7 --method legacy:linear50 --shots 50 --out " + folder +
               "/a.csv --rows " + folder + "/rows.csv")
              .status == 0);
  REQUIRE(urad("solve cube7 --method legacy --net " + kWeights + " --shots 50 --out " + folder +
               "/b.csv")
              .status == 0);
  CHECK(host::read_file(folder + "/a.csv") == host::read_file(folder + "/b.csv"));
  const auto net = host::legacy_from_json(host::read_file(kWeights), kWeights);
  const host::Scene scene = host::load_scene("cube7");
  const host::CsvTable rows = host::read_csv(folder + "/rows.csv");
  REQUIRE(rows.rows.size() == 294);
  for (const std::size_t i : {0U, 100U, 293U}) {
    for (std::size_t j = 0; j < 294; j += 5) {
      const auto &a = scene.patches[i], &b = scene.patches[j];
      const double exact =
          a.surface == b.surface
              ? 0
              : host::LegacyFixed(net.fixed).form_factor(host::legacy_input(a.polygon, b.polygon));
      CHECK(std::fabs(std::stod(rows.rows[i].cells[j + 1]) - exact) <= 5e-4);
    }
  }
}

TEST_CASE("wrong names and files are refused") {
  const std::string folder = scratch("legacy_refused");
  CHECK(urad("solve cube7 --method legacy:linear7 --out -").status == 2);
  CHECK(urad("solve cube7 --method legacy --out -").status == 2);
  CHECK(urad("solve cube7 --method net --net " + kWeights + " --out -").status == 2);
  const std::string text = host::read_file(kWeights);
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"\"urad-legacy 1\"", "\"urad-legacy 2\""},
        {"\"output_shift\": ", "\"output_shift\": 9"},
        {"\"hidden_weight\": [", "\"hidden_weight\": [1,"}}) {
    std::string bad = text;
    bad.replace(bad.find(from), from.size(), to);
    host::write_file_atomically(folder + "/bad.json", bad);
    CHECK(urad(fmt::format("export {}/bad.json -o {}/bad.h", folder, folder)).status == 1);
    CHECK_FALSE(fs::exists(folder + "/bad.h"));
  }
}
