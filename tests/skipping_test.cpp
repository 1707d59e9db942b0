// Skips: what is left out is counted, adds up, and leaves the bits as they are; the bounded one
// keeps its bound.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "form_factor/reference.hpp"
#include "method/engine_source.hpp"
#include "network/general_pairs.hpp"
#include "radiosity_scene.hpp"
#include "scene/builtin.hpp"
#include "urad/form_factor.hpp"
#include "weights/general.h"

namespace {

const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_general; }};
constexpr int kRays = 8;
constexpr const char* kScenes[] = {"cube7", "cornell", "room", "louvre", "gallery"};

struct Swept {
  host::EngineRows rows;
  std::uint64_t pairs = 0;
  const urad_counters& count() const { return rows.counters; }
};

Swept sweep(const std::string& scene, int subdivide, const std::string& method,
            host::EngineOptions options = {}) {
  options.rays = kRays;
  const host::FixedScene fixed(host::load_scene(scene, {subdivide, 0}));
  const std::uint64_t n = fixed.pod().patch_count;
  return {host::engine_rows(fixed, host::parse_method(method), kNets, options, 0), n * (n - 1)};
}

std::uint64_t accounted(const urad_counters& c) {
  return std::uint64_t{c.evaluated} + c.skipped_same + c.skipped_facing + c.skipped_small;
}

/// Pairs looked at one by one.
std::uint64_t looked_at(const urad_counters& c) {
  return std::uint64_t{c.evaluated} + c.skipped_facing - c.skipped_behind;
}

/// Ray tests that looked at the polygon.
std::uint64_t looks(const urad_counters& c) { return c.ray_tests - c.tests_unseen; }

}  // namespace

TEST_CASE("one skip of the pairs off: the same bits, and as much more work as its counter said") {
  for (const char* name : kScenes) {
    CAPTURE(name);
    const Swept on = sweep(name, 2, "net");
    const urad_counters& c = on.count();
    CHECK(accounted(c) == on.pairs);
    const auto off = [&](std::uint32_t skip) {
      Swept swept = sweep(name, 2, "net", {.skips = skip});
      CHECK(swept.rows.f_uq32 == on.rows.f_uq32);
      CHECK(accounted(swept.count()) == swept.pairs);
      return swept.count();
    };
    CHECK(looked_at(off(urad::skip_off_same)) == looked_at(c) + c.skipped_same);
    CHECK(looked_at(off(urad::skip_off_behind)) == looked_at(c) + c.skipped_behind);
    CHECK(off(urad::skip_off_facing).evaluated ==
          c.evaluated + c.skipped_facing - c.skipped_behind);
    CHECK(off(urad::skip_off_far).networks == c.networks + c.far_pairs);
    CHECK(off(urad::skip_off_convex).rays_spared == c.rays_spared + kRays * c.skipped_convex);
    const urad_counters all = off(urad::skip_off_blockers);
    CHECK(all.blockers_kept == c.blockers_kept + c.blockers_rejected);
    CHECK(all.rays == c.rays + c.rays_spared);
    CHECK(all.blocked == c.blocked);
    CHECK(all.shut_unseen == 0);
    // Boxes and shadows of rays, whatever else is off and in whatever order.
    for (const std::uint32_t also :
         {0u, std::uint32_t{urad::skip_off_blockers}, std::uint32_t{urad::skip_off_order}}) {
      const urad_counters part = also ? off(also) : c, whole = off(urad::skip_off_unseen | also);
      CHECK(whole.tests_unseen == 0);
      CHECK(looks(whole) == looks(part) + part.tests_unseen);
      CHECK(whole.rays == part.rays);
      CHECK(whole.blocked == part.blocked);
    }
    CHECK(off(urad::skip_off_order).ray_tests >= c.ray_tests);
  }
}

TEST_CASE("hemicube faces and rows that nothing touches: the same bits with them") {
  for (const char* name : kScenes) {
    for (const char* method : {"hemicube:16", "hybrid:16"}) {
      CAPTURE(name);
      CAPTURE(method);
      const Swept on = sweep(name, 2, method), off = sweep(name, 2, method, {.all_rows = true});
      CHECK(off.rows.f_uq32 == on.rows.f_uq32);
      CHECK(off.count().rows == on.count().rows + on.count().rows_empty);
      CHECK(off.count().rows_empty == 0);
      if (on.count().rows) CHECK(off.count().faces == on.count().faces + on.count().faces_empty);
      CHECK(accounted(on.count()) == on.pairs);
    }
  }
}

TEST_CASE("every counter of a sweep counts in one scene and not in another") {
  using Field = std::uint32_t urad_counters::*;
  const auto count = [](Field field, const Swept& swept) { return swept.count().*field; };
  const Swept gallery = sweep("gallery", 2, "net"), whole = sweep("gallery", 1, "net"),
              room = sweep("room", 2, "net"), louvre = sweep("louvre", 2, "net"),
              fine = sweep("gallery", 6, "net"), open = sweep("cornell", 2, "hybrid:16"),
              closed = sweep("room", 2, "hybrid:16"),
              cut = sweep("louvre", 4, "net", {.bound = 0.0625}),
              convex_cut = sweep("gallery", 6, "net", {.bound = 0.0625});
  struct Row {
    const char* name;
    Field field;
    const Swept &some, &none;
  };
  for (const Row& row : {Row{"skipped_same", &urad_counters::skipped_same, gallery, whole},
                         Row{"skipped_facing", &urad_counters::skipped_facing, room, gallery},
                         Row{"skipped_behind", &urad_counters::skipped_behind, room, gallery},
                         Row{"skipped_small", &urad_counters::skipped_small, cut, convex_cut},
                         Row{"skipped_convex", &urad_counters::skipped_convex, gallery, room},
                         Row{"far_pairs", &urad_counters::far_pairs, fine, whole},
                         Row{"rays_spared", &urad_counters::rays_spared, room, gallery},
                         Row{"blockers_rejected", &urad_counters::blockers_rejected, room, gallery},
                         Row{"shut_unseen", &urad_counters::shut_unseen, louvre, gallery},
                         Row{"tests_unseen", &urad_counters::tests_unseen, room, gallery},
                         Row{"faces_empty", &urad_counters::faces_empty, open, closed},
                         Row{"rows_empty", &urad_counters::rows_empty, open, closed}}) {
    CAPTURE(row.name);
    CHECK(count(row.field, row.some) > 0);
    CHECK(count(row.field, row.none) == 0);
  }
}

TEST_CASE("every counter of a solve counts in one scene and not in another") {
  const auto solved = [](test::TableScene& scene) {
    test::Solve solve(scene);
    solve.run(0.01);
    if (scene.patches() < 40) {
      solve.run(0, 20000);  // until nothing is left
      CHECK(urad::radiosity_step(&solve.state) == urad::Status::ok);
    }
    return solve.state.counters;
  };
  std::mt19937 random(1);
  test::TableScene lit(6, 9, URAD_SCENE_CLOSED), grey(1, 9, URAD_SCENE_CLOSED);
  lit.fill_reciprocal(random, 1);
  test::furnish(&lit);
  lit.set(0, {0, 0, 0},
          {960000, 0, 480000});  // no green anywhere, and a lamp that reflects nothing
  for (int i = 0; i < grey.patches(); ++i) {
    for (int j = 0; j < grey.patches(); ++j)
      grey.row[std::size_t(i)][std::size_t(j)] = i == j ? 0 : 0x1FFFFFFF;
  }
  grey.set(0, {0.3, 0.3, 0.3}, {5000, 5000, 5000});
  const urad_radiosity_counters some = solved(lit), none = solved(grey);
  CHECK(some.skipped_channel > 0);
  CHECK(none.skipped_channel == 0);
  CHECK(some.skipped_black > 0);
  CHECK(none.skipped_black == 0);
  CHECK(some.skipped_dark > 0);
  CHECK(none.skipped_dark == 0);
  CHECK(none.shots_empty > 0);
  CHECK(some.shots_empty == 0);
}

TEST_CASE("bounded contribution: no row loses more than the bound, nor the light what follows") {
  for (const char* name : {"cornell", "louvre", "room"}) {
    for (const double bound : {1.0 / 64, 1.0 / 8}) {
      CAPTURE(name);
      CAPTURE(bound);
      const Swept all = sweep(name, 4, "net"), cut = sweep(name, 4, "net", {.bound = bound});
      CHECK(accounted(cut.count()) == cut.pairs);
      const auto n = Eigen::Index(all.rows.patches);
      Eigen::MatrixXd full = Eigen::MatrixXd::Identity(n, n), less = full;
      const host::Scene scene = host::load_scene(name, {4, 0});
      Eigen::VectorXd power(n);
      double most = 0, worst_row = 0;
      for (Eigen::Index i = 0; i < n; ++i) {
        double lost = 0;
        for (Eigen::Index j = 0; j < n; ++j) {
          const double f = all.rows(std::size_t(i), std::size_t(j)),
                       g = cut.rows(std::size_t(i), std::size_t(j)),
                       rho = scene.material_of(std::size_t(j)).reflectance.g;
          REQUIRE((g == f || g == 0));
          lost += f - g;
          most = std::max(most, rho);
          full(j, i) -= rho * f;  // power: what i shoots, j reflects
          less(j, i) -= rho * g;
        }
        worst_row = std::max(worst_row, lost);
        power[i] = scene.patches[std::size_t(i)].moments.area *
                   scene.material_of(std::size_t(i)).exitance.g;
      }
      CHECK(worst_row <= bound);
      const Eigen::VectorXd b = full.partialPivLu().solve(power),
                            c = less.partialPivLu().solve(power);
      const double lost = (b - c).lpNorm<1>() / b.lpNorm<1>();
      MESSAGE(std::string(name) << ", bound " << bound << ": " << cut.count().skipped_small
                                << " of " << all.count().evaluated << " pairs left out, worst row "
                                << worst_row << ", light " << lost);
      CHECK(lost <= bound * most / (1 - most));
    }
  }
}

TEST_CASE(
    "a bound leaves nothing out where there are no rays to save: the same bits and counters") {
  for (const char* name : {"gallery", "cube7"}) {
    const Swept all = sweep(name, 4, "net"), bounded = sweep(name, 4, "net", {.bound = 0.125});
    CHECK(bounded.rows.f_uq32 == all.rows.f_uq32);
    CHECK(bounded.count().skipped_small == 0);
    CHECK(bounded.count().evaluated == all.count().evaluated);
  }
}

TEST_CASE("twice the moment kernel is above the exchange of every pair that may be left out") {
  const std::uint64_t seed = 7;
  double worst = 0;
  int judged = 0;
  urad_counters counters{};
  for (int family = 0; family < host::kPairFamilies; ++family) {
    for (std::uint64_t k = 0; k < 1500; ++k) {
      const host::PolygonPair pair = host::general_pair(host::PairFamily(family), seed, k);
      const host::FixedScene fixed = host::FixedScene::of_polygons({pair.p, pair.q}, {});
      const urad_scene& scene = fixed.pod();
      const urad::Patch i = urad::patch_at(scene, 0), j = urad::patch_at(scene, 1);
      const std::uint32_t before = counters.skipped_small;
      // The least bound that leaves the pair out lies within one step above 2 K.
      std::int32_t low = 0, high = 100 << 24;
      const auto left_out = [&](std::int32_t least) {
        urad::SmallExchange limit{least, urad::kNoExchange};
        urad::exchange_log2_q24(scene, i, j, urad::Kernel::moment, nullptr, 0, &counters, &limit);
        return limit.left_out_q24 != urad::kNoExchange;
      };
      if (!left_out(high)) continue;
      while (high - low > 1 << 12) {
        const std::int32_t middle = low + (high - low) / 2;
        (left_out(middle) ? high : low) = middle;
      }
      CHECK(counters.skipped_small > before);
      const double units = fixed.units_per_length();
      const double g = host::reference_exchange(pair.p, pair.q) * units * units;
      worst = std::max(worst, g / std::exp2(high / 0x1p24));
      ++judged;
    }
  }
  MESSAGE(judged << " pairs, exchange at most " << worst << " of twice the kernel");
  CHECK(judged > 2000);
  CHECK(worst <= 1);
}

TEST_CASE("an allowance that is used up leaves nothing more out, until the row starts anew") {
  // Plates that get two fifths of a unit of 2^-32 each, of a shooter that may lose one unit: what is
  // left out counts twice, and rounds up to all of it.
  const auto square = [](double x, double z, double size, bool down) {
    host::Polygon p{{{x, 0, z}, {x + size, 0, z}, {x + size, size, z}, {x, size, z}}, {}};
    if (down) std::reverse(p.outer.begin(), p.outer.end());
    return p;
  };
  std::vector<host::Polygon> patches{square(0, 0, 0.01, false)};
  constexpr int kPlates = 7;
  for (int k = 0; k < kPlates; ++k) patches.push_back(square(0.001 * k, 1, 1.7e-5, true));
  const host::FixedScene fixed = host::FixedScene::of_polygons(patches, {});
  urad_scene scene = fixed.pod();
  scene.flags = URAD_SCENE_CLOSED;
  urad_counters counters{};
  urad::PairSource source{&scene, nullptr, urad::Kernel::moment, 1, 0, &counters};
  const auto row = [&] {
    counters = {};
    std::uint32_t f = 0;
    for (std::uint16_t k = 1; k <= kPlates; ++k)
      REQUIRE(urad::pair_fill(&source, 0, k, k, 1, &f) == URAD_OK);
    CHECK(counters.evaluated + counters.skipped_small == kPlates);
    return counters.skipped_small;
  };
  CHECK(row() == 0);
  source.bound_uq32 = 1;
  CHECK(row() == 1);
  CHECK(row() == 1);
  source.bound_uq32 = 4;
  CHECK(row() == 4);
  source.bound_uq32 = 100;
  CHECK(row() == kPlates);
}
