#include "stress/growing_blockers.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "base/error.hpp"
#include "form_factor/monte_carlo.hpp"
#include "method/engine_source.hpp"
#include "stress/hostile_pairs.hpp"
#include "urad/vec.hpp"

namespace host {
namespace {

constexpr double kLeastGap = 2 * urad::kPlaneTolerance;  // units, of a blocker from p's plane

}  // namespace

void check_growing_blockers(const PolygonPair& pair, const NetChoice& nets, Findings* findings) {
  const double sizes[] = {0.05, 0.2, 0.8, 3};
  double before = monte_carlo(pair.p, pair.q, 256).f;
  for (const double size : sizes) {
    const double f = monte_carlo(pair.p, pair.q, 256, {blocker_between(pair, 8, 0.5, size)}).f;
    findings->measure("monte-carlo: growth with a blocker", f > before ? 1 - before / f : 0, 1e-12);
    before = f;
  }
  const Vec3 half_way = 0.5 * (moments(pair.q).centroid - moments(pair.p).centroid);
  for (const char* name : {"fixed-moment", "hemicube:32", "hybrid:32"}) {
    try {
      double open = 0, last = 0;
      for (std::size_t k = 0; k < std::size(sizes) + 1; ++k) {
        std::vector<Polygon> blockers;
        // Large ones behind p and behind q are always there and keep the scene's unit and centre.
        if (k > 0) blockers.push_back(blocker_between(pair, 8, 0.5, sizes[k - 1]));
        for (const double behind : {-3.0, 4.0})
          blockers.push_back(blocker_between(pair, 8, behind, 3 * sizes[3]));
        const FixedScene scene = FixedScene::of_polygons({pair.p, pair.q}, blockers);
        const EngineSource source(scene, parse_method(name), nets, {});
        std::array<std::uint32_t, 2> row{};
        source.row(0, row.data());
        if (k == 0) last = open = row[1];
        // A blocker so close to p's plane as corners are rounded is taken to lie in it. Where no eye
        // of the item buffer sees the receiver, the hybrid asks rays from the whole patch: a greater
        // blocker may then let more through than the eyes said of a smaller one.
        const bool apart = glm::length(half_way) * scene.units_per_length() > kLeastGap;
        if (open > 0 && apart)
          findings->measure(fmt::format("{}: growth with a blocker, of the open factor", name),
                            std::max(0.0, row[1] - last - 1) / open,
                            std::string_view(name) == "hybrid:32"
                                ? std::numeric_limits<double>::infinity()
                                : 1e-3);
        last = row[1];
      }
    } catch (const Error&) {  // sizes that no common unit can hold
    }
  }
}

}  // namespace host
