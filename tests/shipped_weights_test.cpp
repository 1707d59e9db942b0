// The folder weights: a manifest of what lies in it, and networks that their commands make again.
#include <doctest/doctest.h>

#include "base/csv.hpp"
#include "base/file.hpp"
#include "network/digest.hpp"
#include "program.hpp"

namespace {
const std::string kWeights = std::string(URAD_SOURCE_DIR) + "/weights/";
}  // namespace

TEST_CASE("the manifest has the digest of every network, and so has its header") {
  const host::CsvTable manifest = host::read_csv(kWeights + "MANIFEST.csv");
  const std::size_t name = manifest.column("name"), digest = manifest.column("digest");
  std::size_t networks = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kWeights))
    networks += entry.path().extension() == ".json";
  CHECK(manifest.rows.size() == networks);
  for (const host::CsvRow& row : manifest.rows) {
    CAPTURE(row.cells[name]);
    const std::string& sum = row.cells[digest];
    CHECK(host::sha256(host::read_file(kWeights + row.cells[name] + ".json")) == sum);
    CHECK(host::read_file(kWeights + row.cells[name] + ".h").find(sum) != std::string::npos);
  }
}

TEST_CASE("the shipped network of the cube is what its command trains, byte for byte") {
  const std::string made = (test::scratch("shipped_weights") / "cube7.json").string();
  const test::Outcome outcome = test::urad("train --scene cube7 --hidden 4 --seed 1 -o " + made);
  REQUIRE_MESSAGE(outcome.status == 0, outcome.text);
  CHECK(host::read_file(made) == host::read_file(kWeights + "cube7.json"));
}
