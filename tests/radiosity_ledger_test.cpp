#include <doctest/doctest.h>

#include "radiosity_scene.hpp"

using test::Solve;
using test::TableScene;
using urad::Status;

namespace {

constexpr unsigned kSeed = 1988;

/// Any factors at all: row sums from 0 to far above 1, surfaces with all reflectances, several
/// lamps.
void fill_anything(TableScene* scene, std::mt19937& random, double mean_sum) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const double mean = mean_sum / scene->patches();
  for (auto& row : scene->row) {
    const double brightness = uniform(random) * 2;
    for (auto& f : row)
      f = uint32_t(std::min(brightness * 2 * mean * uniform(random), 0.999) * 0x1p32);
  }
  for (auto& p : scene->polygon) p.shape.log2_area_q24 = int32_t(uniform(random) * 0x1p26);
  for (int s = 0; s < scene->pod.surface_count; ++s) {
    const auto e = [&] { return int32_t(random() % 2 ? uniform(random) * 20000 : 0); };
    scene->set(s, {uniform(random), uniform(random), uniform(random)}, {e(), e(), e()});
  }
  scene->pod.log2_power_q24 = 8 << 24;
}

}  // namespace

TEST_CASE("emitted = absorbed + unshot + escaped, to the last unit, at every shot") {
  std::mt19937 random(kSeed);
  uint32_t rows_over = 0, rows_cut = 0, rows_off = 0, shots = 0;
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    TableScene scene(1 + int(random() % 7), 1 + int(random() % 8),
                     trial % 2 ? URAD_SCENE_CLOSED : 0);
    fill_anything(&scene, random, 0.3 + trial * 0.04);
    Solve solve(scene, trial % 4 < 2 ? URAD_OVERSHOOT : 0);
    REQUIRE(solve.status == Status::ok);
    const urad_ledger start = solve.state.ledger;
    bool holds = true, emitted_stays = true;
    for (int shot = 0; shot < 200; ++shot) {
      const Status status = urad::radiosity_step(&solve.state);
      holds = holds && urad::radiosity_audit(solve.state, nullptr);
      for (int c = 0; c < 3; ++c) {
        emitted_stays = emitted_stays && solve.state.ledger.emitted[c] == start.emitted[c];
      }
      if (status != Status::ok) break;
    }
    CHECK(holds);
    CHECK(emitted_stays);
    rows_over += solve.state.counters.rows_over;
    rows_cut += solve.state.counters.rows_cut;
    rows_off += solve.state.counters.rows_off;
    shots += solve.state.counters.shots;
  }
  // The trials have met every kind of row.
  CHECK(rows_over > 100);
  CHECK(rows_cut > 100);
  CHECK(rows_off > 100);
  CHECK(shots > 3000);
}

TEST_CASE("the audit finds a single unit that is missing") {
  TableScene scene(3, 4, 0);
  std::mt19937 random(kSeed);
  fill_anything(&scene, random, 0.7);
  Solve solve(scene);
  REQUIRE(urad::radiosity_step(&solve.state) == Status::ok);
  urad_ledger ledger{};
  REQUIRE(urad::radiosity_audit(solve.state, &ledger));
  solve.state.unshot[5] += 1;
  urad_ledger recount{};
  CHECK_FALSE(urad::radiosity_audit(solve.state, &recount));
  CHECK(recount.unshot[2] == ledger.unshot[2] + 1);
  solve.state.unshot[5] -= 1;
  solve.state.ledger.absorbed[0] += 1;
  CHECK_FALSE(urad::radiosity_audit(solve.state, nullptr));
}

TEST_CASE("a closed scene lets nothing escape while rows are within 2^-8") {
  for (const double sum : {1.0, 1.0 - 1.0 / 300, 1.0 + 1.0 / 300}) {
    TableScene room(6, 9, URAD_SCENE_CLOSED);
    std::mt19937 random(kSeed);
    room.fill_reciprocal(random, sum);
    test::furnish(&room);
    Solve solve(room, URAD_OVERSHOOT);
    solve.run(1e-6);
    CHECK(solve.status == Status::ok);
    CHECK(solve.state.counters.rows_off == 0);
    for (int c = 0; c < 3; ++c) CHECK(solve.state.ledger.escaped[c] == 0);
    // What stays with the shooter is shot again: each row counts as if divided by its sum.
    INFO("row sum ", sum, "  rms ", solve.relative_rms(true));
    CHECK(solve.relative_rms(true) < 2e-5);
  }
}

TEST_CASE("a closed scene whose rows are off by more says so") {
  for (const double sum : {0.98, 1.02}) {
    TableScene room(6, 9, URAD_SCENE_CLOSED);
    std::mt19937 random(kSeed);
    room.fill_reciprocal(random, sum);
    test::furnish(&room);
    Solve solve(room);
    solve.run(0.01);
    CHECK(solve.state.counters.rows_off == solve.state.counters.shots);
    for (int c = 0; c < 3; ++c) {
      const int64_t escaped = solve.state.ledger.escaped[c];
      CHECK((sum < 1 ? escaped > 0 : escaped < 0));
    }
  }
}

TEST_CASE("an open scene: what rows lack to 1 escapes, and no shot hands out more than it takes") {
  TableScene room(6, 9, 0);
  std::mt19937 random(kSeed);
  room.fill_reciprocal(random, 0.7);
  test::furnish(&room);
  Solve solve(room);
  REQUIRE(urad::radiosity_step(&solve.state) == Status::ok);
  const auto& ledger = solve.state.ledger;
  for (int c = 0; c < 3; ++c) {
    const double shot = double(ledger.emitted[c] - ledger.unshot[c] + solve.state.reflected[c]);
    CHECK(double(ledger.escaped[c]) == doctest::Approx(0.3 * shot).epsilon(1e-6));
    CHECK(ledger.absorbed[c] > 0);
  }
  solve.run(1e-6);
  double escaped = 0;
  for (int i = 0; i < room.patches(); ++i) escaped += 0.3 * room.area(i) * room.exact(0)(i) * 64;
  CHECK(double(ledger.escaped[0]) == doctest::Approx(escaped).epsilon(1e-4));
}

TEST_CASE("row sums far above 1 are cut: powers stay in range, the ledger holds") {
  TableScene scene(4, 30, 0);
  for (auto& row : scene.row) std::fill(row.begin(), row.end(), 0xFFFFFFFFu);
  for (int s = 0; s < 4; ++s) scene.set(s, {0.5, 0.3, 0}, {s ? 0 : 1000, 1000, 0});
  Solve solve(scene);
  for (int shot = 0; shot < 500 && solve.status == Status::ok; ++shot) {
    solve.status = urad::radiosity_step(&solve.state);
    REQUIRE(urad::radiosity_audit(solve.state, nullptr));
  }
  CHECK(solve.state.counters.rows_cut == solve.state.counters.shots);
  CHECK(solve.state.counters.worst_row_uq16 == 32767);
}

TEST_CASE("a row that is cut lets through one and a half, in the order of the patches") {
  TableScene room(2, 4, 0);
  room.set(0, {0, 0, 0}, {1 << 16, 0, 0});
  room.set(1, {1, 1, 1}, {0, 0, 0});
  room.pod.log2_power_q24 = 8 << 24;
  for (auto& polygon : room.polygon) polygon.shape.log2_area_q24 = 0;
  room.material[0].exitance[0] = 1 << 16;
  for (std::size_t j = 4; j < 8; ++j) room.row[0][j] = 0xA0000000u;  // 5/8 each
  Solve solve(room);
  REQUIRE(urad::radiosity_step(&solve.state) == urad::Status::ok);
  const double shot = 256.0 * (1 << 16);
  const double part[4] = {0.625, 0.625, 0.25, 0};
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(solve.state.unshot[3 * (4 + k)] / shot == doctest::Approx(part[k]).epsilon(1e-3));
  CHECK(solve.state.counters.rows_cut == 1);
}
