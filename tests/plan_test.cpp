// Plans: sizes as the engine and the exporter have them, shots as they come out, limits that decide,
// and advice that helps.
#include "plan/plan.hpp"

#include <doctest/doctest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "network/net_json.hpp"
#include "plan/chip_bytes.hpp"
#include "plan/constants.hpp"
#include "plan/rehearsal.hpp"
#include "program.hpp"
#include "random_room.hpp"
#include "scene/builtin.hpp"
#include "scene/c_export.hpp"
#include "solve/scene_solver.hpp"
#include "urad/hybrid.hpp"
#include "urad/pose_table.hpp"
#include "urad/radiosity.hpp"
#include "urad/urad.h"
#include "weights/general.h"

namespace {

constexpr unsigned kSeed = 31415;

const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_general; }};

host::Scene room(unsigned seed) {
  std::mt19937 random(seed);
  const test::RandomRoom text = test::random_room(random, 1);
  const auto folder = std::filesystem::path(URAD_SCRATCH_DIR) / "plan_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "room.obj") << text.obj;
  std::ofstream(folder / "room.mtl") << text.mtl;
  return host::load_scene((folder / "room.obj").string());
}

const host::PlannedMethod& line(const host::Plan& plan, const std::string& method) {
  for (const host::PlannedMethod& m : plan.methods)
    if (m.method == method && m.setting.empty()) return m;
  FAIL("no line for " << method);
  return plan.methods.front();
}

host::Plan plan_of(const host::Scene& scene, std::size_t ram, std::size_t flash, double error) {
  host::PlanRequest request;
  request.ram = ram, request.flash = flash, request.error = error;
  return host::make_plan(scene, kNets, request);
}

}  // namespace

TEST_CASE("structs take on a Cortex-M0 what the plan says") {
  const auto folder = std::filesystem::path(URAD_SCRATCH_DIR) / "plan_test";
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / "sizes.cpp");
  file << "#include \"urad/hybrid.hpp\"\n#include \"urad/pose_table.hpp\"\n#include "
          "\"urad/radiosity.hpp\"\n";
  const auto holds = [&](const char* type, std::size_t bytes) {
    file << "static_assert(sizeof(" << type << ") == " << bytes << ", \"\");\n";
  };
  holds("urad::Radiosity", host::kStateBytes);
  holds("urad_counters", host::kCountersBytes);
  holds("urad::PairSource", host::kPairSourceBytes);
  holds("urad::PoseSource", host::kPoseSourceBytes);
  holds("urad::HemicubeSource", host::kHemicubeSourceBytes);
  holds("urad::HybridSource", host::kHybridSourceBytes);
  file.close();
  const std::string command =
      "arm-none-eabi-g++ -mcpu=cortex-m0 -mthumb -std=c++17 -ffreestanding "
      "-fsyntax-only -I" URAD_SOURCE_DIR "/firmware_style/include " +
      (folder / "sizes.cpp").string();
  CHECK(test::runs(command));
}

TEST_CASE("bytes are those of the engine's functions and of the exporter") {
  const host::NetFile net = host::read_net(URAD_SOURCE_DIR "/weights/general.json");
  for (const int bits : {8, 16}) {
    const auto& tables = net.quantised(bits).tables();
    CHECK(host::net_flash(tables.inputs, tables.hidden, bits) ==
          std::size_t(net.quantised(bits).flash_bytes()));
  }
  for (const char* name : {"cube7", "cornell"}) {
    const host::Scene scene = host::load_scene(name);
    const host::FixedScene fixed(scene);
    const urad_scene& pod = fixed.pod();
    const bool convex = scene.convex;
    const unsigned flags = URAD_HEMICUBE_TURNED | unsigned(convex ? 0 : URAD_HEMICUBE_COVERAGE);
    for (const int rows : {convex ? 0 : 64, convex ? 0 : 8}) {
      CHECK(host::hemicube_ram(pod, 64, rows, !convex) - host::kHemicubeSourceBytes ==
            urad_hemicube_source_bytes(&pod, 64, std::uint16_t(rows), flags) -
                sizeof(urad::HemicubeSource));
    }
    CHECK(host::scene_to_c(fixed, "room", "x")
              .find(fmt::format("size      {} bytes", host::scene_flash_bytes(pod, false))) !=
          std::string::npos);
    const host::Plan plan = plan_of(scene, SIZE_MAX, SIZE_MAX, 0.01);
    CHECK(line(plan, "table").data ==
          host::scene_flash_bytes(pod, false) + host::pose_layout(scene, fixed).bytes());
    CHECK(line(plan, "fixed-moment").ram ==
          URAD_RADIOSITY_BYTES(pod.patch_count, urad_longest_run(&pod)) + host::kStateBytes +
              host::kCountersBytes + host::kPairSourceBytes);
  }
}

TEST_CASE("exported visibility: bytes of the exporter, no rays, and the error that comes out") {
  const host::Scene scene = host::load_scene("louvre", {4, 0});
  host::PlanRequest request;
  const host::Plan without = host::make_plan(scene, kNets, request);
  request.visibility = true;
  const host::Plan plan = host::make_plan(scene, kNets, request);
  CHECK(plan.methods.size() == without.methods.size() + 2);
  const host::PlannedMethod& rays = line(plan, "net");
  host::SceneSolver solver(scene, 0, true);
  host::SolveGoal goal;
  goal.error = 1e-4;
  for (const char* name : {"fractions", "bits"}) {
    CAPTURE(name);
    const auto found = std::find_if(plan.methods.begin(), plan.methods.end(), [&](const auto& m) {
      return m.setting == std::string("bake --visibility ") + name;
    });
    REQUIRE(found != plan.methods.end());
    const host::PlannedMethod& exported = *found;
    solver.use_visibility(host::parse_visibility_code(name));
    const urad_scene& pod = solver.fixed().pod();
    CHECK(exported.data ==
          host::scene_flash_bytes(pod, scene.closed) +
              host::net_flash(urad_general.inputs, urad_general.hidden, urad_general.weight_bits));
    CHECK(exported.ram == rays.ram);
    CHECK(exported.code == rays.code);
    CHECK(exported.per_solve < rays.per_solve);
    const double measured = std::hypot(solver.run(host::parse_method("net"), kNets, goal).rms,
                                       host::kStopShare * request.error);
    MESSAGE(std::string(name) << ": planned " << exported.error << ", measured " << measured);
    CHECK(exported.error <= 2 * measured);
    CHECK(exported.error >= measured / 2);
  }
}

TEST_CASE("a rehearsal takes about as many shots as the solve with exact factors") {
  MESSAGE("seed " << kSeed);
  for (unsigned k = 0; k < 3; ++k) {
    const host::Scene scene = k == 0 ? host::load_scene("cube7") : room(kSeed + k);
    const host::FixedScene fixed(scene);
    const host::Rehearsal rehearsal = host::rehearse(fixed, 0.01);
    CHECK(rehearsal.complete);
    const host::PoseTable table = host::make_pose_table(scene, fixed, 0);
    urad_counters counters{};
    urad::PoseSource poses{&fixed.pod(), &table.pod(), &counters};
    const std::uint16_t run = urad::longest_run(fixed.pod());
    std::vector<std::uint32_t> memory(urad::radiosity_bytes(fixed.pod().patch_count, run) / 4);
    urad_radiosity state;
    REQUIRE(urad::radiosity_init(&state, &fixed.pod(), {urad::pose_fill, &poses}, URAD_OVERSHOOT,
                                 run, memory.data(), 4 * memory.size()) == urad::Status::ok);
    while (!urad::radiosity_done(state, URAD_PERCENT))
      REQUIRE(urad::radiosity_step(&state) == urad::Status::ok);
    CHECK(rehearsal.shots == doctest::Approx(state.counters.shots).epsilon(0.15));
    CHECK(rehearsal.updates == doctest::Approx(state.counters.updates).epsilon(0.15));
  }
}

TEST_CASE("limits decide what fits, and the cheapest of that is recommended") {
  const host::Scene scene = host::load_scene("cube7");
  const host::Plan any = plan_of(scene, SIZE_MAX, SIZE_MAX, 0.01);
  REQUIRE(any.recommended);
  const host::PlannedMethod& best = any.methods[*any.recommended];
  CHECK(best.method == "table");
  for (const host::PlannedMethod& m : any.methods)
    if (m.fits()) CHECK(m.per_solve >= best.per_solve);
  // Less flash than the table asks for: something else, or nothing.
  const host::Plan tight = plan_of(scene, best.ram, best.flash() - 1, 0.01);
  CHECK_FALSE(line(tight, "table").fits());
  CHECK(line(tight, "table").misfit == "needs 1 more bytes of flash");
  CHECK_FALSE(tight.recommended);
  CHECK(tight.advice.find(fmt::format("--flash {}", best.flash())) != std::string::npos);
  CHECK(plan_of(scene, best.ram, best.flash(), 0.01).recommended);
  CHECK_FALSE(plan_of(scene, best.ram - 1, best.flash(), 0.01).recommended);
  // A finer error leaves out what cannot reach it.
  const host::Plan fine = plan_of(scene, SIZE_MAX, SIZE_MAX, 1e-3);
  CHECK_FALSE(line(fine, "hemicube:32").fits());
  CHECK(line(fine, "table").fits());
  CHECK(fine.shots > any.shots);
}

TEST_CASE("where nothing is accurate enough, the error that would do does") {
  const host::Scene scene = host::load_scene("cornell");
  const host::Plan fine = plan_of(scene, SIZE_MAX, 65536, 1e-5);
  CHECK_FALSE(fine.recommended);
  const std::size_t at = fine.advice.find("--error ");
  REQUIRE(at != std::string::npos);
  CHECK(plan_of(scene, SIZE_MAX, 65536, std::stod(fine.advice.substr(at + 8))).recommended);
}

TEST_CASE("an item buffer takes the highest bands that the RAM holds") {
  const host::Scene scene = host::load_scene("cornell");
  const host::Plan roomy = plan_of(scene, SIZE_MAX, SIZE_MAX, 0.02);
  const host::PlannedMethod whole = line(roomy, "hybrid:64");
  const host::Plan tight = plan_of(scene, whole.ram - 1, SIZE_MAX, 0.02);
  for (const host::PlannedMethod& m : tight.methods) {
    if (m.method != "hybrid:64") continue;
    CHECK(m.setting == "bands of 32 rows");
    CHECK(m.ram < whole.ram);
    CHECK(m.per_shot > whole.per_shot);
  }
}

TEST_CASE("what is planned is what comes out, on a room no constant has seen") {
  const host::Scene scene = room(kSeed + 9);
  const host::Plan plan = plan_of(scene, SIZE_MAX, SIZE_MAX, 0.01);
  host::SceneSolver solver(scene, 0, true);
  host::SolveGoal goal;
  goal.error = 1e-4;
  for (const char* method : {"fixed-moment", "net", "fixed-lambert:1", "hybrid:32"}) {
    const double of_stop = host::kStopShare * 0.01;
    const double measured =
        std::hypot(solver.run(host::parse_method(method), kNets, goal).rms, of_stop);
    const double planned = line(plan, method).error;
    MESSAGE(std::string(method) << ": planned " << planned << ", measured " << measured);
    CHECK(planned <= 2 * measured);
    CHECK(planned >= measured / 2);
  }
}

TEST_CASE("plans are the same every time, and their JSON says what the table says") {
  const host::Scene scene = room(kSeed + 3);
  const host::Plan plan = plan_of(scene, 16384, 65536, 0.01);
  CHECK(host::plan_json(plan) == host::plan_json(plan_of(scene, 16384, 65536, 0.01)));
  const auto json = nlohmann::json::parse(host::plan_json(plan));
  CHECK(json.at("methods").size() == plan.methods.size());
  CHECK(json.at("ram") == 16384);
  const std::string text = host::plan_text(plan);
  for (const host::PlannedMethod& m : plan.methods) CHECK(text.find(m.method) != std::string::npos);
  CHECK(text.find(plan.advice) != std::string::npos);
}

TEST_CASE("a scene without light has no plan") {
  host::Scene scene = host::load_scene("cube7");
  for (host::Material& material : scene.materials) material.exitance = host::Vec3(0);
  CHECK_THROWS_WITH_AS(plan_of(scene, SIZE_MAX, SIZE_MAX, 0.01), doctest::Contains("emits light"),
                       host::Error);
}
