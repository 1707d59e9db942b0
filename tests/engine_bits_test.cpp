// Every bit that the engine makes of standard scenes, random pairs, solves and changes, by the CRC-32 of each: what
// alters one is a decision, and vectors/engine_bits.csv says so. URAD_REWRITE=1 writes that file anew.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "../firmware_style/src/crc32.hpp"
#include "method/engine_source.hpp"
#include "radiosity_scene.hpp"
#include "scene/builtin.hpp"
#include "urad/move.hpp"
#include "urad/urad.h"
#include "weights/general.h"

namespace {

constexpr unsigned kSeed = 2026;
constexpr int kPairs = 600;
const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_general; }};

template <class Object>
void add(urad::Crc32* crc, const Object& object) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(&object);
  for (size_t k = 0; k < sizeof object; ++k) crc->byte(bytes[k]);
}

/// What the file says of each case, or what it is to say.
class Recorded {
 public:
  ~Recorded() {
    if (!rewrite_) return;
    std::map<std::string, std::string> all = read();
    for (const auto& [name, bits] : seen_) all[name] = bits;
    std::ofstream file(kFile);
    for (const auto& [name, bits] : all) file << name << ',' << bits << '\n';
  }
  void check(const std::string& name, const urad::Crc32& crc) {
    const std::string bits = fmt::format("{:08x}", crc.value());
    seen_[name] = bits;
    CAPTURE(name);
    if (!rewrite_) CHECK(bits == recorded_[name]);
  }

 private:
  static constexpr const char* kFile = URAD_SOURCE_DIR "/tests/vectors/engine_bits.csv";
  static std::map<std::string, std::string> read() {
    std::map<std::string, std::string> all;
    std::ifstream file(kFile);
    for (std::string name, bits; std::getline(file, name, ',') && std::getline(file, bits);)
      all[name] = bits;
    return all;
  }
  const bool rewrite_ = std::getenv("URAD_REWRITE") != nullptr;
  std::map<std::string, std::string> recorded_ = read(), seen_;
};

/// Rows of every `stride`-th shooter, and all counts.
urad::Crc32 rows(const host::FixedScene& scene, const std::string& method,
                 const host::EngineOptions& options, int stride) {
  const host::EngineSource source(scene, host::parse_method(method), kNets, options);
  std::vector<std::uint32_t> row(scene.pod().patch_count);
  urad::Crc32 crc;
  for (int i = 0; i < scene.pod().patch_count; i += stride) {
    source.row(std::uint16_t(i), row.data());
    for (const std::uint32_t f_uq32 : row) crc.word(f_uq32);
  }
  add(&crc, source.counters());
  return crc;
}

/// Two polygons of 3 to 8 corners, convex or not, that may reach behind each other, and up to two
/// blockers. Without sines, whose last bit is the library's.
host::FixedScene random_pair(std::mt19937* random) {
  const auto uniform = [random](double low, double high) {
    return low + (high - low) * (double((*random)()) + 0.5) / 0x1p32;
  };
  const auto polygon = [&](const host::Vec3& centre, double size) {
    const host::Vec3 x = glm::normalize(host::Vec3{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
    const host::Vec3 y = glm::normalize(glm::cross(x, host::Vec3{uniform(0, 1), uniform(0, 1), 0}));
    const host::Vec3 z = glm::cross(x, y);
    static constexpr double kAround[8][2] = {{1, 0},  {.75, .7},   {0, 1},  {-.7, .75},
                                             {-1, 0}, {-.7, -.75}, {0, -1}, {.75, -.7}};
    const bool dented = uniform(0, 1) < 0.5;
    const int corners = 3 + int(uniform(0, 6));
    host::Polygon p;
    for (int k = 0; k < corners; ++k) {
      const double* at = kAround[8 * k / corners];
      const double radius = size * (dented ? uniform(0.3, 1) : 1);
      p.outer.push_back(centre + radius * (at[0] * y + at[1] * z));
    }
    return p;
  };
  const double distance = uniform(0.3, 4), size = uniform(0.1, 1.5);
  const host::Polygon p = polygon({0, 0, 0}, 1), q = polygon({0.3, -0.2, distance}, size);
  std::vector<host::Polygon> blockers(size_t(uniform(0, 3)));
  for (host::Polygon& blocker : blockers) {
    const double aside = uniform(-0.3, 0.3);
    blocker = polygon({0.2, aside, distance / 2}, uniform(0.05, 0.7));
  }
  return host::FixedScene::of_polygons({p, q}, blockers);
}

/// Light, state and what a renderer is told.
urad::Crc32 light(const test::Solve& solve) {
  urad::Crc32 crc;
  for (const std::uint32_t word : solve.memory) crc.word(word);
  const urad_radiosity& s = solve.state;
  add(&crc, s.reflected);
  add(&crc, s.ledger);
  crc.word(urad::radiosity_error_uq32(s));
  for (int c = 0; c < 3; ++c) {
    crc.word(urad::radiosity_ambient(s, c));
    for (int i = 0; i < solve.scene.patches(); ++i)
      crc.word(urad::radiosity_get(s, std::uint16_t(i), c));
  }
  return crc;
}

}  // namespace

TEST_CASE("rows of standard scenes by every method of the engine") {
  Recorded recorded;
  for (const char* name : {"cube7", "cornell", "room", "louvre", "gallery"}) {
    const host::FixedScene scene(host::load_scene(name, {2, 0}));
    for (const char* method :
         {"fixed-kernel", "net", "auto:0.01", "hemicube:16", "hemicube:34", "hybrid:16"})
      recorded.check(fmt::format("{} {}", name, method), rows(scene, method, {.rays = 8}, 3));
    recorded.check(fmt::format("{} rays by worth", name),
                   rows(scene, "fixed-moment", {.rays = 64, .ray_error = 1 / 64., .cuts = 3}, 7));
    recorded.check(fmt::format("{} small ones left out", name),
                   rows(scene, "net", {.rays = 8, .bound = 0.0625}, 7));
  }
}

TEST_CASE("random pairs, dented, cut and hidden, by every method that goes pair by pair") {
  MESSAGE("seed ", kSeed);
  Recorded recorded;
  for (const char* method : {"fixed-kernel", "fixed-moment", "net", "fixed-lambert:1",
                             "fixed-lambert:2", "auto:0.1", "auto:0.01", "auto:0.0001"}) {
    std::mt19937 random(kSeed);
    urad::Crc32 crc;
    for (int k = 0; k < kPairs; ++k) {
      const host::FixedScene scene = random_pair(&random);
      crc.word(rows(scene, method, {.rays = 16}, 1).value());
    }
    recorded.check(fmt::format("random pairs {}", method), crc);
  }
  std::mt19937 random(kSeed + 1);
  urad::Crc32 worth;
  for (int k = 0; k < kPairs; ++k) {
    const host::FixedScene scene = random_pair(&random);
    worth.word(rows(scene, "net", {.rays = 256, .ray_error = 0.01, .cuts = 1 + k % 6}, 1).value());
  }
  recorded.check("random pairs rays by worth", worth);
}

TEST_CASE("a solve after every few shots, with lamps that change and walls that are painted") {
  Recorded recorded;
  for (const unsigned flags : {0u, unsigned{URAD_OVERSHOOT}}) {
    test::TableScene room(6, 9, URAD_SCENE_CLOSED);
    room.fill_cube();
    test::furnish(&room);
    test::Solve solve(room, flags);
    std::vector<std::uint32_t> memory(URAD_RELIGHT_BYTES(54) / 4);
    REQUIRE(urad::radiosity_relight_init(&solve.state, memory.data(), 4 * memory.size()) ==
            urad::Status::ok);
    urad::Crc32 crc;
    const auto shots = [&](int count) {
      for (int k = 0; k < count; ++k) {
        REQUIRE(urad::radiosity_step(&solve.state) == urad::Status::ok);
        if (k % 8 == 7) crc.word(light(solve).value());
      }
    };
    shots(64);
    const std::int32_t brighter[3] = {1200000, 700001, 3}, dark[3] = {0, 0, 0};
    REQUIRE(urad::radiosity_set_emission(&solve.state, 3, brighter) == urad::Status::ok);
    REQUIRE(urad::radiosity_set_emission(&solve.state, 5, dark) == urad::Status::ok);
    shots(32);
    constexpr std::uint16_t kPaint[3][3] = {{9000, 0, 20000}, {3, 30000, 9000}, {0, 0, 0}};
    for (const size_t wall : {1u, 0u, 2u}) {
      REQUIRE(urad::radiosity_set_reflectance(&solve.state, &room.material[wall], kPaint[wall]) ==
              urad::Status::ok);
      crc.word(light(solve).value());
      shots(32);
    }
    recorded.check(fmt::format("solve {}", flags ? "overshooting" : "plain"), crc);
  }
}

TEST_CASE("which pairs a moving box touches, and the light without them") {
  Recorded recorded;
  MESSAGE("seed ", kSeed);
  std::mt19937 random(kSeed);
  const host::FixedScene fixed(host::load_scene("cornell", {2, 0}));
  const urad_scene& scene = fixed.pod();
  const host::EngineSource source(fixed, host::parse_method("fixed-moment"), kNets, {.rays = 4});
  const std::uint16_t run = urad::longest_run(scene);
  std::vector<std::uint32_t> memory(urad::radiosity_bytes(scene.patch_count, run) / 4);
  urad_radiosity solve{};
  REQUIRE(urad::radiosity_init(&solve, &scene, source.source(), URAD_OVERSHOOT, run, memory.data(),
                               4 * memory.size()) == urad::Status::ok);
  REQUIRE(urad::radiosity_steps(&solve, 12, 0, nullptr) == urad::Status::ok);
  urad::Crc32 crc;
  for (int k = 0; k < 6; ++k) {
    urad_move move{};
    move.first_patch = std::uint16_t(random() % scene.patch_count);
    move.patch_count = std::uint16_t(k % 3);
    if (move.first_patch + move.patch_count > scene.patch_count) move.first_patch = 0;
    move.box_count = std::uint16_t(1 + k % 2);
    for (urad_box& box : move.box) {
      for (std::int32_t urad_point::*x : {&urad_point::x, &urad_point::y, &urad_point::z}) {
        box.low.*x = std::int32_t(random() % (1u << 29)) - (1 << 28);
        box.high.*x = box.low.*x + std::int32_t(random() % (1u << 27));
      }
    }
    REQUIRE(urad::radiosity_move_begin(&solve, &move) == urad::Status::ok);
    for (const std::uint32_t word : memory) crc.word(word);
    REQUIRE(urad::radiosity_move_end(&solve, &move, nullptr, nullptr) == urad::Status::ok);
    crc.word(move.made), crc.word(move.kept);
    for (const std::uint32_t word : memory) crc.word(word);
    add(&crc, solve.ledger);
  }
  recorded.check("moves", crc);
}

TEST_CASE("CRCs of scenes with repair and without, of grids and polygon lists") {
  Recorded recorded;
  const auto check = [&](const std::string& name, const urad_scene& scene) {
    std::uint32_t crc32[2];
    REQUIRE(urad_scene_crc32(&scene, crc32) == URAD_OK);
    urad::Crc32 both;
    both.word(crc32[0]), both.word(crc32[1]);
    recorded.check(name, both);
  };
  for (const char* name : {"cube7", "louvre"}) {
    host::FixedScene scene(host::load_scene(name, {1, 0}));
    check(fmt::format("{} crc32", name), scene.pod());
    scene.set_scale(std::vector<double>(scene.pod().patch_count, 0.75));
    check(fmt::format("{} crc32 repaired", name), scene.pod());
  }
  std::mt19937 random(kSeed);
  check("random pair crc32", random_pair(&random).pod());
}
