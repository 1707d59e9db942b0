#include "network/general_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <optional>

#include "base/parallel.hpp"
#include "form_factor/reference.hpp"
#include "network/engine_pair.hpp"
#include "network/random_direction.hpp"
#include "scene/fixed_scene.hpp"

namespace host {

namespace {

constexpr double kPi = std::numbers::pi;

// Two unit vectors that make a right-handed frame with `normal`, turned freely about it.
std::pair<Vec3, Vec3> frame(const Vec3& normal, Random& random) {
  Vec3 other = random_direction(random);
  while (std::fabs(glm::dot(other, normal)) > 0.99) other = random_direction(random);
  const Vec3 u = glm::normalize(glm::cross(other, normal));
  return {u, glm::cross(normal, u)};
}

Polygon parallelogram(const Vec3& origin, const Vec3& u, const Vec3& v) {
  return {{origin, origin + u, origin + u + v, origin + v}, {}};
}

// A quad about `centre`: corners at random angles and radii; a radius may fall inside the chord: a
// concave quad.
Polygon quad(const Vec3& centre, const Vec3& normal, double size, Random& random) {
  const auto [u, v] = frame(normal, random);
  Polygon polygon;
  const double turn = random.uniform(0, 2 * kPi);
  const int dent = random.below(4);  // one quad in four is concave
  for (int k = 0; k < 4; ++k) {
    const double angle = turn + (k + random.uniform(-0.3, 0.3)) * kPi / 2;
    const double radius =
        size * (k == 0 && dent == 0 ? random.uniform(0.1, 0.3) : random.uniform(0.5, 1));
    polygon.outer.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return polygon;
}

PolygonPair free_pair(Random& random) {
  const auto point = [&] { return Vec3(random.uniform(), random.uniform(), random.uniform()); };
  const Vec3 a = point(), b = point();
  const Vec3 r = glm::normalize(b - a);
  Vec3 m = random_direction(random), n = random_direction(random);
  if (glm::dot(m, r) < 0) m = -m;  // the centres face each other; corners may still be cut off
  if (glm::dot(n, r) > 0) n = -n;
  const double size = glm::distance(a, b) * random.log_uniform(0.05, 1.2);
  const double ratio = random.log_uniform(0.2, 1);
  PolygonPair pair{quad(a, m, size, random), quad(b, n, size * ratio, random), PairFamily::free};
  if (random.below(2) == 0) std::swap(pair.p, pair.q);
  return pair;
}

// Two walls along a common edge, the x axis: floor in the xy plane, the other one turned up by
// `angle`.
struct Corner {
  double angle;
  double shear_p = 0, shear_q = 0;  // parallelograms: x offset per depth

  Vec3 into_p() const { return {shear_p, 1, 0}; }
  Vec3 into_q() const { return Vec3(shear_q, std::cos(angle), std::sin(angle)); }
  // Lit sides face each other for 0 < angle < pi.
  Polygon on_p(double x, double width, double depth, double height) const {
    return parallelogram(Vec3(x, 0, 0) + depth * into_p(), {width, 0, 0}, height * into_p());
  }
  Polygon on_q(double x, double width, double depth, double height) const {
    return parallelogram(Vec3(x, 0, 0) + depth * into_q(), height * into_q(), {width, 0, 0});
  }
};

// Most walls stand at right angles, most patches are not far from squares.
Corner corner_of(Random& random) {
  Corner corner{kPi / 2};
  const double kind = random.uniform();
  if (kind > 0.5) corner.angle = random.uniform(0.2, 2.9);
  if (kind > 0.8) {
    corner.shear_p = random.uniform(-0.6, 0.6);
    corner.shear_q = random.uniform(-0.6, 0.6);
  }
  return corner;
}

double aspect(Random& random) { return std::exp(0.6 * std::clamp(random.normal(), -2.5, 2.5)); }

PolygonPair neighbours(PairFamily family, Random& random) {
  const Corner corner = corner_of(random);
  double x = 0, width = 1;
  if (family == PairFamily::touching) {
    width = aspect(random);
    x = random.uniform(-0.95 * width, 0.95);
  } else if (family == PairFamily::corner) {
    width = random.below(2) == 0 ? 1 : aspect(random);
    x = random.below(2) == 0 ? 1 : -width;
  }
  PolygonPair pair{corner.on_p(0, 1, 0, aspect(random)), corner.on_q(x, width, 0, aspect(random)),
                   family};
  return pair;
}

// A box room's wall pair, meshed; patches near the common edge come up more often.
PolygonPair room_pair(Random& random) {
  const Vec3 side(1, aspect(random), aspect(random));
  const int columns = 1 + random.below(8), rows = 1 + random.below(8), rows_q = 1 + random.below(8);
  const int columns_q = random.below(10) < 7 ? columns : 1 + random.below(8);
  const auto near = [&](int count) { return std::min(random.below(count), random.below(count)); };
  const int u = random.below(columns), v = random.below(columns_q);
  const double width = side.x / columns, width_q = side.x / columns_q;
  if (random.below(3) > 0) {
    const Corner corner = corner_of(random);
    const double height = side.y / rows, height_q = side.z / rows_q;
    return {corner.on_p(u * width, width, near(rows) * height, height),
            corner.on_q(v * width_q, width_q, near(rows_q) * height_q, height_q), PairFamily::room};
  }
  const double height = side.y / rows, height_q = side.y / rows_q;
  const double y = random.below(rows) * height, y_q = random.below(rows_q) * height_q;
  return {parallelogram({u * width, y, 0}, {width, 0, 0}, {0, height, 0}),
          parallelogram({v * width_q, y_q, side.z}, {0, height_q, 0}, {width_q, 0, 0}),
          PairFamily::room};
}

PolygonPair rotated_pair(Random& random) {
  const double w = aspect(random), h = 1 / w;
  Vec3 n = random_direction(random);
  const auto [u, v] = frame(n, random);
  const double size = random.log_uniform(0.3, 2), stretch = aspect(random);
  const Vec3 along = u * (size * stretch);
  const Vec3 across = (v + u * (random.below(2) * random.uniform(-0.8, 0.8))) * (size / stretch);
  const Vec3 centre(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(0.1, 2));
  const Polygon p = parallelogram({-w / 2, -h / 2, 0}, {w, 0, 0}, {0, h, 0});
  // Turned to face the other one.
  const Polygon q = glm::dot(n, centre) < 0
                        ? parallelogram(centre - (along + across) / 2.0, along, across)
                        : parallelogram(centre - (along + across) / 2.0, across, along);
  return {p, q, PairFamily::rotated};
}

// How many pairs of a family, and how much all of them weigh together.
struct Share {
  PairFamily family;
  double pairs, weight;
};
constexpr Share kShares[] = {
    {PairFamily::free, 20000, 0.25},    {PairFamily::edge, 8000, 0.20},
    {PairFamily::touching, 4000, 0.06}, {PairFamily::corner, 6000, 0.12},
    {PairFamily::room, 14000, 0.27},    {PairFamily::rotated, 8000, 0.10},
};

}  // namespace

std::uint64_t general_seed(std::uint64_t training_seed, PairUse use) {
  return 4 * training_seed + std::uint64_t(use);
}

PolygonPair general_pair(PairFamily family, std::uint64_t seed, std::uint64_t index) {
  Random random(seed * kPairFamilies + std::uint64_t(family), index);
  switch (family) {
    case PairFamily::free:
      return free_pair(random);
    case PairFamily::edge:
    case PairFamily::touching:
    case PairFamily::corner:
      return neighbours(family, random);
    case PairFamily::room:
      return room_pair(random);
    case PairFamily::rotated:
      return rotated_pair(random);
  }
  return free_pair(random);
}

bool sample_of(const PolygonPair& pair, double far_rho, Sample* sample) {
  const FixedScene fixed = FixedScene::of_polygons({pair.p, pair.q}, {});
  const auto engine = engine_pair(fixed.pod(), 0, 1);
  // Cut and very near pairs are handed over to the exact sum.
  if (!engine || engine->clipped || engine->rho() > kGeneralNearRho) return false;
  const double exchange = reference_exchange(pair.p, pair.q);
  if (!(exchange > 0)) return false;
  std::copy_n(engine->invariants.input_q15, urad::kPairInputs, sample->input_q15.begin());
  sample->gate_uq16 = engine->rho() < far_rho ? std::uint16_t{0} : engine->invariants.gate_uq16;
  sample->target =
      std::log2(exchange) + 2 * std::log2(fixed.units_per_length()) - engine->log2_kernel();
  sample->weight = 1;
  return true;
}

GeneralDataset general_dataset(double far_rho, std::uint64_t seed, double scale, int threads) {
  GeneralDataset dataset;
  for (const PairUse use : {PairUse::training, PairUse::validation}) {
    const bool training = use == PairUse::training;
    TrainingSet& set = training ? dataset.training : dataset.validation;
    for (const Share& share : kShares) {
      const auto count = std::size_t(share.pairs * scale * (training ? 1 : 0.125));
      std::vector<std::optional<Sample>> seen(count);
      parallel_for(count, threads, [&](std::size_t k) {
        Sample sample;
        const PolygonPair pair = general_pair(share.family, general_seed(seed, use), k);
        if (sample_of(pair, far_rho, &sample) && sample.gate_uq16 != 0) seen[k] = sample;
      });
      double total = 0;
      for (const auto& sample : seen)
        if (sample) total += sample->weight;
      for (const auto& sample : seen) {
        if (!sample) continue;
        set.samples.push_back(*sample);
        set.samples.back().weight *= share.weight / total;
      }
    }
  }
  return dataset;
}

}  // namespace host
