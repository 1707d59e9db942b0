// The program as a person meets it: exit status, one clear sentence, nothing half-written.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "base/file.hpp"
#include "program.hpp"

namespace {

namespace fs = std::filesystem;

using test::Outcome;
using test::scratch;
using test::urad;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

const std::string kMaterials = "newmtl wall\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\n";
const std::string kScene =
    "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nv 1 1 1\nv 1 0 1\n"
    "usemtl wall\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";

std::string kernel_solve(const fs::path& folder) {
  return "solve " + (folder / "scene.obj").string() + " --method fixed-moment --out " +
         (folder / "b.csv").string();
}

struct BadScene {
  const char* what;
  std::string scene, materials;
  const char* where;  ///< file and line the message must name
};

}  // namespace

TEST_CASE("a bad scene gets one sentence with file and line, status 1, and no output") {
  const BadScene scenes[] = {
      {"NaN", replaced(kScene, "v 1 1 0", "v nan 1 0"), kMaterials, "scene.obj:4: "},
      {"zero area", replaced(kScene, "v 1 1 0\nv 0 1 0", "v 2 0 0\nv 3 0 0"), kMaterials,
       "scene.obj:11: "},
      {"no Kd", kScene, replaced(kMaterials, "Kd .5 .5 .5\n", ""), "scene.mtl:1: "},
      {"no light", kScene, replaced(kMaterials, "Ke 1 1 1\n", ""), "scene.obj:"},
      {"reflectance above 1", kScene, replaced(kMaterials, ".5 .5 .5", "1.5 .5 .5"),
       "scene.mtl:2: "},
      {"one patch", replaced(replaced(kScene, "f 5 6 7 8\n", ""), "usemtl wall", "usemtl lamp"),
       kMaterials, "scene.obj:11: "},
      {"no such vertex", replaced(kScene, "f 1 2 3 4", "f 1 2 3 99"), kMaterials, "scene.obj:11: "},
      {"index too large", replaced(kScene, "f 1 2 3 4", "f 4294967297 2 3 4"), kMaterials,
       "scene.obj:11: "},
      {"index not whole", replaced(kScene, "f 1 2 3 4", "f 1.5 2 3 4"), kMaterials,
       "scene.obj:11: "},
      {"too bright", kScene, replaced(kMaterials, "Ke 1 1 1", "Ke 1e308 1 1"), "scene.mtl:5: "},
      {"no such file", replaced(kScene, "scene.mtl", "other.mtl"), kMaterials, "scene.obj:1: "},
      {"unreadable", "this is no scene\n", kMaterials, "scene.obj:1: "},
  };
  for (const BadScene& bad : scenes) {
    CAPTURE(bad.what);
    const fs::path folder = scratch("bad_scene");
    host::write_file_atomically((folder / "scene.obj").string(), bad.scene);
    host::write_file_atomically((folder / "scene.mtl").string(), bad.materials);
    const Outcome outcome = urad(kernel_solve(folder));
    CAPTURE(outcome.text);
    CHECK(outcome.status == 1);
    CHECK(outcome.text.find(bad.where) != std::string::npos);
    CHECK(std::count(outcome.text.begin(), outcome.text.end(), '\n') == 1);
    CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 2);
  }
  CHECK(urad("solve nowhere.obj --method fixed-moment --out -").status == 1);
}

TEST_CASE("a net file cut short or of a wrong version is named") {
  const fs::path folder = scratch("bad_net");
  const std::string good = host::read_file(std::string(URAD_SOURCE_DIR) + "/weights/cube7.json");
  const std::string cut = (folder / "cut.json").string(), old = (folder / "old.json").string();
  host::write_file_atomically(cut, good.substr(0, good.size() / 2));
  host::write_file_atomically(old, replaced(good, "\"version\": ", "\"version\": 9"));
  for (const std::string& file : {cut, old}) {
    const Outcome outcome =
        urad("solve cube7 --method net --net " + file + " --out " + (folder / "b.csv").string());
    CHECK(outcome.status == 1);
    CHECK(outcome.text.find(file) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "b.csv"));
  }
}

TEST_CASE("an output that cannot be written is named, and nothing is left behind") {
  const Outcome solve = urad("solve cube7 --method fixed-moment --out /proc/none/b.csv");
  CHECK(solve.status == 1);
  CHECK(solve.text.find("/proc/none") != std::string::npos);
  const Outcome bake = urad("bake cube7 --method fixed-moment -o /proc/none");
  CHECK(bake.status == 1);
  CHECK(bake.text.find("/proc/none") != std::string::npos);
}

TEST_CASE("a folder that nothing was written into goes again, one that was there stays") {
  const fs::path there = scratch("no_bake"), made = there / "made" / "deep";
  for (const fs::path& folder : {made, there}) {
    CHECK(urad("bake cube7 --method hemicube:15 -o " + folder.string()).status == 2);
    CHECK(fs::exists(there));
    CHECK(fs::is_empty(there));
  }
  CHECK(urad("reproduce table4.1 --quick --document nowhere.md -o " + made.string()).status == 1);
  CHECK(fs::is_empty(there));
}

TEST_CASE("a wrong number is told with what would do") {
  const auto told = [](const std::string& arguments, const std::string& sentence) {
    const Outcome outcome = urad(arguments);
    CAPTURE(outcome.text);
    CHECK(outcome.status == 2);
    CHECK(outcome.text.find(sentence) != std::string::npos);
  };
  told("solve cube7 --method net --error 0 --out -", "--error: 0 should be from 1e-07 to 1");
  told("train --scene cube7 --hidden 65 -o -", "--hidden: 65 should be from 1 to 64");
  told("plan cube7 --ram 0", "--ram: 0 should be from 1 to");
  told("stress --minutes -3", "--minutes: -3 should be above 0");
  told("formfactor --method kernel --in x.csv --subdivide 2 --out -", "--scene");
  told("solve cube7 --method net,auto --out -", "--method net,auto: one method at a time here");
  told("bake cube7 --method net,auto,net -o out", "--method net,auto,net: net stands twice");
}

TEST_CASE("wrong usage has status 2 and says what would do") {
  const std::string pairs = std::string(URAD_SOURCE_DIR) + "/tests/vectors/pairs.csv";
  for (const std::string& arguments : std::vector<std::string>{
           "", "unknown", "solve cube7", "solve cube7 --method nothing --out -",
           "solve cube7 --method hemicube:15 --out -", "help nothing",
           "formfactor --method lambert:0 --in " + pairs + " --out -",
           "solve cube7 --method net:nothing --out -", "export x.json --bits 12 -o x.h"}) {
    CAPTURE(arguments);
    const Outcome outcome = urad(arguments);
    CAPTURE(outcome.text);
    CHECK(outcome.status == 2);
    CHECK(outcome.text.find("Try: urad help") != std::string::npos);
  }
  CHECK(urad("solve cube7 --shot 5").text.find("--shots would do") != std::string::npos);
  CHECK(urad("solv cube7").text.find("solve would do") != std::string::npos);
  for (const char* topic : {"", "solve", "bake", "train", "export", "evaluate", "formfactor"}) {
    CHECK(urad(std::string("help ") + topic).status == 0);
  }
}

TEST_CASE("a table of pairs with bad rows finishes, with a status per row, in input order") {
  const fs::path folder = scratch("pairs");
  const std::string out = (folder / "f.csv").string();
  const std::string in = std::string(URAD_SOURCE_DIR) + "/tests/vectors/pairs.csv";
  REQUIRE(urad("formfactor --method reference --in " + in + " --out " + out).status == 0);
  const host::CsvTable pairs = host::read_csv(in), results = host::read_csv(out);
  REQUIRE(results.rows.size() == pairs.rows.size());
  CHECK(results.header == std::vector<std::string>{"id", "f", "status", "error"});
  for (std::size_t k = 0; k < pairs.rows.size(); ++k) {
    const std::string& expected = pairs.rows[k].cells[pairs.column("expected")];
    CHECK(results.rows[k].cells[0] == pairs.rows[k].cells[pairs.column("id")]);
    if (expected.rfind("invalid_", 0) == 0) {
      CHECK(results.rows[k].cells[2] == expected);
    } else {
      CHECK(results.rows[k].cells[2] == "ok");
      const std::size_t digits = expected.size() - 1 - expected.find('.');
      const double last_digit = std::pow(10.0, -double(std::min<std::size_t>(digits, 12)));
      CHECK(std::fabs(std::stod(results.rows[k].cells[1]) - std::stod(expected)) <= last_digit);
    }
  }
}

TEST_CASE(
    "plates with blockers: rays and hybrid near the exact values, reference says what it cannot "
    "do") {
  const fs::path folder = scratch("plates");
  const std::string in = std::string(URAD_SOURCE_DIR) + "/tests/vectors/scenes.csv";
  const double exact[] = {0.199824895698387, 0.149868671773791, 0.0995062945989848, 0};
  const struct {
    const char* method;
    double bound;
  } methods[] = {
      {"rays:256", 3e-3}, {"hybrid:64 --subdivide 4", 1e-2}, {"monte-carlo:200000", 1e-3}};
  for (const auto& row : methods) {
    const std::string method = row.method;
    CAPTURE(method);
    const std::string out = (folder / "f.csv").string();
    const std::string wanted =
        fmt::format("formfactor --scene {} --method {} --out {}", in, method, out);
    REQUIRE(urad(wanted).status == 0);
    const host::CsvTable results = host::read_csv(out);
    REQUIRE(results.rows.size() == 4);
    for (std::size_t k = 0; k < 4; ++k)
      CHECK(std::fabs(std::stod(results.rows[k].cells[1]) - exact[k]) <= row.bound);
    CHECK(std::stod(results.rows[3].cells[1]) == 0);  // fully blocked is exactly 0
  }
  REQUIRE(
      urad("formfactor --scene " + in + " --method reference --out " + (folder / "r.csv").string())
          .status == 0);
  const host::CsvTable reference = host::read_csv((folder / "r.csv").string());
  CHECK(reference.rows[0].cells[2] == "ok");
  CHECK(reference.rows[1].cells[2] == "unsupported_occluded");
}

TEST_CASE("solve writes the solution, the rows and the report of the cube") {
  const fs::path folder = scratch("solve");
  const auto path = [&](const char* name) { return (folder / name).string(); };
  const Outcome outcome =
      urad("solve cube7 --method net:cube7 --error 0.001 --out " + path("b.csv") + " --rows " +
           path("rows.csv") + " --report " + path("report.json"));
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  const host::CsvTable b = host::read_csv(path("b.csv")), rows = host::read_csv(path("rows.csv"));
  CHECK(b.header == std::vector<std::string>{"patch", "B_r", "B_g", "B_b"});
  REQUIRE(b.rows.size() == 294);
  REQUIRE(rows.rows.size() == 294);
  REQUIRE(rows.header.size() == 295);
  for (const host::CsvRow& row : rows.rows) {
    double sum = 0;
    for (std::size_t j = 1; j < row.cells.size(); ++j) sum += std::stod(row.cells[j]);
    CHECK(std::fabs(sum - 1) <= 0.003);  // before repair
  }
  CHECK(host::read_file(path("report.json")).find("\"exact\": true") != std::string::npos);
}

TEST_CASE(
    "solve without the exact solution gives the same light, and says that nothing was compared") {
  const fs::path folder = scratch("no_exact");
  const auto solve = [&](const std::string& name, const std::string& options) {
    std::string path = (folder / name).string();
    const Outcome outcome = urad("solve cube7 --method fixed-moment --out " + path +
                                 ".csv --report " + path + ".json " + options);
    CAPTURE(outcome.text);
    REQUIRE(outcome.status == 0);
    return path;
  };
  const std::string with = solve("with", ""), without = solve("without", "--no-exact");
  CHECK(host::read_file(with + ".csv") == host::read_file(without + ".csv"));
  CHECK(host::read_file(with + ".json").find("\"exact_rms\": null") == std::string::npos);
  CHECK(host::read_file(without + ".json").find("\"exact_rms\": null") != std::string::npos);
  CHECK(host::read_file(without + ".json").find("\"converged_rms\": null") == std::string::npos);
}

TEST_CASE("an open scene is solved by factors whose rows pass 1, as the engine divides them") {
  const fs::path folder = scratch("rows_above_1");
  host::write_file_atomically((folder / "plates.csv").string(),
                              "patch,polygon,rho_r,rho_g,rho_b,emit\n"
                              "floor,0 0 0;1 0 0;1 1 0;0 1 0,0.5,0.5,0.5,1\n"
                              "ceiling,0 0 0.3;0 1 0.3;1 1 0.3;1 0 0.3,0.5,0.5,0.5,0\n"
                              "wall,0 0 0;0 1 0;0 1 0.3;0 0 0.3,0.5,0.5,0.5,0\n");
  const std::string path = (folder / "report.json").string();
  const Outcome outcome = urad("solve " + (folder / "plates.csv").string() +
                               " --method kernel --error 0.001 --out - --report " + path);
  CAPTURE(outcome.text);
  CHECK(outcome.status == 0);
  const std::string report = host::read_file(path);
  CHECK(report.find("\"rows_over\": 0") == std::string::npos);
}

TEST_CASE("a net is evaluated on its scene meshed as it was trained") {
  const fs::path folder = scratch("own_mesh");
  const std::string net = (folder / "n.json").string(), scene = (folder / "plates.obj").string();
  host::write_file_atomically((folder / "plates.mtl").string(),
                              "newmtl grey\nKd 1 0 0\nKe 1 1 1\n");
  host::write_file_atomically(
      scene,
      "mtllib plates.mtl\nusemtl grey\nv 0 0 0\nv 1 0 0\nv 1 1 0\n"
      "v 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\nf 8 7 6 5\n");
  const Outcome trained = urad("train --scene " + scene + " --subdivide 2 --hidden 1 -o " + net);
  CAPTURE(trained.text);
  REQUIRE(trained.status == 0);
  const std::string own = urad("evaluate " + net).text;
  CHECK(own.find("32 ordered pairs") != std::string::npos);
  CHECK(own == urad("evaluate " + net + " --subdivide 2").text);
}

TEST_CASE("outputs of one name are refused; when one cannot be written, none is") {
  const fs::path folder = scratch("outputs");
  const auto path = [&](const char* name) { return (folder / name).string(); };
  const std::string solve = "solve cube7 --method fixed-moment ";
  const Outcome twice =
      urad(solve + "--out " + path("b.csv") + " --rows " + folder.string() + "/./b.csv");
  CHECK(twice.status == 2);
  CHECK(twice.text.find("--out and --rows") != std::string::npos);
  const Outcome failed = urad(solve + "--shots 1 --rows " + path("rows.csv") + " --report " +
                              path("r.json") + " --out " + path("none/b.csv"));
  CHECK(failed.status == 1);
  CHECK(failed.text.find("none/b.csv") != std::string::npos);
  CHECK(fs::is_empty(folder));
}

TEST_CASE("train names the checkpoint that was altered") {
  const fs::path folder = scratch("altered");
  const std::string net = (folder / "net.json").string();
  host::write_file_atomically(net + ".partial",
                              "{\"format\":\"urad-training 2\",\"command\":\"urad train --scene "
                              "cube7 --hidden 4 --seed 1\"}");
  const Outcome outcome = urad("train --scene cube7 --seed 1 -o " + net);
  CHECK(outcome.status == 1);
  CHECK(outcome.text.find("net.json.partial: ") != std::string::npos);
  CHECK_FALSE(fs::exists(net));
}
