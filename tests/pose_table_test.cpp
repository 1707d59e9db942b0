// The pose table from scene to factors: exact values, equal poses merged and no others, any run,
// and tables that are refused.
#include "pose/pose_table.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/error.hpp"
#include "form_factor/reference.hpp"
#include "program.hpp"
#include "random_room.hpp"
#include "scene/builtin.hpp"
#include "scene/c_export.hpp"
#include "solve/exact.hpp"
#include "solve/scene_solver.hpp"
#include "urad/pose_table.hpp"
#include "urad/urad.h"

namespace {

constexpr unsigned kSeed = 4096;
constexpr double kUnit = 0x1p-32;

/// Every factor of a scene by its table.
std::vector<std::uint32_t> rows(const urad_scene& scene, const urad_pose_table& table,
                                urad_counters* counters) {
  const std::size_t n = scene.patch_count;
  std::vector<std::uint32_t> f_uq32(n * n, 1);
  urad::PoseSource source{&scene, &table, counters};
  for (std::uint16_t i = 0; i < n; ++i) {
    for (std::uint16_t s = 0; s < scene.surface_count; ++s) {
      const urad_surface& to = scene.surface[s];
      REQUIRE(urad::pose_fill(&source, i, s, to.first_patch, to.patch_count,
                              &f_uq32[i * n + to.first_patch]) == URAD_OK);
    }
  }
  return f_uq32;
}

/// Largest difference of the table from the reference factors, and what the layout says of it.
void check_scene(const host::Scene& scene) {
  const host::FixedScene fixed(scene);
  const host::PoseTable table = host::make_pose_table(scene, fixed, 0, 64);
  REQUIRE(urad::pose_table_check(&table.pod(), &fixed.pod()) == urad::Status::ok);
  const Eigen::MatrixXd exact = host::exact_form_factors(scene, 0, 64);
  urad_counters counters{};
  const std::size_t n = scene.patches.size();
  const std::vector<std::uint32_t> f_uq32 = rows(fixed.pod(), table.pod(), &counters);
  double off = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      off = std::max(off,
                     std::abs(f_uq32[i * n + j] * kUnit - exact(Eigen::Index(i), Eigen::Index(j))));
  MESSAGE(scene.name << ": " << n << " patches, " << table.layout().classes << " poses, "
                     << table.pod().value_count << " values, F off by " << off << " of "
                     << table.layout().difference << " allowed");
  CHECK(table.layout().difference <= 1e-3);
  CHECK(off <= table.layout().difference + 0.51 * kUnit);
  CHECK(counters.evaluated + counters.skipped_same + counters.skipped_facing == n * n - n);
  CHECK(counters.poses == counters.evaluated);
}

host::Scene room(std::mt19937& random) {
  const test::RandomRoom text = test::random_room(random, 1);
  const auto folder = std::filesystem::path(URAD_SCRATCH_DIR) / "pose_table_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "room.obj") << text.obj;
  std::ofstream(folder / "room.mtl") << text.mtl;
  return host::load_scene((folder / "room.obj").string());
}

/// A box with a plate in it: two of its walls do not see all of each other.
host::Scene box_with_plate(int cuts) {
  const auto folder = std::filesystem::path(URAD_SCRATCH_DIR) / "pose_table_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "plate.mtl") << "newmtl w\nKd .5 .5 .5\nnewmtl l\nKd 0 0 0\nKe 1 1 1\n";
  std::ofstream(folder / "plate.obj") << "mtllib plate.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv "
                                         "0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                         "v .3 .2 .5\nv .7 .2 .5\nv .7 .8 .5\nv .3 .8 .5\n"
                                         "usemtl w\nf 1 2 3 4\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf "
                                         "2 6 7 3\nf 9 10 11 12\nf 12 11 10 9\n"
                                         "usemtl l\nf 5 8 7 6\n";
  host::MeshOptions mesh;
  mesh.subdivide = cuts;
  return host::load_scene((folder / "plate.obj").string(), mesh);
}

/// A lamp that is a box, looked at from outside.
host::Scene outward_box() {
  const auto folder = std::filesystem::path(URAD_SCRATCH_DIR) / "pose_table_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "lamp.mtl") << "newmtl l\nKd .5 .5 .5\nKe 1 1 1\n";
  std::ofstream(folder / "lamp.obj")
      << "mtllib lamp.mtl\nusemtl l\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
         "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
         "f 4 3 2 1\nf 2 6 5 1\nf 8 7 3 4\nf 5 8 4 1\nf 3 7 6 2\nf 5 6 7 8\n";
  host::MeshOptions mesh;
  mesh.subdivide = 2;
  return host::load_scene((folder / "lamp.obj").string(), mesh);
}

}  // namespace

TEST_CASE("the report's cube has 224 poses, and its table is the reference to half a unit") {
  const host::Scene scene = host::load_scene("cube7");
  const host::PoseLayout layout = host::pose_layout(scene, host::FixedScene(scene));
  CHECK(layout.classes == 224);
  CHECK(layout.values() ==
        392);  // 7 x 7 for opposite walls, 7 x 7 x 7 for those that share an edge
  CHECK(layout.difference < 1e-12);
  CHECK(layout.bytes() < 2048);
  check_scene(scene);
}

TEST_CASE(
    "rooms of any size, place, turn and cuts: factors within the stated bound, all pairs counted") {
  MESSAGE("seed " << kSeed);
  std::mt19937 random(kSeed);
  for (int k = 0; k < 4; ++k) check_scene(room(random));
}

TEST_CASE("with blockers, pairs that may be hidden have factors of their own, times what is seen") {
  check_scene(box_with_plate(3));
}

TEST_CASE("poses count in a room, and not where nothing faces anything") {
  const auto poses = [](const host::Scene& scene) {
    const host::FixedScene fixed(scene);
    const host::PoseTable table = host::make_pose_table(scene, fixed, 0);
    urad_counters counters{};
    rows(fixed.pod(), table.pod(), &counters);
    return counters.poses;
  };
  CHECK(poses(host::load_scene("cube7")) == 72030);
  CHECK(poses(outward_box()) == 0);
}

TEST_CASE("a pose seen or every pair for itself: the same bits") {
  const host::Scene scene = host::load_scene("cube7");
  const host::FixedScene fixed(scene);
  const host::PoseTable table = host::make_pose_table(scene, fixed, 0);
  urad_counters counters{};
  const std::vector<std::uint32_t> seen = rows(fixed.pod(), table.pod(), &counters);
  const Eigen::MatrixXd each = host::exact_form_factors(scene, 0, 64);
  std::uint32_t evaluated = 0, different = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const auto i = Eigen::Index(k) / each.rows(), j = Eigen::Index(k) % each.rows();
    evaluated += each(i, j) > 0;
    different += std::llround(each(i, j) / kUnit) != static_cast<long long>(seen[k]);
  }
  CHECK(different == 0);
  CHECK(evaluated == counters.poses);
}

TEST_CASE("two pairs share a factor only if it is theirs") {
  // Not the same as being right: values that agree by chance must not be taken for one pose.
  const host::Scene scene = host::load_scene("cube7");
  const host::FixedScene fixed(scene);
  const host::PoseLayout layout = host::pose_layout(scene, fixed);
  std::set<long long> different;
  for (std::size_t k = 1; k < layout.factor.size(); ++k) {
    const host::PoseFactor& pair = layout.factor[k];
    different.insert(
        std::llround(0x1p40 * host::reference_form_factor(scene.patches[pair.from].polygon,
                                                          scene.patches[pair.to].polygon)));
  }
  CHECK(different.size() == 224);
}

TEST_CASE("any run of a row gives the same factors as the whole row") {
  std::mt19937 random(kSeed + 1);
  const host::Scene scene = room(random);
  const host::FixedScene fixed(scene);
  const host::PoseTable table = host::make_pose_table(scene, fixed, 0);
  const urad_scene& pod = fixed.pod();
  urad_counters counters{};
  const std::vector<std::uint32_t> whole = rows(pod, table.pod(), &counters);
  urad::PoseSource source{&pod, &table.pod(), &counters};
  for (int k = 0; k < 2000; ++k) {
    const auto shooter = std::uint16_t(random() % pod.patch_count),
               s = std::uint16_t(random() % pod.surface_count);
    const urad_surface& to = pod.surface[s];
    const auto skip = std::uint16_t(random() % to.patch_count),
               count = std::uint16_t(1 + random() % (to.patch_count - skip));
    std::vector<std::uint32_t> run(count);
    REQUIRE(urad::pose_fill(&source, shooter, s, std::uint16_t(to.first_patch + skip), count,
                            run.data()) == URAD_OK);
    const auto* from = &whole[std::size_t(shooter) * pod.patch_count + to.first_patch + skip];
    REQUIRE(std::equal(run.begin(), run.end(), from));
  }
}

TEST_CASE("solving by the table is solving exactly") {
  for (const host::Scene& scene : {host::load_scene("cube7"), box_with_plate(4)}) {
    host::SceneSolver solver(scene, 0, true, 256);
    host::SolveGoal goal;
    goal.error = 1e-4;
    const host::MethodRun run = solver.run({"table", ""}, {}, goal);
    CHECK(run.solution.status == URAD_OK);
    CHECK(run.solution.ledger_exact);
    // Sampled visibility leaves row sums off by its own error, which the solver shares out.
    CHECK(run.rms <= (scene.convex ? 2e-4 : 1e-3));
    CHECK(run.factors.max <= solver.poses().layout().difference + kUnit);
  }
}

TEST_CASE("tables that point outside their values, or belong to another scene, are refused") {
  const host::Scene scene = host::load_scene("cube7");
  const host::FixedScene fixed(scene);
  const host::PoseTable table = host::make_pose_table(scene, fixed, 0);
  const auto refused = [&](auto&& damage) {
    urad_pose_table pod = table.pod();
    std::vector<urad_pose_block> blocks(pod.block, pod.block + pod.block_count);
    pod.block = blocks.data();
    damage(pod, blocks);
    return urad::pose_table_check(&pod, &fixed.pod()) == urad::Status::bad_scene;
  };
  using Blocks = std::vector<urad_pose_block>;
  CHECK_FALSE(refused([](urad_pose_table&, Blocks&) {}));
  CHECK(refused([](urad_pose_table& t, Blocks&) { t.abi = 9; }));
  CHECK(refused([](urad_pose_table& t, Blocks&) { t.patch_count = 293; }));
  CHECK(refused([](urad_pose_table& t, Blocks&) { t.surface_count = 5; }));
  CHECK(refused([](urad_pose_table& t, Blocks&) { --t.value_count; }));
  CHECK(refused([](urad_pose_table& t, Blocks&) { --t.block_count; }));
  CHECK(refused([](urad_pose_table& t, Blocks&) { t.block_of = nullptr; }));
  CHECK(refused([](urad_pose_table&, Blocks& b) { b[0].first = 0xFFFFFFFFu; }));
  CHECK(refused([](urad_pose_table&, Blocks& b) { b[0].axis[0].stride = INT32_MAX; }));
  CHECK(refused([](urad_pose_table&, Blocks& b) { b[0].axis[1].offset = 4000; }));
  CHECK(refused([](urad_pose_table&, Blocks& b) { b[0].axis[0].from_u = 2; }));
  CHECK(refused([](urad_pose_table&, Blocks& b) { b[0].mirror[0] = 3; }));
  CHECK(refused([](urad_pose_table&, Blocks& b) { b[0].from_stride[0] = -1000; }));
  CHECK(urad::pose_table_check(nullptr, &fixed.pod()) == urad::Status::bad_argument);
}

TEST_CASE("the C interface loads the same factors, and refuses what it cannot use") {
  const host::Scene scene = host::load_scene("cube7");
  const host::FixedScene fixed(scene);
  const host::PoseTable table = host::make_pose_table(scene, fixed, 0);
  urad_counters counters{};
  const std::vector<std::uint32_t> whole = rows(fixed.pod(), table.pod(), &counters);
  std::vector<std::uint64_t> memory(8);
  REQUIRE(urad_pose_source_bytes() <= 8 * memory.size());
  urad_source source{};
  CHECK(urad_pose_source_init(&source, &fixed.pod(), &table.pod(), &counters, memory.data(), 1) ==
        URAD_OUT_OF_MEMORY);
  CHECK(urad_pose_source_init(&source, &fixed.pod(), nullptr, &counters, memory.data(), 64) ==
        URAD_BAD_ARGUMENT);
  REQUIRE(urad_pose_source_init(&source, &fixed.pod(), &table.pod(), &counters, memory.data(),
                                64) == URAD_OK);
  std::vector<std::uint32_t> run(49);
  REQUIRE(source.fill(source.context, 100, 5, 245, 49, run.data()) == URAD_OK);
  CHECK(std::equal(run.begin(), run.end(), &whole[100 * 294 + 245]));
  CHECK(urad_pose_table_check(&table.pod(), &fixed.pod()) == URAD_OK);
  CHECK(urad_pose_table_check(&table.pod(), nullptr) == URAD_BAD_ARGUMENT);
}

TEST_CASE("too large a table is refused with what would do") {
  host::MeshOptions mesh;
  mesh.subdivide = 30;
  const host::Scene scene = host::load_scene("cube7", mesh);
  CHECK(scene.patches.size() > host::kMostPosePatches);
  CHECK_THROWS_WITH_AS(host::pose_layout(scene, host::FixedScene(scene)),
                       doctest::Contains("coarser mesh"), host::Error);
  const host::Scene plate = box_with_plate(15);
  CHECK_THROWS_WITH_AS(host::pose_layout(plate, host::FixedScene(plate)),
                       doctest::Contains("blockers"), host::Error);
}

TEST_CASE("exported tables compile as C99 and C++17 and hold the same integers") {
  const auto folder = std::filesystem::path(URAD_SCRATCH_DIR) / "pose_export_test";
  std::filesystem::create_directories(folder);
  const host::Scene scene = host::load_scene("cube7");
  const host::FixedScene fixed(scene);
  const host::PoseTable table = host::make_pose_table(scene, fixed, 0);
  const std::string text = host::poses_to_c(table, "cube7", "urad bake */ x");
  CHECK(text ==
        host::poses_to_c(host::make_pose_table(scene, fixed, 1), "cube7", "urad bake */ x"));
  CHECK_THROWS_AS(host::poses_to_c(table, "my cube", "x"), host::Error);
  std::ofstream(folder / "poses.h") << text;
  std::ofstream(folder / "scene.h") << host::scene_to_c(fixed, "cube7", "urad bake cube7");
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < table.pod().value_count; ++k)
    sum = sum * 31 + table.pod().value_uq32[k];
  std::ofstream(folder / "main.c")
      << "#include \"urad/urad.h\"\n#include \"scene.h\"\n#include \"poses.h\"\n"
         "int main(void) {\n  uint32_t sum = 0, k;\n"
         "  for (k = 0; k < urad_cube7_poses.value_count; ++k) sum = sum * 31 + "
         "urad_cube7_poses.value_uq32[k];\n"
         "  return sum != "
      << sum << "u || urad_pose_table_check(&urad_cube7_poses, &urad_cube7_scene) != URAD_OK;\n}\n";
  std::filesystem::copy_file(folder / "main.c", folder / "main.cpp",
                             std::filesystem::copy_options::overwrite_existing);
#ifdef URAD_SANITIZED
  const std::string as_the_archive = " -fsanitize=address,undefined";
#else
  const std::string as_the_archive;
#endif
  const std::string flags =
      as_the_archive +
      " -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I" URAD_SOURCE_DIR
      "/firmware_style/include -o " +
      (folder / "main").string() + " " + folder.string();
  CHECK(test::runs(URAD_CC " -std=c99 -c" + flags + "/main.c"));
  CHECK(test::runs(URAD_CXX " -std=c++17 " + flags + "/main.cpp " URAD_ENGINE_ARCHIVE));
  CHECK(test::runs((folder / "main").string()));
  std::filesystem::remove_all(folder);
}
