#include "urad/radiosity.hpp"

#include <doctest/doctest.h>

#include "radiosity_scene.hpp"

using test::Solve;
using test::TableScene;
using urad::Status;

namespace {

struct Room : TableScene {
  explicit Room(unsigned seed, int surfaces = 6, int each = 9, double sum = 1)
      : TableScene(surfaces, each, sum == 1 ? URAD_SCENE_CLOSED : 0) {
    std::mt19937 random(seed);
    fill_reciprocal(random, sum);
    test::furnish(this);
  }
};

constexpr unsigned kSkipsOff = URAD_SKIP_OFF_CHANNEL | URAD_SKIP_OFF_BLACK | URAD_SKIP_OFF_DARK;

}  // namespace

TEST_CASE("radiosity converges to the dense solution of the same factors") {
  for (const unsigned seed : {1u, 2u, 3u}) {
    for (const double sum : {1.0, 0.6}) {
      for (const unsigned flags : {0u, unsigned{URAD_OVERSHOOT}}) {
        CAPTURE(seed);
        CAPTURE(sum);
        CAPTURE(flags);
        Room room(seed, 6, 9, sum);
        Solve solve(room, flags);
        const int shots = solve.run(1e-6);
        CHECK(solve.status == Status::ok);
        INFO("shots ", shots, "  rms ", solve.relative_rms());
        CHECK(solve.relative_rms() < 2e-5);
      }
    }
  }
}

TEST_CASE("the estimated error bounds the relative rms of B") {
  for (const unsigned seed : {4u, 5u, 6u}) {
    for (const double error : {0.1, 0.03, 0.01, 0.003}) {
      for (const unsigned flags : {0u, unsigned{URAD_OVERSHOOT}}) {
        Room room(seed);
        Solve solve(room, flags);
        const int shots = solve.run(error);
        CAPTURE(seed);
        CAPTURE(flags);
        INFO("error ", error, " flags ", flags, " shots ", shots, " rms ", solve.relative_rms());
        CHECK(solve.relative_rms() < 1.1 * error);
      }
    }
  }
}

TEST_CASE("a cube of 6 x 49 patches: shots and error at 1 % estimated") {
  TableScene cube(6, 49, URAD_SCENE_CLOSED);
  cube.fill_cube();
  test::furnish(&cube);
  cube.pod.log2_power_q24 = 4 << 24;
  Solve plain(cube), over(cube, URAD_OVERSHOOT);
  const int plain_shots = plain.run(0.01), over_shots = over.run(0.01);
  const double plain_rms = plain.relative_rms(), over_rms = over.relative_rms();
  INFO(plain_shots, " shots, rms ", plain_rms, "; overshooting ", over_shots, ", rms ", over_rms);
  CHECK(plain_shots < 900);
  CHECK(over_shots < 450);
  CHECK(plain_rms < 0.011);
  CHECK(plain_rms > 0.005);
  CHECK(over_rms < 0.011);
  CHECK(over_rms > 0.003);
}

TEST_CASE("white furnace: B = E / (1 - rho) at every patch") {
  for (const double rho : {0.0, 0.1, 0.5, 0.9, 0.99}) {
    for (const unsigned flags : {0u, unsigned{URAD_OVERSHOOT}}) {
      Room room(8);
      for (int s = 0; s < 6; ++s) room.set(s, {rho, rho, rho}, {10000, 9999, 1234});
      room.pod.log2_power_q24 = int32_t((13 + std::log2(1 - rho)) * 0x1p24);
      Solve solve(room, flags);
      const int shots = solve.run(1e-6);
      REQUIRE(solve.status == Status::ok);
      double worst = 0;
      for (int i = 0; i < room.patches(); ++i) {
        for (int c = 0; c < 3; ++c) {
          const double expected = room.material[0].exitance[c] / (1 - room.reflectance(i, c));
          worst = std::max(
              worst, std::fabs(urad::radiosity_get(solve.state, uint16_t(i), c) / expected - 1));
        }
      }
      INFO("rho ", rho, " flags ", flags, " shots ", shots, " worst ", worst);
      // Half an exitance unit of 1234 / (1 - rho), and the roundings of 1 / (1 - rho) bounces.
      CHECK(worst < 0.5 * (1 - rho) / 1234 + 2e-5 / (1 - rho));
    }
  }
}

TEST_CASE("the length of runs does not change a bit") {
  Room room(9);
  Solve whole(room, URAD_OVERSHOOT);
  whole.run(0.01);
  for (const uint16_t run : {uint16_t{1}, uint16_t{4}, uint16_t{100}}) {
    Solve pieces(room, URAD_OVERSHOOT, run);
    pieces.run(0.01);
    CHECK(pieces.same_light(whole));
  }
}

TEST_CASE("a solve that was copied away and resumed gives the same bits") {
  Room room(10);
  Solve whole(room), first(room);
  whole.run(0.001);
  first.run(0, 25);
  Solve second(room);
  second.memory = first.memory;
  second.state = first.state;
  second.state.unshot = reinterpret_cast<int32_t*>(second.memory.data());
  second.state.shot = second.state.unshot + 3 * room.patches();
  second.state.factors = second.memory.data() + 6 * room.patches();
  second.run(0.001);
  CHECK(second.same_light(whole));
  CHECK(second.state.counters.shots == whole.state.counters.shots);
}

TEST_CASE("red and blue swapped: the swapped bits") {
  for (const unsigned flags : {0u, unsigned{URAD_OVERSHOOT}}) {
    Room room(11), mirror(11);
    for (auto& m : mirror.material) {
      std::swap(m.reflectance_uq15[0], m.reflectance_uq15[2]);
      std::swap(m.exitance[0], m.exitance[2]);
    }
    Solve a(room, flags), b(mirror, flags);
    CHECK(a.run(0.001) == b.run(0.001));
    int different = 0;
    for (int i = 0; i < room.patches(); ++i) {
      for (int c = 0; c < 3; ++c) {
        different += urad::radiosity_get(a.state, uint16_t(i), c) !=
                     urad::radiosity_get(b.state, uint16_t(i), 2 - c);
      }
    }
    CHECK(different == 0);
  }
}

TEST_CASE("every skip off: the same bits, other counts, all receivers accounted for") {
  for (const unsigned flags : {0u, unsigned{URAD_OVERSHOOT}}) {
    Room room(12);
    room.set(0, {0, 0, 0}, {960000, 0, 480000});  // green is dark everywhere
    Solve on(room, flags);
    on.run(0, 300);
    const auto& count = on.state.counters;
    CHECK(count.skipped_channel > 0);
    CHECK(count.skipped_black > 0);
    CHECK(count.skipped_dark > 0);
    const auto all = [&](const urad_radiosity_counters& c) {
      return c.updates + c.skipped_channel + c.skipped_black + c.skipped_dark;
    };
    CHECK(all(count) == 3u * uint32_t(room.patches()) * count.shots);
    const auto without = [&](unsigned off) {
      Solve other(room, flags | off);
      other.run(0, 300);
      CHECK(other.same_light(on));
      CHECK(all(other.state.counters) == all(count));
      return other.state.counters;
    };
    // Alone off, a skip leaves to the others what they leave out, too; alone on, it is exact.
    const uint32_t everything = without(kSkipsOff).updates;
    CHECK(everything == all(count));
    struct Skip {
      unsigned off;
      uint32_t urad_radiosity_counters::*counter;
    };
    for (const Skip skip : {Skip{URAD_SKIP_OFF_CHANNEL, &urad_radiosity_counters::skipped_channel},
                            Skip{URAD_SKIP_OFF_BLACK, &urad_radiosity_counters::skipped_black},
                            Skip{URAD_SKIP_OFF_DARK, &urad_radiosity_counters::skipped_dark}}) {
      const urad_radiosity_counters off = without(skip.off), alone = without(kSkipsOff & ~skip.off);
      CHECK(off.updates > count.updates);
      CHECK(off.*skip.counter == 0);
      CHECK(alone.updates + alone.*skip.counter == everything);
      CHECK(alone.*skip.counter >= count.*skip.counter);
    }
  }
}

TEST_CASE("no light: nothing to shoot, and asking all the same changes nothing") {
  Room room(13);
  for (auto& m : room.material) m.exitance[0] = m.exitance[1] = m.exitance[2] = 0;
  Solve solve(room), asking(room, URAD_SKIP_OFF_UNSHOT);
  CHECK(urad::radiosity_done(solve.state, 0));
  CHECK(urad::radiosity_step(&solve.state) == Status::ok);
  CHECK(room.calls == 0);
  CHECK(urad::radiosity_step(&asking.state) == Status::ok);
  CHECK(room.calls == 6);
  CHECK(asking.same_light(solve));
  CHECK(urad::radiosity_step(&solve.state) == Status::ok);
  CHECK(urad::radiosity_step(&asking.state) == Status::ok);
  CHECK(solve.state.counters.shots_empty == 2);
  CHECK(solve.state.counters.shots == 0);
  CHECK(room.calls == int(6 * solve.state.counters.shots_empty));  // what the skip spares: the runs
  CHECK(urad::radiosity_get(solve.state, 5, 1) == 0);
  CHECK(urad::radiosity_ambient(solve.state, 1) == 0);
}

TEST_CASE("one patch: its light escapes; a black scene is done before the first shot") {
  TableScene one(1, 1, 0);
  one.set(0, {0.5, 0.5, 0.5}, {1000, 2000, 3000});
  one.pod.log2_power_q24 = 12 << 24;
  Solve solve(one, URAD_OVERSHOOT);
  CHECK_FALSE(urad::radiosity_done(solve.state, 0));
  solve.run(1e-6);
  CHECK(solve.status == Status::ok);
  for (int c = 0; c < 3; ++c) CHECK(urad::radiosity_get(solve.state, 0, c) == 1000 * (c + 1));
  CHECK(urad::radiosity_audit(solve.state, nullptr));

  Room black(14);
  for (int s = 0; s < 6; ++s) black.set(s, {0, 0, 0}, {700, 0, 0});
  Solve dark(black);
  CHECK(urad::radiosity_done(dark.state, 0));
  CHECK(urad::radiosity_get(dark.state, 3, 0) == 700);
}

TEST_CASE("ambient term and display") {
  Room room(15);
  Solve solve(room);
  double area = 0, reflecting = 0, power = 0;
  for (int i = 0; i < room.patches(); ++i) {
    area += room.area(i);
    reflecting += room.area(i) * room.reflectance(i, 1);
    power += room.area(i) * room.material_of(i).exitance[1];
  }
  const double ambient = power / area / (1 - reflecting / area);
  CHECK(urad::radiosity_ambient(solve.state, 1) == doctest::Approx(ambient).epsilon(1e-4));
  CHECK(urad::radiosity_display(solve.state, 50, 1) ==
        doctest::Approx(0.8 * ambient).epsilon(1e-4));

  // Early in a solve the display is nearer to the solution than B is.
  solve.run(0, 12);
  double with = 0, without = 0;
  const Eigen::VectorXd exact = room.exact(1);
  for (int i = 0; i < room.patches(); ++i) {
    with += std::pow(urad::radiosity_display(solve.state, uint16_t(i), 1) - exact(i), 2);
    without += std::pow(urad::radiosity_get(solve.state, uint16_t(i), 1) - exact(i), 2);
  }
  CHECK(with < without);
}

TEST_CASE("the guard stops what cannot converge") {
  SUBCASE("closed, rho = 1") {
    Room room(16);
    for (int s = 0; s < 6; ++s) room.set(s, {1, 1, 1}, {s ? 0 : 5000, 0, 0});
    Solve solve(room);
    solve.run(0.001, 1000);
    CHECK(solve.status == Status::diverges);
    CHECK(solve.state.counters.shots == uint32_t(room.patches()));
  }
  SUBCASE("row sums 1.5, rho = 1, open and closed") {
    for (const uint16_t flags : {uint16_t{0}, uint16_t{URAD_SCENE_CLOSED}}) {
      Room room(17, 6, 9, 1.5);
      room.pod.flags = flags;
      for (int s = 0; s < 6; ++s) room.set(s, {1, 1, 1}, {s ? 0 : 5000, 0, 0});
      room.pod.log2_power_q24 = 0;
      Solve solve(room);
      solve.run(0.001, 10000);
      CHECK((solve.status == Status::diverges));
      CHECK(urad::radiosity_audit(solve.state, nullptr));
    }
  }
  // It stays stopped.
  Room room(18);
  for (int s = 0; s < 6; ++s) room.set(s, {1, 1, 1}, {5000, 0, 0});
  Solve solve(room);
  solve.run(0.001, 1000);
  CHECK(solve.status == Status::diverges);
  CHECK(urad::radiosity_step(&solve.state) == Status::diverges);
  CHECK(urad::radiosity_done(solve.state, 0));
}

TEST_CASE("rows above 1 that still converge: as if divided by their sum") {
  for (const double sum : {1.003, 1.1, 1.4}) {
    Room room(19, 6, 9, sum);
    Solve solve(room);
    const int shots = solve.run(1e-6);
    CHECK(solve.status == Status::ok);
    CHECK(solve.state.counters.rows_over > 0);
    CHECK(solve.state.counters.worst_row_uq16 == doctest::Approx((sum - 1) * 65536).epsilon(0.01));
    INFO("row sum ", sum, " shots ", shots, " rms ", solve.relative_rms(true));
    CHECK(solve.relative_rms(true) < 2e-5);
  }
}

TEST_CASE("init refuses and writes nothing") {
  Room room(20);
  const size_t bytes = urad::radiosity_bytes(room.pod.patch_count, 9);
  std::vector<uint32_t> memory(bytes / 4 + 1, 0xA5A5A5A5u), untouched = memory;
  urad::Radiosity state{}, blank{};
  state.shooter = blank.shooter = 12345;
  const urad_source source = room.source();
  urad_scene none = room.pod;
  none.patch_count = 0;
  urad_scene bright = room.pod;
  bright.log2_power_q24 = 20 << 24;
  const auto init = [&](const urad_scene* scene, const urad_source& from, unsigned flags,
                        uint16_t run, size_t shift, size_t size) {
    return urad::radiosity_init(&state, scene, from, flags, run,
                                reinterpret_cast<char*>(memory.data()) + shift, size);
  };
  CHECK(init(nullptr, source, 0, 9, 0, bytes) == Status::bad_argument);
  CHECK(init(&room.pod, {nullptr, &room}, 0, 9, 0, bytes) == Status::bad_argument);
  CHECK(init(&room.pod, source, 32, 9, 0, bytes) == Status::bad_argument);
  CHECK(init(&room.pod, source, 0, 0, 0, bytes) == Status::bad_argument);
  CHECK(urad::radiosity_init(&state, &room.pod, source, 0, 9, nullptr, bytes) ==
        Status::bad_argument);
  CHECK(urad::radiosity_init(nullptr, &room.pod, source, 0, 9, memory.data(), bytes) ==
        Status::bad_argument);
  CHECK(init(&none, source, 0, 9, 0, bytes) == Status::bad_scene);
  CHECK(init(&room.pod, source, 0, 9, 0, bytes - 1) == Status::out_of_memory);
  CHECK(init(&room.pod, source, 0, 10, 0, bytes) == Status::out_of_memory);
  CHECK(init(&room.pod, source, 0, 9, 1, bytes) == Status::out_of_memory);
  CHECK(init(&bright, source, 0, 9, 0, bytes) == Status::overflow);
  CHECK(memory == untouched);
  CHECK(test::same_bytes(state, blank));

  constexpr unsigned kAllFlags = 2 * URAD_SKIP_OFF_UNSHOT - 1;
  CHECK(init(&room.pod, source, kAllFlags, 9, 0, bytes) == Status::ok);
  CHECK(init(&room.pod, source, kAllFlags + 1, 9, 0, bytes) == Status::bad_argument);
  CHECK(init(&room.pod, source, 0, 9, 0, bytes) == Status::ok);
  CHECK(memory.back() == 0xA5A5A5A5u);  // exactly radiosity_bytes are used
}

TEST_CASE("overflow stops the solve with a whole state") {
  // Closed, rho = 1, two lamps just under the limit: their light meets in one small patch.
  TableScene room(3, 1, URAD_SCENE_CLOSED);
  room.set(0, {1, 1, 1}, {1 << 20, 0, 0});
  room.set(1, {1, 1, 1}, {1 << 20, 0, 0});
  room.set(2, {1, 1, 1}, {0, 0, 0});
  room.row[0][2] = room.row[1][2] = 0xFFFFFFFFu;
  room.row[2][0] = room.row[2][1] = 0x80000000u;
  room.pod.log2_power_q24 = int32_t(9.9 * 0x1p24);
  Solve solve(room);
  REQUIRE(solve.status == Status::ok);
  CHECK(urad::radiosity_step(&solve.state) == Status::ok);
  CHECK(urad::radiosity_step(&solve.state) == Status::overflow);
  CHECK(urad::radiosity_audit(solve.state, nullptr));
  CHECK(urad::radiosity_step(&solve.state) == Status::overflow);
  CHECK(urad::radiosity_done(solve.state, 0));
}

TEST_CASE(
    "a source that fails half way: the shot counts as far as it went, and the solve goes on") {
  Room room(21);
  Solve solve(room, URAD_OVERSHOOT);
  solve.run(0, 10);
  room.fail_after = 3;
  CHECK(urad::radiosity_step(&solve.state) == Status::bad_net);
  CHECK(urad::radiosity_audit(solve.state, nullptr));
  CHECK(solve.state.counters.shots == 10);
  room.fail_after = -1;
  solve.run(1e-6);
  CHECK(solve.status == Status::ok);
  CHECK(urad::radiosity_audit(solve.state, nullptr));
  CHECK(solve.relative_rms() < 0.05);  // one of some hundred shots was lopsided
}

TEST_CASE("overshooting does not grow in a room of few patches") {
  // Each patch is a third of the room: its returns, counted once for every bounce, were four times
  // what came back, and |unshot| grew fourfold with every shot.
  for (const double reflectance : {0.5, 0.9, 0.95, 0.98}) {
    CAPTURE(reflectance);
    TableScene room(3, 1, URAD_SCENE_CLOSED);
    std::mt19937 random(28);
    room.fill_reciprocal(random, 1);
    for (int s = 0; s < 3; ++s)
      room.set(s, {reflectance, reflectance, reflectance}, {s ? 0 : 100000, s ? 0 : 50000, 0});
    room.pod.log2_power_q24 = 2 << 24;
    Solve solve(room, URAD_OVERSHOOT);
    REQUIRE(solve.status == Status::ok);
    const uint64_t emitted = solve.state.remaining;
    uint64_t most = 0;
    for (int shot = 0; shot < 3000 && !urad::radiosity_done(solve.state, 4294967); ++shot) {
      REQUIRE(urad::radiosity_step(&solve.state) == Status::ok);
      most = std::max(most, solve.state.remaining);
    }
    CHECK(most <= 3 * emitted);
    CHECK(urad::radiosity_done(solve.state, 4294967));
    CHECK(solve.relative_rms(true) < 2e-3);
  }
}
