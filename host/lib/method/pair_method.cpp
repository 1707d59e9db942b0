#include "method/pair_method.hpp"

#include <fmt/format.h>

#include <map>

#include "base/error.hpp"
#include "form_factor/closed_form.hpp"
#include "form_factor/gauss.hpp"
#include "form_factor/kernel.hpp"
#include "form_factor/lambert.hpp"
#include "form_factor/monte_carlo.hpp"
#include "form_factor/reference.hpp"
#include "geometry/order.hpp"
#include "method/engine_source.hpp"

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

/// The pair as a scene of two surfaces, and one factor of its row: integers all the way.
FreePairMethod in_engine(const MethodSpec& spec, const NetChoice& nets) {
  EngineSource(
      FixedScene::of_polygons(
          {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}}, {{{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}, {}}}, {}),
      spec, nets, {});  // refuses a bad setting before the first pair
  const auto run = [spec, &nets](const Polygon& p, const Polygon& q) {
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
      const EngineSource source(scene, spec, nets, {});
      std::array<std::uint32_t, 2> row{};
      source.row(swapped ? 1 : 0, row.data());
      return PairResult{{row[swapped ? 0 : 1] / 4294967296.0}};
    } catch (const Error&) {  // sizes that no common unit can hold
      return PairResult{{}, "unsupported_range"};
    }
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

FreePairMethod pair_method(const MethodSpec& spec, const NetChoice& nets) {
  if (is_engine_method(spec) && spec.name != "hybrid") return in_engine(spec, nets);
  const auto maker = host_methods().find(spec.name);
  if (maker == host_methods().end()) {
    throw UsageError(
        fmt::format("--method {}: unknown; known are reference, closed-form, lambert:N, "
                    "gauss:N, monte-carlo:SAMPLES, kernel, "
                    "moment, fixed-kernel, fixed-moment, fixed-lambert:N, net[:NAME], hemicube:R",
                    spec.text()));
  }
  return maker->second(spec);
}

}  // namespace host
