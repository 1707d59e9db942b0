// Commands that write documents of many measurements, run small: what is named is there, what is not counted is
// left out, and a table that is none is refused in one sentence.
#include <algorithm>
#include <fstream>
#include <string>

#include "base/file.hpp"
#include "program.hpp"

namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

/// It succeeds, and the document is not empty.
std::string document(const std::string& arguments, const fs::path& file) {
  const test::Outcome outcome = test::urad(arguments);
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  return host::read_file(file.string());
}

}  // namespace

TEST_CASE("what skips save, with counted instructions and without") {
  const fs::path folder = test::scratch("document_skipping"), file = folder / "skipping.md";
  const auto command = [&](const std::string& scene) {
    return "skipping --scenes " + scene + " -o " + file.string();
  };
  const std::string bare = document(command("cube7"), file);
  CHECK(has(bare, "cube7"));
  CHECK(has(bare, "not counted"));
  CHECK(fs::exists(folder / "skipping.svg"));
  CHECK(has(host::read_file((folder / "skipping_cube7.svg").string()), "<svg"));
  const std::string counted =
      R"("all":{"mean":300},"solver_on":{"mean":10},"solver_all":{"mean":20},"on_64":{"mean":400},)"
      R"("all_64":{"mean":600},"worth_64":{"mean":300},"light_1":{"mean":3},"light_2":{"mean":5},)"
      R"("bounded":{"mean":50},"same":{"mean":110}}})";
  write(folder / "louvre.json", R"({"microbit":{"on":{"mean":100},)" + counted);
  write(folder / "louvre.sight.json", R"({"microbit":{"on":{"mean":90}}})");
  const std::string with = " --instructions " + folder.string();
  const std::string full = document(command("louvre") + with, file);
  CHECK(has(full, "x 3.00"));  // 300 / 100
  for (const char* wrong : {"", "[]", "{}", R"({"microbit":{}})", R"({"microbit":{"on":7}})",
                            R"({"microbit":{"on":{}}})", R"({"microbit":{"on":{"mean":"7"}}})"}) {
    write(folder / "cube7.json", wrong);
    const test::Outcome refused = test::urad(command("cube7") + with);
    CAPTURE(refused.text);
    CHECK(refused.status == 1);
    CHECK(has(refused.text, "cube7.json: not a table of counted instructions"));
    CHECK(std::count(refused.text.begin(), refused.text.end(), '\n') == 1);
  }
}

TEST_CASE("methods on pairs of every kind, with what they cost") {
  const fs::path folder = test::scratch("document_methods"), file = folder / "methods.md";
  write(folder / "icount.json",
        R"({"microbit":{"pair_moment":{"mean":2000},"pair_network":{"mean":4000},)"
        R"("pair_point":{"mean":9000},"pair_legacy":{"mean":12000}}})");
  const std::string text = document(
      "evaluate --pairs 4 --method fixed-moment,net,kernel,moment,lambert:2,gauss:2,"
      "contour:2,fixed-lambert:2,auto:0.01,legacy:linear5 --instructions " +
          (folder / "icount.json").string() + " --document " + file.string(),
      file);
  for (const char* method :
       {"fixed-moment", "gauss:2", "contour:2", "fixed-lambert:2", "auto:0.01"})
    CHECK(has(text, method));
  CHECK(fs::exists(folder / "methods_time.svg"));
}

TEST_CASE("the operations that the report counts, one epoch of each network") {
  const fs::path folder = test::scratch("document_report");
  const std::string quick = " --quick --epochs 1 -o " + folder.string();
  CHECK(has(document("reproduce section2.9" + quick, folder / "section2.9.md"), "|"));
}
