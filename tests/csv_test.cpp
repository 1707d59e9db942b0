#include "base/csv.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/parallel.hpp"

using host::CsvTable;
using host::parse_csv;

namespace {

/// The message of the Error that reading `text` throws; empty when it throws none.
std::string complaint(const std::string& text) {
  try {
    parse_csv(text, "t.csv");
  } catch (const host::Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("cells, quotes, line ends and line numbers") {
  const CsvTable table =
      parse_csv("\xEF\xBB\xBFid,p\r\na,\"1,2\"\r\n\r\nb,\"say \"\"x\"\"\nagain\"\nc,\n", "t.csv");
  CHECK(table.header == std::vector<std::string>{"id", "p"});
  REQUIRE(table.rows.size() == 3);
  CHECK(table.rows[0].cells[1] == "1,2");
  CHECK(table.rows[1].cells[1] == "say \"x\"\nagain");
  CHECK(table.rows[1].line == 4);
  CHECK(table.rows[2].line == 6);
  CHECK(table.rows[2].cells[1].empty());
  CHECK(table.column("p") == 1);
  CHECK_FALSE(table.find("q"));
  CHECK_THROWS_WITH_AS(table.column("q"), "t.csv:1: no column 'q'; the header is 'id,p'",
                       host::Error);
  CHECK(parse_csv("a,b\n1,2", "t.csv").rows.size() == 1);
}

TEST_CASE("titles with blanks around them, a byte-order mark or CRLF are the same titles") {
  for (const char* text : {"id , p,\tq\na,b,c\n", "\xEF\xBB\xBF id,p ,q\r\na,b,c\r\n",
                           "\xEF\xBB\xBF\"id\",\" p\",q \na,b,c\n"}) {
    const CsvTable table = parse_csv(text, "t.csv");
    CHECK(table.column("id") == 0);
    CHECK(table.column("p") == 1);
    CHECK(table.column("q") == 2);
    CHECK(table.rows.at(0).cells == std::vector<std::string>{"a", "b", "c"});
  }
  CHECK(complaint("a, a\n") == "t.csv:1: the column 'a' is there twice");
}

TEST_CASE("tables that cannot be read name the line") {
  CHECK(complaint("").find("t.csv:1: empty") == 0);
  CHECK(complaint("a,b\n1,2\n1,2,3\n").find("t.csv:3: 3 cells; the header has 2") == 0);
  CHECK(complaint("a,b\n1,\"2\n3\n").find("t.csv:2: a quote is opened") == 0);
  CHECK(complaint("a,b\n1,\"2\"x\n").find("t.csv:2: text after a closing quote") == 0);
  CHECK(complaint("a,b,a\n").find("t.csv:1: the column 'a' is there twice") == 0);
}

TEST_CASE("what is written reads back") {
  const std::vector<std::string> cells = {"plain", "a,b", "say \"x\"", "two\nlines", " blank ", ""};
  const CsvTable table = parse_csv("a,b,c,d,e,f\n" + host::csv_line(cells), "t.csv");
  CHECK(table.rows.at(0).cells == cells);
  CHECK(host::csv_line({"a", "b"}) == "a,b\n");
  for (const double x : {0.1, 1.0 / 3, 1e-300, 123456789.123456789, -0.0})
    CHECK(std::stod(host::csv_number(x)) == x);
  CHECK(host::csv_number(std::nan("")) == "nan");
  CHECK(host::csv_number(0.5) == "0.5");
}

TEST_CASE("a file is written whole or not at all") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(URAD_SCRATCH_DIR) / "csv_test";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string path = (folder / "out.csv").string();
  host::write_file_atomically(path, "old");
  host::write_file_atomically(path, std::string("new\0bytes", 9));
  CHECK(host::read_file(path) == std::string("new\0bytes", 9));
  CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
  fs::create_directories(folder / "folder" / "inside");
  CHECK_THROWS_AS(host::write_file_atomically((folder / "folder").string(), "x"), host::Error);
  CHECK_THROWS_AS(host::write_file_atomically((folder / "none" / "out").string(), "x"),
                  host::Error);
  CHECK_THROWS_AS(host::read_file((folder / "none").string()), host::Error);
  CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 2);
  fs::remove_all(folder);
}

TEST_CASE("files of one run appear together or not at all") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(URAD_SCRATCH_DIR) / "csv_test_together";
  fs::remove_all(folder);
  fs::create_directories(folder / "folder");
  const auto path = [&](const char* name) { return (folder / name).string(); };
  host::write_file_atomically(path("a"), "old");
  for (const char* bad : {"none/c", "folder"})
    CHECK_THROWS_AS(
        host::write_files_atomically({{path("a"), "1"}, {path("b"), "2"}, {path(bad), "3"}}),
        host::Error);
  CHECK(host::read_file(path("a")) == "old");
  CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 2);
  host::write_files_atomically({{path("a"), "1"}, {path("b"), "2"}});
  CHECK(host::read_file(path("a")) + host::read_file(path("b")) == "12");
  fs::create_symlink(path("a"), path("link"));
  const std::string roundabout = path("folder") + "/../a";
  for (const std::string& other : {path("a"), path("link"), roundabout})
    CHECK_THROWS_AS(host::expect_different_files({{"--out", path("a")}, {"--rows", other}}),
                    host::UsageError);
  CHECK_THROWS_AS(host::expect_different_files({{"--out", "-"}, {"--rows", "-"}}),
                  host::UsageError);
  CHECK_THROWS_AS(host::expect_different_files({{"--out", "no_file"}, {"--rows", "./no_file"}}),
                  host::UsageError);
  host::expect_different_files({{"--out", path("a")}, {"--rows", ""}, {"--report", ""}});
  fs::remove_all(folder);
}

TEST_CASE("a parallel loop visits every index once and passes the first exception on") {
  for (const int threads : {0, 1, 3}) {
    for (const std::size_t n : {0UL, 1UL, 7UL, 100'003UL}) {
      std::vector<int> visits(n);
      host::parallel_for(n, threads, [&](std::size_t i) { ++visits[i]; });
      CHECK(std::all_of(visits.begin(), visits.end(), [](int v) { return v == 1; }));
    }
    CHECK_THROWS_AS(host::parallel_for(100, threads,
                                       [](std::size_t i) {
                                         if (i == 50) throw std::runtime_error("stop");
                                       }),
                    std::runtime_error);
  }
}
