#include "accuracy/reference_checks.hpp"

#include <algorithm>
#include <cmath>

#include "accuracy/pair_families.hpp"
#include "base/parallel.hpp"
#include "form_factor/reference.hpp"

namespace host {

namespace {

void count(const PolygonPair& pair, double f, HostileCheck* check) {
  ++check->draws;
  if (!std::isfinite(f)) {
    ++check->not_finite;
    return;
  }
  if (f < 0) ++check->negative;
  if (f > 1) ++check->above_one;
  const double area_p = moments(pair.p).area, area_q = moments(pair.q).area;
  const double back = reference_form_factor(pair.q, pair.p);
  check->asymmetry =
      std::max(check->asymmetry, std::fabs(area_p * f - area_q * back) / std::min(area_p, area_q));
}

// Draw `index` of a family, whatever the order of evaluation.
PolygonPair draw(const DegenerateFamily& family, std::uint64_t seed, std::size_t index) {
  Random random(seed, index);
  return family.draw(random);
}

void add(const HostileCheck& part, HostileCheck* sum) {
  sum->draws += part.draws;
  sum->not_finite += part.not_finite;
  sum->negative += part.negative;
  sum->above_one += part.above_one;
  sum->asymmetry = std::max(sum->asymmetry, part.asymmetry);
}

}  // namespace

KnownCheck check_known_values(const std::vector<KnownValue>& values) {
  KnownCheck check;
  check.cases = values.size();
  for (const KnownValue& value : values) {
    const double error = std::fabs(reference_form_factor(value.p, value.q) - value.f);
    if (!(error / value.tolerance <= check.of_bound)) {
      check.of_bound = error / value.tolerance;
      check.worst_name = value.name;
    }
    check.worst = std::max(check.worst, error);
  }
  return check;
}

std::vector<HostileCheck> check_degenerate(std::uint64_t seed, std::size_t draws, int threads) {
  std::vector<HostileCheck> checks;
  for (const DegenerateFamily& family : degenerate_families()) {
    std::vector<HostileCheck> parts(draws);
    parallel_for(draws, threads, [&](std::size_t k) {
      const PolygonPair pair = draw(family, seed, k);
      count(pair, reference_form_factor(pair.p, pair.q), &parts[k]);
    });
    HostileCheck check;
    check.name = family.name;
    for (const HostileCheck& part : parts) add(part, &check);
    checks.push_back(check);
  }
  return checks;
}

ScaleCheck check_scales(std::uint64_t seed, std::size_t draws, int threads) {
  std::vector<DegenerateFamily> families = degenerate_families();
  families.push_back({"free quads", [](Random& r) { return random_facing_quads(r); }});
  ScaleCheck check;
  for (const DegenerateFamily& family : families) {
    std::vector<ScaleCheck> parts(draws);
    parallel_for(draws, threads, [&](std::size_t k) {
      const PolygonPair pair = draw(family, seed, k);
      const double f = reference_form_factor(pair.p, pair.q);
      for (int exponent = -12; exponent <= 12; exponent += 3) {
        const PolygonPair other = scaled(pair, std::pow(10.0, exponent));
        const double g = reference_form_factor(other.p, other.q);
        count(other, g, &parts[k].counts);
        parts[k].worst_change = std::max(parts[k].worst_change, std::fabs(g - f));
      }
    });
    for (const ScaleCheck& part : parts) {
      add(part.counts, &check.counts);
      check.worst_change = std::max(check.worst_change, part.worst_change);
    }
  }
  return check;
}

RowCheck check_rows(const Eigen::MatrixXd& form_factors) {
  RowCheck check;
  for (Eigen::Index i = 0; i < form_factors.rows(); ++i) {
    check.worst = std::max(check.worst, std::fabs(form_factors.row(i).sum() - 1));
    for (Eigen::Index j = 0; j < form_factors.cols(); ++j) {
      const double f = form_factors(i, j);
      check.largest = std::max(check.largest, f);
      if (f > 0) check.smallest = std::min(check.smallest, f);
    }
  }
  return check;
}

}  // namespace host
