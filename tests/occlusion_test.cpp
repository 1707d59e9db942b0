// Rays as many as a pair is worth: against exact obstructed factors, exactly dark where it is dark,
// and no light through touching walls.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "form_factor/reference.hpp"
#include "method/engine_source.hpp"
#include "network/general_pairs.hpp"
#include "scene/builtin.hpp"
#include "scene/obj.hpp"
#include "solve/embree_visibility.hpp"
#include "solve/fixed_solve.hpp"
#include "urad/form_factor.hpp"
#include "urad/urad.h"
#include "weights/general.h"

namespace {

using host::Polygon;
using host::Vec3;

const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_general; }};
constexpr unsigned kSeed = 1996;

/// A quad about `centre`, turned at random.
Polygon random_blocker(std::mt19937_64& random, const Vec3& centre, double size) {
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return glm::normalize(Vec3(normal(random), normal(random), normal(random)));
  };
  const Vec3 u = direction(), v = glm::normalize(glm::cross(u, direction()));
  return {{centre - size * u, centre - size * v, centre + size * u, centre + size * v}, {}};
}

struct Occluded {
  Polygon p, q;
  std::vector<Polygon> blockers;
};

/// One to four blockers around the middle between two quads.
Occluded random_pair(std::uint64_t seed, std::uint64_t index) {
  std::mt19937_64 random(seed + index);
  std::uniform_real_distribution<double> unit(0, 1);
  const host::PolygonPair pair = host::general_pair(host::PairFamily::free, seed, index);
  Occluded result{pair.p, pair.q, {}};
  const Vec3 a = host::moments(pair.p).centroid, b = host::moments(pair.q).centroid;
  const double size = std::sqrt(host::moments(pair.p).area + host::moments(pair.q).area);
  for (std::uint64_t k = random() % 4 + 1; k > 0; --k) {
    const Vec3 aside(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
    result.blockers.push_back(random_blocker(
        random, a + (0.2 + 0.6 * unit(random)) * (b - a) + size * aside, size * unit(random)));
  }
  return result;
}

/// Exact factor times the visible fraction of 65,536 rays.
double truth(const Occluded& pair) {
  host::Scene scene;
  for (const Polygon& polygon : {pair.p, pair.q}) {
    scene.surfaces.push_back({"", 0, int(scene.patches.size()), 1, true, std::nullopt});
    scene.patches.push_back({polygon, host::moments(polygon), int(scene.patches.size())});
  }
  for (const Polygon& blocker : pair.blockers) scene.blockers.push_back({blocker, -1});
  return host::EmbreeVisibility(scene, 65536).fraction(0, 1) *
         host::reference_exchange(pair.p, pair.q) / scene.patches[0].moments.area;
}

/// Factor 0 -> 1 with and without the blockers.
struct Answer {
  double open, f;
};

Answer by_engine(const Occluded& pair, urad_counters* counters) {
  const host::FixedScene fixed = host::FixedScene::of_polygons({pair.p, pair.q}, pair.blockers);
  urad_counters unread{};
  urad::PairSource source{&fixed.pod(), &urad_general, urad::Kernel::moment, 0, 0, &unread};
  std::uint32_t open = 0, f = 0;
  REQUIRE(urad::pair_fill(&source, 0, 1, 1, 1, &open) == URAD_OK);
  source.rays = 64;
  source.error_uq32 = 1 << 23;  // 0.2 %
  source.depth = 3;
  source.counters = counters;
  REQUIRE(urad::pair_fill(&source, 0, 1, 1, 1, &f) == URAD_OK);
  return {open * 0x1p-32, f * 0x1p-32};
}

/// A lit room of 2 x 2 x 2 and, inside, a closed box of two-sided walls, turned by `angle`.
host::Scene room_with_box(double angle) {
  std::string obj = "mtllib m\n";
  const auto box = [&](double half, double turn) {
    for (int k = 0; k < 8; ++k) {
      const double x = k & 1 ? half : -half, y = k & 2 ? half : -half, z = k & 4 ? half : -half;
      obj += fmt::format("v {} {} {}\n", x * std::cos(turn) - z * std::sin(turn), y + 0.1 * turn,
                         x * std::sin(turn) + z * std::cos(turn));
    }
  };
  box(1, 0);
  box(0.45, angle);
  // Counter-clockwise from inside.
  const int faces[6][4] = {{1, 5, 6, 2}, {3, 4, 8, 7}, {1, 3, 7, 5},
                           {2, 6, 8, 4}, {5, 7, 8, 6}, {1, 2, 4, 3}};
  const auto face = [&](const int* f, int first, bool inwards) {
    obj += inwards ? fmt::format("f {} {} {} {}\n", f[0] + first, f[1] + first, f[2] + first,
                                 f[3] + first)
                   : fmt::format("f {} {} {} {}\n", f[3] + first, f[2] + first, f[1] + first,
                                 f[0] + first);
  };
  for (int k = 0; k < 6; ++k) {
    obj += k == 1 ? "usemtl lamp\n" : "usemtl wall\n";
    face(faces[k], 0, true);
  }
  obj += "usemtl outside\n";
  for (const auto& f : faces) face(f, 8, false);
  obj += "usemtl inside\n";
  for (const auto& f : faces) face(f, 8, true);
  constexpr const char* kMaterials =
      "newmtl lamp\nKd .5 .5 .5\nKe 9 9 9\nnewmtl wall\nKd .7 .7 .7\nnewmtl outside\nKd .6 .6 .6\n"
      "newmtl inside\nKd .9 .9 .9\n";
  return host::parse_obj(obj, "box", {4, 0}, [](const std::string&) { return kMaterials; });
}

}  // namespace

TEST_CASE("200 occluded pairs: F to 2e-3, never above the open one, blocked exactly 0") {
  for (const std::uint64_t seed : {kSeed, kSeed + 1000, kSeed + 2000}) {
    double squares = 0, worst = 0;
    int found = 0, partly = 0, dark = 0;
    urad_counters counters{};
    for (std::uint64_t index = 0; found < 200; ++index) {
      const Occluded pair = random_pair(seed, index);
      const double exact = truth(pair);
      urad_counters one{};
      const Answer answer = by_engine(pair, &one);
      CHECK(answer.f <= answer.open);
      if (answer.open == 0 || one.rays + one.shut_unseen == 0) continue;  // nothing between them
      ++found;
      counters.rays += one.rays;
      const double off = answer.f - exact;
      squares += off * off;
      worst = std::max(worst, std::fabs(off));
      partly += answer.f > 0 && answer.f < answer.open;
      if (exact == 0) {
        ++dark;
        CHECK(answer.f == 0);
        CHECK(one.blocked == 1);
      }
    }
    const double std = std::sqrt(squares / found);
    MESSAGE("seed " << seed << ": F std " << std << ", worst " << worst << "; " << partly
                    << " partly, " << dark << " dark; rays a pair " << counters.rays / 200.0);
    CHECK(std <= 2e-3);
    CHECK(partly > 50);
    CHECK(dark > 5);
  }
}

TEST_CASE("a sealed box in a lit room stays dark inside, by rays and by hybrid") {
  for (const double angle : {0.0, 0.3}) {
    const host::Scene scene = room_with_box(angle);
    CHECK(scene.blockers.size() == 6);
    const host::FixedScene fixed(scene);
    for (const host::EngineOptions& options :
         {host::EngineOptions{.rays = 16},
          host::EngineOptions{.rays = 16, .ray_error = 1e-3, .cuts = 3}}) {
      for (const char* method : {"net", "hybrid:32"}) {
        CAPTURE(angle);
        CAPTURE(std::string(method));
        const host::EngineRows rows =
            host::engine_rows(fixed, host::parse_method(method), kNets, options, 0);
        host::SolveGoal goal;
        goal.shots = 200;
        const host::FixedSolution solution = host::fixed_solve(
            scene, fixed, rows, std::vector<Vec3>(scene.patches.size(), Vec3(0)), goal);
        int inside = 0, outside = 0;
        for (std::size_t k = 0; k < scene.patches.size(); ++k) {
          if (scene.material_of(k).name == "inside") {
            inside += solution.raw[3 * k] != 0;
          } else {
            outside += solution.raw[3 * k] == 0;
          }
        }
        CHECK(inside == 0);
        CHECK(outside == 0);
      }
    }
  }
}

TEST_CASE(
    "C: rays by the worth of a pair are those of the engine's own source, fewer and as right") {
  const host::Scene scene = host::load_scene("cornell", {.subdivide = 2});
  const host::FixedScene fixed(scene);
  const urad_scene& pod = fixed.pod();
  std::vector<std::uint64_t> memory(urad_pair_source_bytes() / 8 + 1);
  urad_counters counters{};
  urad_source source;
  REQUIRE(urad_pair_source_init(&source, &pod, URAD_KERNEL_MOMENT, &urad_general, 64, &counters,
                                memory.data(), memory.size() * 8) == URAD_OK);
  const auto rows = [&] {
    std::vector<std::uint32_t> all;
    for (std::uint16_t i = 0; i < pod.patch_count; ++i) {
      for (std::uint16_t s = 0; s < pod.surface_count; ++s) {
        const urad_surface& to = pod.surface[s];
        std::vector<std::uint32_t> run(to.patch_count);
        REQUIRE(source.fill(source.context, i, s, to.first_patch, to.patch_count, run.data()) ==
                URAD_OK);
        all.insert(all.end(), run.begin(), run.end());
      }
    }
    return all;
  };
  const std::vector<std::uint32_t> every = rows();
  const std::uint32_t rays = counters.rays;
  counters = {};
  REQUIRE(urad_pair_source_worth(&source, 1u << 26, 0) == URAD_OK);
  const host::EngineOptions options{.rays = 64, .ray_error = 1.0 / 64};
  CHECK(rows() == host::engine_rows(fixed, host::parse_method("net"), kNets, options, 1).f_uq32);
  CHECK(counters.rays < rays);
  REQUIRE(urad_pair_source_worth(&source, 0, 0) == URAD_OK);
  CHECK(rows() == every);
}
