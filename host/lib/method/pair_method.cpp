#include "method/pair_method.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/error.hpp"
#include "form_factor/closed_form.hpp"
#include "form_factor/contour_rule.hpp"
#include "form_factor/facing.hpp"
#include "form_factor/gauss.hpp"
#include "form_factor/kernel.hpp"
#include "form_factor/lambert.hpp"
#include "form_factor/monte_carlo.hpp"
#include "form_factor/reference.hpp"
#include "geometry/order.hpp"
#include "legacy/legacy_fixed.hpp"
#include "method/engine_source.hpp"
#include "urad/legacy.hpp"

namespace host {

namespace {

constexpr int kMostPoints = 32;
constexpr int kMostSamples = 1'000'000'000;

FreePairMethod exact(std::function<Estimate(const Polygon&, const Polygon&)> run,
                     bool knows_error) {
  return {
      [run = std::move(run)](const Polygon& p, const Polygon& q) { return PairResult{run(p, q)}; },
      knows_error};
}

PairResult by_closed_form(const Polygon& p, const Polygon& q) {
  const ClosedForm result = closed_form(p, q);
  if (result.ill_conditioned()) return {{}, "unsupported_ill_conditioned"};
  return {result.estimate()};
}

urad::CheapestPair cheapest_pair(const urad_scene& scene, std::uint16_t shooter,
                                 const urad_net* net, std::int16_t log2_error_q8) {
  urad_counters counters{};
  return urad::cheapest_exchange(scene, urad::patch_at(scene, shooter),
                                 urad::patch_at(scene, std::uint16_t(1 - shooter)), net,
                                 log2_error_q8, &counters);
}

/// Whether the engine finds nothing because one lies on the other's plane within its grid, and in
/// double it does not.
bool below_grid(const urad_scene& scene, const Polygon& p, const Polygon& q) {
  const urad::CheapestPair pair = cheapest_pair(scene, 0, nullptr, urad::kPercentError_q8);
  return pair.way == urad::Way::none && pair.log2_error_q8 == 0 && !clip_to_front(p, q).empty();
}

/// The engine's cheapest way and what it thinks of it, the rounding of F included.
Estimate cheapest(const urad_scene& scene, std::uint16_t shooter, const urad_net* net,
                  std::int16_t log2_error_q8) {
  const urad::CheapestPair pair = cheapest_pair(scene, shooter, net, log2_error_q8);
  if (pair.way == urad::Way::none) return {};
  const double f = urad::form_factor_uq32(pair.log2_exchange_q24,
                                          urad::patch_at(scene, shooter).shape->log2_area_q24) /
                   4294967296.0;
  const double rounding = 0.5 / 4294967296.0;
  return {f, std::exp2(pair.log2_error_q8 / 256.0) + (f > 0 ? rounding / f : 1)};
}

/// The pair as a scene of two surfaces, and one factor of its row: integers all the way.
FreePairMethod in_engine(const MethodSpec& spec, const NetChoice& nets) {
  EngineSource(  // NOLINT(bugprone-unused-raii): only whether it throws is asked
      FixedScene::of_polygons(
          {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}}, {{{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}, {}}}, {}),
      spec, nets, {});  // refuses a bad setting before the first pair
  const bool knows_error = spec.name == "auto";
  const std::int16_t log2_error_q8 = knows_error ? auto_error_q8(spec) : std::int16_t{0};
  const auto run = [spec, &nets, knows_error, log2_error_q8](const Polygon& p, const Polygon& q) {
    for (const Polygon* polygon : {&p, &q}) {
      std::size_t vertices = polygon->outer.size();
      for (const Loop& hole : polygon->holes) vertices += hole.size() + 2;
      if (vertices > URAD_POLYGON_MAX_VERTICES)
        return PairResult{{}, "unsupported_too_many_vertices"};
    }
    try {
      const Polygon from = standard_order(p), to = standard_order(q);
      const bool swapped = written_before(to, from);
      const FixedScene scene =
          FixedScene::of_polygons({swapped ? to : from, swapped ? from : to}, {});
      const std::uint16_t shooter = swapped ? 1 : 0;
      PairResult result;
      if (knows_error) {
        result.estimate = cheapest(scene.pod(), shooter, nets.general(), log2_error_q8);
      } else {
        const EngineSource source(scene, spec, nets, {});
        std::array<std::uint32_t, 2> row{};
        source.row(shooter, row.data());
        result.estimate.f = row[1 - shooter] / 4294967296.0;
      }
      if (result.estimate.f == 0 && below_grid(scene.pod(), p, q))
        return PairResult{{}, "unsupported_range"};
      return result;
    } catch (const Error&) {  // sizes that no common unit can hold
      return PairResult{{}, "unsupported_range"};
    }
  };
  return {run, knows_error};
}

/// A network of the report, in the engine's integers, with the coordinates as they are: moving a
/// pair changes what it says.
FreePairMethod legacy_pairs(const urad_legacy_net& net) {
  const auto run = [&net](const Polygon& p, const Polygon& q) {
    for (const Polygon* polygon : {&p, &q}) {
      if (polygon->outer.size() > 4 || !polygon->holes.empty())
        return PairResult{{}, "unsupported_not_a_quad"};
      for (const Vec3& x : polygon->outer)
        if (glm::any(glm::lessThan(x, Vec3(0))) || glm::any(glm::greaterThan(x, Vec3(1))))
          return PairResult{{}, "unsupported_outside_unit_cube"};
    }
    const Moments a = moments(p), b = moments(q);
    const Vec3 r = b.centroid - a.centroid;
    if (glm::dot(a.normal, r) <= 0 || glm::dot(b.normal, r) >= 0) return PairResult{};
    const std::uint16_t y_uq15 = legacy_output_uq15(net, legacy_input(p, q));
    return PairResult{{urad::legacy_form_factor_uq32(net, y_uq15) / 4294967296.0}};
  };
  return {run, false};
}

using Maker = std::function<FreePairMethod(const MethodSpec&)>;

const std::map<std::string, Maker>& host_methods() {
  static const std::map<std::string, Maker> makers = {
      {"reference",
       [](const MethodSpec& spec) {
         spec.expect_no_argument();
         return exact(reference_estimate, true);
       }},
      {"closed-form",
       [](const MethodSpec& spec) {
         spec.expect_no_argument();
         return FreePairMethod{by_closed_form, true};
       }},
      {"kernel",
       [](const MethodSpec& spec) {
         spec.expect_no_argument();
         return exact(centre_kernel_estimate, false);
       }},
      {"moment",
       [](const MethodSpec& spec) {
         spec.expect_no_argument();
         return exact(moment_kernel_estimate, false);
       }},
      {"lambert",
       [](const MethodSpec& spec) {
         const int n = spec.number(1, 1, kMostPoints);
         return exact([n](const Polygon& p, const Polygon& q) { return lambert_estimate(p, q, n); },
                      false);
       }},
      {"gauss",
       [](const MethodSpec& spec) {
         const int n = spec.number(2, 1, kMostPoints);
         return exact([n](const Polygon& p, const Polygon& q) { return gauss_estimate(p, q, n); },
                      false);
       }},
      {"contour",
       [](const MethodSpec& spec) {
         const int n = spec.number(2, 1, kMostPoints);
         const auto run = [n](const Polygon& p, const Polygon& q) {
           const Estimate estimate = contour_estimate(p, q, n);
           return std::isfinite(estimate.f) ? PairResult{estimate}
                                            : PairResult{{}, "unsupported_touching"};
         };
         return FreePairMethod{run, false};
       }},
      {"monte-carlo",
       [](const MethodSpec& spec) {
         const int n = spec.number(10000, 16, kMostSamples);
         return exact([n](const Polygon& p, const Polygon& q) { return monte_carlo(p, q, n); },
                      true);
       }},
  };
  return makers;
}

}  // namespace

const std::vector<std::string>& pair_method_names() {
  static const std::vector<std::string> names = {
      "reference",           "closed-form", "lambert:N",    "gauss:N",      "contour:N",
      "monte-carlo:SAMPLES", "kernel",      "moment",       "fixed-kernel", "fixed-moment",
      "fixed-lambert:N",     "net[:NAME]",  "auto[:ERROR]", "hemicube:R",   "legacy:NAME"};
  return names;
}

bool is_pair_method(const MethodSpec& spec) {
  return host_methods().count(spec.name) || (is_engine_method(spec) && spec.name != "hybrid");
}

FreePairMethod pair_method(const MethodSpec& spec, const NetChoice& nets) {
  if (spec.name == "legacy") return legacy_pairs(nets.find_legacy(spec.argument));
  if (is_engine_method(spec) && spec.name != "hybrid") return in_engine(spec, nets);
  const auto maker = host_methods().find(spec.name);
  if (maker != host_methods().end()) return maker->second(spec);
  std::vector<std::string> known = pair_method_names();
  known.insert(known.end(), {"with --scene hybrid[:R]", "with --scene rays:N"});
  throw unknown_method(spec, known);
}

}  // namespace host
