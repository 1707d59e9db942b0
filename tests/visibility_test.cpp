// Rays against blockers: each ray against double arithmetic, fractions against exact obstructed
// form factors.
#include "urad/visibility.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "form_factor/monte_carlo.hpp"
#include "form_factor/reference.hpp"
#include "hand_made_scene.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/form_factor.hpp"
#include "urad/ratio.hpp"
#include "urad/vec.hpp"

namespace {

using host::Loop;
using host::Polygon;
using Vec = host::Vec3;

Vec to_vec(const urad_point& p) { return {p.x, p.y, p.z}; }
urad_point to_point(const Vec& v) {
  return {int32_t(std::lround(v.x)), int32_t(std::lround(v.y)), int32_t(std::lround(v.z))};
}

Polygon polygon(const Loop& loop) { return {loop, {}}; }

/// Star-shaped about its centre: planar, simple, often concave.
Polygon random_polygon(std::mt19937_64& random, const Vec& centre, double size) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  const Vec n = glm::normalize(Vec{normal(random), normal(random), normal(random)});
  const Vec u = glm::normalize(glm::cross(n, std::fabs(n.x) < 0.7 ? Vec{1, 0, 0} : Vec{0, 1, 0})),
            v = glm::cross(n, u);
  const int count = 3 + int(random() % 7);
  Loop loop;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * (k + 0.8 * unit(random)) / count,
                 radius = size * (0.2 + 0.8 * unit(random));
    loop.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return polygon(loop);
}

/// Two patches far apart that hold the scene's box fixed, and the blockers given.
host::FixedScene scene_of(const std::vector<Polygon>& blockers) {
  const Polygon low = polygon({{-1, -1, -1}, {-0.9, -1, -1}, {-0.9, -0.9, -1}, {-1, -0.9, -1}});
  const Polygon high = polygon({{1, 1, 1}, {0.9, 1, 1}, {0.9, 0.9, 1}, {1, 0.9, 1}});
  return host::FixedScene::of_polygons({low, high}, blockers);
}

struct Answer {
  bool blocked = false, doubtful = false;
};

Answer ray_in_double(const urad_scene& scene, const urad_blocker& blocker, const Vec& a,
                     const Vec& b) {
  const Vec n = to_vec(blocker.normal_q30) * 0x1p-30,
            on = to_vec(scene.vertex[blocker.first_vertex]);
  const double da = glm::dot(n, a - on), db = glm::dot(n, b - on);
  Answer answer;
  answer.doubtful = std::fabs(std::fabs(da) - urad::kPlaneTolerance - 0.5) < 2 ||
                    std::fabs(std::fabs(db) - urad::kPlaneTolerance - 0.5) < 2;
  if ((da < 0) == (db < 0) || std::min(std::fabs(da), std::fabs(db)) <= urad::kPlaneTolerance + 0.5)
    return answer;
  const Vec at = a + (b - a) * (da / (da - db));
  const int drop = std::fabs(n.x) > std::fabs(n.y) ? (std::fabs(n.x) > std::fabs(n.z) ? 0 : 2)
                                                   : (std::fabs(n.y) > std::fabs(n.z) ? 1 : 2);
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  for (uint16_t k = 0; k < blocker.vertex_count; ++k) {
    const Vec p = to_vec(scene.vertex[blocker.first_vertex + k]);
    const Vec q = to_vec(scene.vertex[blocker.first_vertex + (k + 1) % blocker.vertex_count]);
    const double along = std::clamp(glm::dot(at - p, q - p) / glm::dot(q - p, q - p), 0.0, 1.0);
    const double grazing = 1 + glm::length(b - a) / std::fabs(da - db);
    // Two units off in sums of coordinates (sqrt 3), beside an edge (sqrt 2), seen along one axis
    // (sqrt 3): 8.5 of them.
    if (glm::length(at - p - along * (q - p)) < 9 * grazing) answer.doubtful = true;
    if ((p[v] > at[v]) != (q[v] > at[v]) &&
        p[u] + (at[v] - p[v]) / (q[v] - p[v]) * (q[u] - p[u]) > at[u]) {
      answer.blocked = !answer.blocked;
    }
  }
  return answer;
}

TEST_CASE("blocks() agrees with double arithmetic but for rays within rounding of an outline") {
  const uint64_t seed = 4711;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  MESSAGE("seed ", seed);
  int blocked = 0, doubtful = 0, wrong = 0, rays = 0;
  for (int set = 0; set < 100; ++set) {
    std::vector<Polygon> blockers;
    blockers.reserve(8);
    const double size = set % 4 == 0 ? 1e-5 : 0.4;
    const Vec middle = 0.5 * Vec{unit(random), unit(random), unit(random)};
    for (int k = 0; k < 8; ++k)
      blockers.push_back(random_polygon(
          random, middle + 0.5 * size * Vec{unit(random), unit(random), unit(random)}, size));
    const host::FixedScene fixed = scene_of(blockers);
    const urad_scene& scene = fixed.pod();
    const double units = fixed.units_per_length();
    for (int n = 0; n < 1000; ++n) {
      const urad_blocker& blocker = scene.blocker[n % scene.blocker_count];
      const Vec about = 0.5 * (to_vec(blocker.low) + to_vec(blocker.high));
      const auto end = [&] {
        return to_point(glm::clamp(
            about + size * units * Vec{unit(random), unit(random), unit(random)}, -0x1p29, 0x1p29));
      };
      const urad_point a = end(), b = end();
      const Answer answer = ray_in_double(scene, blocker, to_vec(a), to_vec(b));
      const bool got = urad::blocks(scene, blocker, a, b);
      CHECK(got == urad::blocks(scene, blocker, b, a));
      ++rays;
      blocked += got;
      doubtful += answer.doubtful;
      wrong += !answer.doubtful && got != answer.blocked;
    }
  }
  MESSAGE(rays, " rays, ", blocked, " blocked, ", doubtful, " within rounding");
  CHECK(wrong == 0);
  CHECK(blocked > rays / 20);
  CHECK(doubtful < rays / 100);
}

TEST_CASE("a wall of triangles leaks nowhere, not even along its seams") {
  const uint64_t seed = 99;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  MESSAGE("seed ", seed);
  const Vec n = glm::normalize(Vec{unit(random), unit(random), unit(random)});
  const Vec u = glm::normalize(glm::cross(n, Vec{1, 0, 0})), v = glm::cross(n, u);
  std::vector<Polygon> blockers;
  const auto at = [&](int i, int j) { return (i - 3) / 7.0 * u + (j - 3) / 7.0 * v; };
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      blockers.push_back(polygon({at(i, j), at(i + 1, j), at(i + 1, j + 1)}));
      blockers.push_back(polygon({at(i, j), at(i + 1, j + 1), at(i, j + 1)}));
    }
  }
  const host::FixedScene fixed = scene_of(blockers);
  const urad_scene& scene = fixed.pod();
  const double units = fixed.units_per_length();
  REQUIRE(scene.blocker_count == 72);
  int leaks = 0;
  for (int k = 0; k < 20000; ++k) {
    // Through a point on a seam: of both families of edges, of the diagonals, or a corner.
    const double along = 2.9 * unit(random);
    const double line = double(int(random() % 5)) - 2;
    const double s = k % 4 == 0 ? line : along, t = k % 4 == 0   ? along
                                                    : k % 4 == 1 ? line
                                                    : k % 4 == 2 ? along
                                                                 : std::round(along);
    const Vec through = (s * u + t * v) / 7.0;
    Vec d = glm::normalize(Vec{unit(random), unit(random), unit(random)});
    if (std::fabs(glm::dot(d, n)) < 0.01) d = n;
    const urad_point a = to_point(units * (through + 0.4 * d)),
                     b = to_point(units * (through - 0.4 * d));
    bool stopped = false;
    for (int c = 0; c < scene.blocker_count; ++c)
      stopped = stopped || urad::blocks(scene, scene.blocker[c], a, b);
    leaks += !stopped;
  }
  CHECK(leaks == 0);
}

struct Room {
  Room(const std::vector<Polygon>& polygons, const std::vector<Polygon>& blockers)
      : patches(polygons), fixed(host::FixedScene::of_polygons(polygons, blockers)) {}
  double fraction(int i, int j, uint16_t rays, bool weighted = true) {
    const urad_scene& scene = fixed.pod();
    return urad::visible_fraction_uq16(scene, urad::patch_at(scene, uint16_t(i)),
                                       urad::patch_at(scene, uint16_t(j)), rays, weighted,
                                       &counters) /
           65536.0;
  }
  double factor(int i, int j) {
    const double f =
        host::reference_form_factor(patches[size_t(i)], patches[size_t(j)]) * fraction(i, j, 256);
    return f;
  }
  std::vector<Polygon> patches;
  host::FixedScene fixed;
  urad_counters counters{};
};

Polygon square(double low, double high, double z, bool up) {
  if (up) return polygon({{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}});
  return polygon({{low, low, z}, {low, high, z}, {high, high, z}, {high, low, z}});
}

TEST_CASE("square obstruction, both positions, 256 rays, 3e-3 absolute") {
  Room corner({square(0, 1, 0, true), square(0, 1, 1, false)}, {square(0, 0.5, 0.5, true)});
  CHECK(std::fabs(corner.factor(0, 1) - 0.149868671773791) < 3e-3);
  Room centred({square(0, 1, 0, true), square(0, 1, 1, false)}, {square(0.25, 0.75, 0.5, true)});
  CHECK(std::fabs(centred.factor(0, 1) - 0.0995062945989848) < 3e-3);
}

TEST_CASE(
    "nothing or everything in the way is exactly 65536 or 0, and an idle blocker costs no ray") {
  Room open({square(0, 1, 0, true), square(0, 1, 1, false)}, {square(2, 3, 0.5, true)});
  CHECK(open.fraction(0, 1, 256) == 1.0);
  CHECK(open.counters.ray_tests == 0);
  CHECK(open.counters.rays == 0);
  CHECK(open.counters.rays_spared == 256);
  Room shut({square(0, 1, 0, true), square(0, 1, 1, false)}, {square(-1, 2, 0.5, true)});
  CHECK(shut.fraction(0, 1, 256) == 0.0);
  CHECK(shut.fraction(0, 1, 1, false) == 0.0);
  CHECK(shut.counters.blocked == 2);
  // In the plane of a patch, or touching it: no shadow.
  Room touching({square(0, 1, 0, true), square(0, 1, 1, false)},
                {square(-1, 2, 0, true), square(-1, 2, 1, true)});
  CHECK(touching.fraction(0, 1, 256) == 1.0);
}

TEST_CASE("L-shaped room of Pinney & Bean, 256 rays, 3e-3 absolute") {
  const std::vector<Vec> plan = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const Vec up{0, 0, 3};
  std::vector<Polygon> walls;
  for (size_t k = 0; k < 6; ++k) {  // lit towards the inside
    const Vec &a = plan[k], &b = plan[(k + 1) % 6];
    walls.push_back(polygon({b, a, a + up, b + up}));
  }
  Polygon floor = polygon({plan.begin(), plan.end()}), ceiling = floor;
  std::reverse(ceiling.outer.begin(), ceiling.outer.end());
  for (Vec& x : ceiling.outer) x += up;
  walls.push_back(ceiling);
  walls.push_back(floor);
  Room room(walls, {walls[2], walls[3]});
  struct Value {
    int i, j;
    double f;
  };
  const Value values[] = {
      {1, 2, 0.1131544}, {1, 3, 0.3780929}, {1, 4, 0.0274734}, {1, 5, 0.0328902},
      {1, 6, 0.1823559}, {1, 7, 0.1330165}, {2, 1, 0.3394632}, {2, 3, 0.3189967},
      {2, 6, 0.0986707}, {2, 7, 0.1214346}, {2, 8, 0.1214346}, {3, 1, 0.5671393},
      {3, 2, 0.1594984}, {3, 6, 0.0412101}, {3, 7, 0.1160761}, {7, 1, 0.2394298},
      {7, 2, 0.0728607}, {7, 3, 0.1392913}, {7, 5, 0.0728607}, {7, 8, 0.0968364}};
  double worst = 0;
  for (const Value& value : values) {
    const double error = room.factor(value.i - 1, value.j - 1) - value.f;
    INFO("F", value.i, value.j, " off by ", error);
    CHECK(std::fabs(error) < 3e-3);
    worst = std::max(worst, std::fabs(error));
  }
  MESSAGE("worst error ", worst);
  CHECK(room.fraction(1, 3, 64) == room.fraction(3, 1, 64));
}

TEST_CASE(
    "triangles and concave patches are sampled evenly: fractions of unweighted rays are area "
    "ratios") {
  // Far below a screen that covers the half x > 0 of the upper patch as seen from the lower.
  const double h = 1000;
  const Polygon triangle = polygon({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}});
  const Polygon arrow = polygon({{0, 0, 0}, {0.25, 0.25, 0}, {1, 0, 0}, {0, 1, 0}});
  for (const Polygon& shape : {triangle, arrow}) {
    Polygon lower = shape, upper = shape;
    std::reverse(lower.outer.begin(), lower.outer.end());
    if (host::moments(lower).normal.z < 0) std::swap(lower, upper);
    for (Vec& x : upper.outer) x.z = h;
    Room room(
        {lower, upper},
        {polygon(
            {{-1, -1, h - 0.01}, {0.25, -1, h - 0.01}, {0.25, 2, h - 0.01}, {-1, 2, h - 0.01}})});
    const double all = host::moments(upper).area;
    const double hidden = all - host::moments(host::clip(upper, {0.25, 0, h}, {1, 0, 0})).area;
    CHECK(room.fraction(0, 1, 1024, false) == doctest::Approx(1 - hidden / all).epsilon(0.01));
  }
}

TEST_CASE("inverse_uq62 and ratio_q hold their errors") {
  double worst = 0;
  for (uint64_t m = 0x80000000u; m <= 0xFFFFFFFFu; m += 10007) {
    const long double exact = 0x1p62L / m;
    const double error = double((urad::inverse_uq62(uint32_t(m)) - exact) / exact);
    worst = std::max(worst, std::fabs(error));
  }
  CHECK(urad::inverse_uq62(0x80000000u) <= 0x80000000u);
  MESSAGE("worst relative error 2^", std::log2(worst));
  CHECK(worst <= 1.0e-9);

  const uint64_t seed = 5;
  std::mt19937_64 random(seed);
  double worst_ratio = 0;
  for (int n = 0; n < 200000; ++n) {
    const int64_t num = int64_t(random() >> (2 + random() % 60)),
                  den = int64_t(random() >> (2 + random() % 60)) | 1;
    const long double exact = (long double)num / (long double)den * 0x1p20L;
    if (exact < 0x1p30L || exact > 0x1p61L) continue;
    CHECK(urad::ratio_q(-num, den, 20) == -urad::ratio_q(num, den, 20));
    worst_ratio =
        std::max(worst_ratio, double(std::fabs((urad::ratio_q(num, den, 20) - exact) / exact)));
  }
  CHECK(worst_ratio <= 0x1p-29);
}

}  // namespace

TEST_CASE("between near patches: what grows lets less through, as sampling says") {
  // Plates closer than half their size: nearly all of their exchange is near, and its rays met no
  // blocker.
  const Polygon floor = polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const Polygon ceiling = polygon({{0, 0, 0.3}, {0, 1, 0.3}, {1, 1, 0.3}, {1, 0, 0.3}});
  const double open = host::monte_carlo(floor, ceiling, 1 << 16).f;
  double before = 1;
  for (const double size : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    CAPTURE(size);
    const double low = 0.5 - size / 2, high = 0.5 + size / 2;
    const Polygon blocker =
        polygon({{low, low, 0.15}, {high, low, 0.15}, {high, high, 0.15}, {low, high, 0.15}});
    const host::FixedScene scene = host::FixedScene::of_polygons({floor, ceiling}, {blocker});
    urad_counters counters{};
    const double seen =
        urad::visible_fraction_uq16(scene.pod(), urad::patch_at(scene.pod(), 0),
                                    urad::patch_at(scene.pod(), 1), 256, true, &counters) /
        65536.0;
    const double exact = host::monte_carlo(floor, ceiling, 1 << 16, {blocker}).f / open;
    INFO(seen, " for ", exact);
    CHECK(std::abs(seen - exact) < 0.03);
    CHECK(seen < before);
    before = seen;
  }
}

TEST_CASE("a blocker's normal may point to either side of it") {
  std::mt19937_64 random(5);
  int partly = 0;
  for (int k = 0; k < 60; ++k) {
    const Polygon plate = random_polygon(random, {0.5, 0.5, 0.5}, 0.9);
    Room room({square(0, 1, 0, true), square(0, 1, 1, false)}, {plate});
    urad_scene other = room.fixed.pod();
    urad_blocker blocker = other.blocker[0];
    blocker.normal_q30 = {-blocker.normal_q30.x, -blocker.normal_q30.y, -blocker.normal_q30.z};
    other.blocker = &blocker;
    urad_counters counters{};
    const double turned = urad::visible_fraction_uq16(
        other, urad::patch_at(other, 0), urad::patch_at(other, 1), 64, true, &counters);
    const double straight = room.fraction(0, 1, 64);
    CHECK(turned / 65536 == straight);
    partly += straight > 0 && straight < 1;
  }
  CHECK(partly > 20);
}

TEST_CASE("numbers of rays and cuts out of range are the nearest that are in it") {
  Room room({square(0, 1, 0, true), square(0, 1, 1, false)}, {square(0.1, 0.6, 0.5, true)});
  CHECK(room.fraction(0, 1, 0) == room.fraction(0, 1, 1));
  CHECK(room.fraction(0, 1, 5000) == room.fraction(0, 1, urad::kMaxRays));
  CHECK(room.fraction(0, 1, urad::kMaxRays) != room.fraction(0, 1, 1));
  // Far enough apart to be cut.
  Room far({square(0, 1, 0, true), square(0, 1, 4, false)}, {square(0.1, 0.6, 2, true)});
  const urad_scene& scene = far.fixed.pod();
  const auto adaptive = [&](std::uint16_t rays, std::uint8_t depth) {
    const urad::AdaptiveRays plan{rays, depth, 1u << 8};
    return urad::adaptive_fraction_uq16(scene, urad::patch_at(scene, 0), urad::patch_at(scene, 1),
                                        plan, 1u << 27, &far.counters);
  };
  CHECK(adaptive(0, 2) == adaptive(4, 2));
  CHECK(adaptive(2000, 1) == adaptive(256, 1));
  CHECK(adaptive(16, 200) == adaptive(16, urad::kMaxDepth));
  CHECK(adaptive(16, 0) != adaptive(16, urad::kMaxDepth));
  for (const std::uint16_t rays : {std::uint16_t{4}, std::uint16_t{64}})
    CHECK(adaptive(rays, 4) / 65536.0 == doctest::Approx(far.fraction(0, 1, 1024)).epsilon(0.25));
}

TEST_CASE("specks in a great scene see as much of each other as if they filled it") {
  const auto scaled = [](Polygon p, double scale) {
    for (Vec& x : p.outer) x *= scale;
    return p;
  };
  const std::vector<Polygon> pair{square(0, 1, 0, true), square(0, 1, 1, false)};
  const Polygon plate = square(0.1, 0.6, 0.5, true);
  Room large(pair, {plate});
  const double expected = large.fraction(0, 1, 1024);
  CHECK(expected > 0.2);
  CHECK(expected < 0.9);
  for (const double scale : {1e-3, 1e-5, 4e-6}) {
    CAPTURE(scale);
    // A wall that makes the scene as large as it is.
    std::vector<Polygon> patches{scaled(pair[0], scale), scaled(pair[1], scale)};
    patches.push_back(polygon({{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}}));
    Room small(patches, {scaled(plate, scale)});
    CHECK(std::fabs(small.fraction(0, 1, 1024) - expected) < 0.02);
  }
}

TEST_CASE("more blockers than a list holds: a run over a wall sees what its pairs see one by one") {
  // Forty lamellae between two walls of 4 x 4, each of them in reach of every pair.
  host::Scene scene;
  scene.name = "lamellae";
  test::add_wall(&scene, "floor", Vec(0), Vec(1, 0, 0), Vec(0, 1, 0), 4, Vec(0.5), Vec(1));
  test::add_wall(&scene, "ceiling", Vec(0, 0, 1), Vec(0, 1, 0), Vec(1, 0, 0), 4, Vec(0.5), Vec(0));
  for (int k = 0; k < 40; ++k) {
    const double x = (k + 0.5) / 40;
    host::Blocker lamella;
    lamella.polygon = polygon({{x, 0, 0.4}, {x + 0.004, 0, 0.6}, {x + 0.004, 1, 0.6}, {x, 1, 0.4}});
    scene.blockers.push_back(lamella);
  }
  const host::FixedScene fixed(scene);
  const urad_scene& pod = fixed.pod();
  urad_counters counters{};
  urad::PairSource pairs{&pod, nullptr, urad::Kernel::moment, 64, 0, &counters};
  int partly = 0;
  for (uint16_t shooter = 0; shooter < 16; ++shooter) {
    uint32_t run[16];
    REQUIRE(urad::pair_fill(&pairs, shooter, 1, 16, 16, run) == URAD_OK);
    for (uint16_t k = 0; k < 16; ++k) {
      const uint16_t to = uint16_t(16 + k);
      uint32_t one = 0, open = 0;
      REQUIRE(urad::pair_fill(&pairs, shooter, 1, to, 1, &one) == URAD_OK);
      CHECK(run[k] == one);
      urad::PairSource blind{&pod, nullptr, urad::Kernel::moment, 0, 0, &counters};
      REQUIRE(urad::pair_fill(&blind, shooter, 1, to, 1, &open) == URAD_OK);
      const double seen =
          urad::visible_fraction_uq16(pod, urad::patch_at(pod, shooter), urad::patch_at(pod, to),
                                      64, true, &counters, false) /
          65536.0;
      CHECK(std::fabs(one - open * seen) <= 1 + open * 0x1p-15);
      partly += seen > 0 && seen < 1;
    }
  }
  CHECK(partly > 100);
}
