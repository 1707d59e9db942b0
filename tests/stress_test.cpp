// A short stress run of every kind, and the machinery of the long one: cases from numbers, failures
// as files, tables.
#include <doctest/doctest.h>

#include <filesystem>

#include "base/error.hpp"
#include "base/file.hpp"
#include "stress/mutate.hpp"
#include "stress/stress_run.hpp"
#include "stress/stress_table.hpp"
#include "weights/cornell.h"
#include "weights/cube7.h"
#include "weights/general.h"

namespace {

constexpr std::uint64_t kSeed = 19930719;

const urad_net* shipped(const std::string& name) {
  return name == "cornell" ? &urad_cornell : name == "cube7" ? &urad_cube7 : &urad_general;
}

/// So many cases of every family hold; the table of a run that does not is shown.
void attack(const char* kind, std::size_t cases) {
  host::StressRequest request;
  request.kinds = {kind};
  request.seed = kSeed;
  request.cases = cases;
  request.nets = {shipped};
  request.quiet = true;
  const host::StressReport report = host::run_stress(request);
  INFO("seed ", kSeed, "\n", host::stress_table(report));
  CHECK(report.failures() == 0);
  CHECK(report.kind_cases.at(0) == cases * host::attacks_of(kind, request.nets).size());
}

}  // namespace

TEST_CASE("stress: pairs") { attack("pairs", 12); }
TEST_CASE("stress: networks") { attack("networks", 60); }
TEST_CASE("stress: solver") { attack("solver", 8); }
TEST_CASE("stress: scenes") { attack("scenes", 400); }
TEST_CASE("stress: files") { attack("files", 1500); }

TEST_CASE("a failure is written as a file, and runs again from it") {
  const host::StressCase good{"networks", "random weights",
                              "temper 0 inputs 14 hidden 2 bits 8 seed 7"};
  const host::StressCase read = host::case_from_text(host::to_text(good), "x.case");
  CHECK(read.kind == good.kind);
  CHECK(read.family == good.family);
  CHECK(read.input == good.input);
  CHECK_FALSE(host::replay(read, {shipped}).empty());
  CHECK_THROWS_WITH_AS(host::case_from_text("kind files\n", "x.case"),
                       doctest::Contains("x.case: "), host::Error);
  CHECK_THROWS_AS(host::replay({"files", "nothing", ""}, {shipped}), host::Error);
  CHECK_THROWS_AS(host::attacks_of("nothing", {shipped}), host::UsageError);
}

TEST_CASE("case N of a seed is the same in every run, and others differ") {
  for (const std::string& kind : host::stress_kinds()) {
    CAPTURE(kind);
    const host::Attack attack = host::attacks_of(kind, {shipped}).front();
    CHECK(host::stress_case(attack, 1, 5).input == host::stress_case(attack, 1, 5).input);
    CHECK(host::stress_case(attack, 1, 5).input != host::stress_case(attack, 1, 6).input);
    CHECK(host::stress_case(attack, 1, 5).input != host::stress_case(attack, 2, 5).input);
  }
}

TEST_CASE("a check that does not hold is found, counted and shown first") {
  host::Findings findings;
  findings.expect("always", true);
  findings.measure("small", 1e-12, 1e-9);
  findings.measure("small", 1e-3, 1e-9);
  findings.measure("small", 1e-15, 1e-9);
  findings.measure("number", std::nan(""), 1);
  findings.measure("shown", 1e300);
  REQUIRE(findings.checks().size() == 4);
  CHECK(findings.checks()[0].holds());
  CHECK(findings.checks()[1].value == 1e-3);
  CHECK_FALSE(findings.checks()[1].holds());
  CHECK_FALSE(findings.checks()[2].holds());
  CHECK(findings.checks()[3].holds());
  host::StressReport report;
  report.request.kinds = {"pairs"};
  report.kind_cases = {2};
  report.rows = {{"pairs", "a", "fine", 2, 0, 0, 1, 0, 0},
                 {"pairs", "b", "broken", 2, 1, 5, 1, 5, 1}};
  const std::string table = host::stress_table(report);
  CHECK(table.find("broken") < table.find("fine"));
  CHECK(table.find("FAILED 1 times") != std::string::npos);
  CHECK(host::stress_document(report).find("| broken | 2 | 5 | 1 | b#1, failed 1 |") !=
        std::string::npos);
  CHECK(report.failures() == 1);
}
