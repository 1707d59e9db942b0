#include "accuracy/closed_form_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "accuracy/pair_families.hpp"
#include "base/parallel.hpp"
#include "form_factor/closed_form.hpp"
#include "form_factor/reference.hpp"

namespace host {

namespace {

void count(const Polygon& p, const Polygon& q, const Estimate& exact, ClosedFormCheck* check) {
  const ClosedForm result = closed_form(p, q);
  ++check->pairs;
  if (!(result.f >= 0 && result.f <= 1)) check->worst = std::numeric_limits<double>::infinity();
  if (result.ill_conditioned()) {
    ++check->refused;
    return;
  }
  const double error = std::fabs(result.f - exact.f);
  check->worst = std::max(check->worst, error);
  check->largest_bound = std::max(check->largest_bound, result.error);
  if (!(error <= result.error + exact.f * exact.relative_error)) ++check->understated;
}

void add(const ClosedFormCheck& part, ClosedFormCheck* sum) {
  sum->pairs += part.pairs;
  sum->refused += part.refused;
  sum->understated += part.understated;
  sum->worst = std::max(sum->worst, part.worst);
  sum->largest_bound = std::max(sum->largest_bound, part.largest_bound);
}

}  // namespace

std::vector<ClosedFormCheck> check_closed_form(std::uint64_t seed, std::size_t draws, int threads) {
  std::vector<DegenerateFamily> families = {
      {"free quads in front of each other", [](Random& r) { return random_facing_quads(r); }},
      {"free quads, cut", [](Random& r) {
         return PolygonPair{random_quad(r), random_quad(r)};
       }}};
  const std::size_t random = families.size();
  for (const DegenerateFamily& family : degenerate_families()) families.push_back(family);
  std::vector<ClosedFormCheck> checks;
  for (const DegenerateFamily& family : families) {
    std::vector<ClosedFormCheck> parts(draws);
    parallel_for(draws, threads, [&](std::size_t k) {
      Random source(seed, k);
      const PolygonPair pair = family.draw(source);
      count(pair.p, pair.q, reference_estimate(pair.p, pair.q), &parts[k]);
    });
    ClosedFormCheck check{family.name, checks.size() < random};
    for (const ClosedFormCheck& part : parts) add(part, &check);
    checks.push_back(check);
  }
  return checks;
}

ClosedFormCheck check_closed_form(const Scene& scene, const Eigen::MatrixXd& form_factors,
                                  int threads) {
  constexpr double kRowError = 1e-12;  // promised of the reference, of a whole row
  const std::size_t n = scene.patches.size();
  std::vector<ClosedFormCheck> rows(n);
  parallel_for(n, threads, [&](std::size_t i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double exact = form_factors(Eigen::Index(i), Eigen::Index(j));
      count(scene.patches[i].polygon, scene.patches[j].polygon,
            {exact, exact > 0 ? kRowError / exact : 0}, &rows[i]);
    }
  });
  ClosedFormCheck check{"all pairs of " + scene.name};
  for (const ClosedFormCheck& row : rows) add(row, &check);
  return check;
}

}  // namespace host
