// Third moments in the engine's integers: against those in double, whoever asks, mirrored, and when
// the data is nonsense.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "accuracy/lopsided_pairs.hpp"
#include "base/quantile.hpp"
#include "form_factor/reference.hpp"
#include "form_factor/third_order.hpp"
#include "scene/fixed_scene.hpp"
#include "urad/cheapest.hpp"
#include "urad/third_order.hpp"

namespace {

constexpr std::uint64_t kSeed = 15;

struct Fixed {
  host::FixedScene scene;
  urad::Patch p, q;
  urad::PairKernel kernel{};
  urad::ThirdOrder third{};
};

Fixed fixed(const host::PolygonPair& pair) {
  const host::FixedScene scene = host::FixedScene::of_polygons({pair.p, pair.q}, {});
  Fixed f{scene, urad::patch_at(scene.pod(), 0), urad::patch_at(scene.pod(), 1)};
  REQUIRE(urad::pair_kernel(*f.p.shape, f.p.centroid, *f.q.shape, f.q.centroid, &f.kernel));
  f.third = urad::third_order(scene.pod(), f.p, f.q, f.kernel);
  return f;
}

double exact(const host::PolygonPair& pair) {
  const host::Moments p = host::moments(pair.p), q = host::moments(pair.q);
  return host::third_order(p, host::third_moments(pair.p, p), q, host::third_moments(pair.q, q));
}

/// (extent / R)^3 / |m.w| of both: what its error is measured by.
double scale(const host::PolygonPair& pair) {
  const host::Moments p = host::moments(pair.p), q = host::moments(pair.q);
  const host::Vec3 r = q.centroid - p.centroid;
  const auto of = [&](const host::Polygon& polygon, const host::Moments& m, const host::Vec3& n) {
    double extent = 0;
    for (const host::Vec3& x : polygon.outer)
      extent = std::max(extent, glm::length(x - m.centroid));
    return std::pow(extent, 3) / std::pow(glm::length(r), 2) / std::fabs(glm::dot(n, r));
  };
  return of(pair.p, p, q.normal) + of(pair.q, q, p.normal);
}

}  // namespace

TEST_CASE("T3 in integers is that in double") {
  MESSAGE("seed ", kSeed);
  host::Random random(kSeed);
  for (const host::PatchKind& kind : host::kPatchKinds) {
    double worst = 0;
    std::vector<double> relative;
    for (int k = 0; k < 2000; ++k) {
      const host::PolygonPair pair = host::draw_pair(kind, 1e-6, 0.35, random);
      const double t3 = exact(pair), s = scale(pair);
      const Fixed f = fixed(pair);
      if (kind.symmetric) {
        CHECK(f.third.cubics == 0);
        CHECK(f.third.t3_q22 == 0);
        continue;
      }
      CHECK(f.third.cubics == (kind.corners == 3 ? 6 : 16));
      if (std::fabs(t3) > 1) continue;
      const double off = std::fabs(f.third.t3_q22 * 0x1p-22 - t3);
      worst = std::max(worst, (off - 0x1p-21) / s);
      if (std::fabs(t3) > 1e-3) relative.push_back(off / std::fabs(t3));
    }
    if (kind.symmetric) continue;
    const std::string name = kind.name;
    MESSAGE(name, ": worst ", worst, " of (extent/R)^3 / |m.w|, relative p99 ",
            host::quantile(relative, 0.99));
    CHECK(worst <= 1e-3);
  }
}

TEST_CASE("T3 is one integer: whoever asks, wherever loops begin, mirrored") {
  host::Random random(kSeed);
  const auto mirrored = [](const host::Polygon& polygon) {
    host::Polygon result = polygon;
    for (host::Vec3& x : result.outer) x.x = -x.x;
    std::reverse(result.outer.begin(), result.outer.end());
    return result;
  };
  for (int k = 0; k < 300; ++k) {
    const host::PatchKind& kind = host::kPatchKinds[1 + k % 3];
    const host::PolygonPair pair = host::draw_pair(kind, 1e-4, 0.35, random);
    const std::int32_t t3_q22 = fixed(pair).third.t3_q22;
    CHECK(fixed({pair.q, pair.p}).third.t3_q22 == t3_q22);
    const Fixed image = fixed({mirrored(pair.p), mirrored(pair.q)});
    CHECK(std::abs(image.third.t3_q22 - t3_q22) <= 2e-3 * 0x1p22 * scale(pair));
    host::PolygonPair later = pair;
    std::rotate(later.p.outer.begin(), later.p.outer.begin() + 1, later.p.outer.end());
    std::rotate(later.q.outer.begin(), later.q.outer.begin() + 2, later.q.outer.end());
    CHECK(std::abs(fixed(later).third.t3_q22 - t3_q22) <= 2e-3 * 0x1p22 * scale(pair));
  }
}

TEST_CASE("a polygon of 64 corners with a hole bridged into it has the T3 of its parts") {
  // A fan of 31 corners about a hole of 31, and the two ends of the bridge again.
  host::Polygon ring;
  host::Loop hole;
  for (int k = 0; k < 31; ++k) {
    const double angle = 2 * std::numbers::pi * k / 31, radius = 0.2 + 0.1 * (k % 3) + 0.004 * k;
    ring.outer.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    hole.push_back({0.05 * std::cos(angle) + 0.02, -0.05 * std::sin(angle), 0});
  }
  ring.holes.push_back(hole);
  const host::Polygon triangle{{{0.5, 0.2, 1.1}, {0.4, 0.7, 1.2}, {0.9, 0.1, 1}}, {}};
  const host::PolygonPair pair{ring, triangle};
  const Fixed f = fixed(pair);
  CHECK(f.p.vertex_count == 64);
  CHECK(f.third.cubics == 2 * 64 + 3);
  CHECK(f.third.t3_q22 * 0x1p-22 == doctest::Approx(exact(pair)).epsilon(0.01));
}

TEST_CASE("auto with third moments knows its error for lopsided patches of every kind") {
  constexpr int kPairs = 1000;
  std::uint64_t stream = kSeed;
  for (const host::PatchKind& kind : host::kPatchKinds) {
    if (kind.symmetric) continue;
    host::Random random(++stream);
    std::size_t with = 0, without = 0, missed = 0;
    for (int k = 0; k < kPairs; ++k) {
      const host::PolygonPair pair = host::draw_pair(kind, 1e-4, 0.35, random);
      const double g = host::reference_exchange(pair.p, pair.q) / host::moments(pair.p).area;
      const Fixed f = fixed(pair);
      for (const double wanted : {0.1, 0.01, 0.001}) {
        urad_counters counters{};
        const urad::CheapestPair found =
            urad::cheapest_exchange(f.scene.pod(), f.p, f.q, nullptr,
                                    std::int16_t(std::floor(256 * std::log2(wanted))), &counters);
        if (found.way != urad::Way::kernel) continue;
        ++(found.cubics > 0 ? with : without);
        const double log2_f = (found.log2_exchange_q24 - f.p.shape->log2_area_q24) * 0x1p-24;
        const double estimate = std::exp2(found.log2_error_q8 / 256.0);
        CHECK(estimate <= wanted);
        missed += std::fabs(std::exp2(log2_f) / g - 1) > estimate;
      }
    }
    MESSAGE(kind.name, std::string(": "), with, " with, ", without, " without, missed ", missed);
    CHECK(with > 50);
    CHECK(without > 500);
    CHECK(double(missed) <= 0.0125 * double(with + without));  // 1 %, and what chance may add
  }
}
