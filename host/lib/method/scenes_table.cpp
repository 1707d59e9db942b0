#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "form_factor/monte_carlo.hpp"
#include "form_factor/reference.hpp"
#include "geometry/parse.hpp"
#include "method/engine_source.hpp"
#include "method/pairs_table.hpp"
#include "scene/cut.hpp"
#include "scene/grid_detect.hpp"
#include "urad/hemicube_table.hpp"
#include "urad/visibility.hpp"

namespace host {

namespace {

constexpr int kRaysForUncovered = 256;

/// One scene of the file: from P to Q past B.
struct OccludedPlates {
  std::string name;
  std::vector<Polygon> from, to, blockers;
  std::string status = "ok";
};

void add_row(OccludedPlates* plates, const std::string& role, const std::string& text) {
  if (plates->status != "ok") return;
  const ParsedPolygon parsed = parse_polygon(text);
  if (parsed.status != PolygonStatus::ok) {
    plates->status = name(parsed.status);
  } else if (role == "P") {
    plates->from.push_back(parsed.polygon);
  } else if (role == "Q") {
    plates->to.push_back(parsed.polygon);
  } else if (role == "B") {
    plates->blockers.push_back(parsed.polygon);
  } else {
    plates->status = "invalid_role";
  }
}

std::vector<OccludedPlates> read_scenes(const CsvTable& rows) {
  const std::size_t scene = rows.column("scene"), role = rows.column("role"),
                    polygon = rows.column("polygon");
  std::vector<OccludedPlates> scenes;
  std::map<std::string, std::size_t> known;
  for (const CsvRow& row : rows.rows) {
    const bool whole = row.cells.size() == rows.header.size();
    const std::string title = scene < row.cells.size() ? row.cells[scene] : "";
    const auto [at, added] = known.try_emplace(title, scenes.size());
    if (added) scenes.push_back({title, {}, {}, {}});
    OccludedPlates& plates = scenes[at->second];
    if (whole) {
      add_row(&plates, row.cells[role], row.cells[polygon]);
    } else if (plates.status == "ok") {
      plates.status = "invalid_syntax";
    }
  }
  for (OccludedPlates& plates : scenes) {
    if (plates.status == "ok" && plates.from.empty()) plates.status = "invalid_no_p";
    if (plates.status == "ok" && plates.to.empty()) plates.status = "invalid_no_q";
  }
  return scenes;
}

/// False when the blocker cannot touch any segment between p and q: it lies behind one of the
/// planes, or outside their box.
bool may_block(const Polygon& p, const Polygon& q, const Polygon& blocker) {
  const auto behind = [&blocker](const Moments& plane) {
    const double tolerance = 1e-12 * glm::length(plane.centroid - blocker.outer.front());
    return std::all_of(blocker.outer.begin(), blocker.outer.end(), [&](const Vec3& x) {
      return glm::dot(plane.normal, x - plane.centroid) <= tolerance;
    });
  };
  if (behind(moments(p)) || behind(moments(q))) return false;
  Vec3 low = p.outer.front(), high = low;
  for (const Polygon* polygon : {&p, &q}) {
    for (const Vec3& x : polygon->outer) low = glm::min(low, x), high = glm::max(high, x);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto beyond = [&](auto outside) {
      return std::all_of(blocker.outer.begin(), blocker.outer.end(), outside);
    };
    if (beyond([&](const Vec3& x) { return x[axis] <= low[axis]; }) && low[axis] < high[axis])
      return false;
    if (beyond([&](const Vec3& x) { return x[axis] >= high[axis]; }) && low[axis] < high[axis])
      return false;
  }
  return true;
}

/// What a method says of a scene: exchange of P with all of Q, or why not.
struct SceneResult {
  double exchange = 0;
  std::string status = "ok";
};

using Pieces = std::vector<Polygon>;
using SceneMethod = std::function<SceneResult(const OccludedPlates&, const Pieces&)>;

SceneResult by_reference(const OccludedPlates& plates, const Pieces& pieces) {
  SceneResult result;
  for (const Polygon& piece : pieces) {
    for (const Polygon& q : plates.to) {
      const bool clear =
          std::none_of(plates.blockers.begin(), plates.blockers.end(),
                       [&](const Polygon& blocker) { return may_block(piece, q, blocker); });
      if (!clear) return {0, "unsupported_occluded"};
      result.exchange += reference_exchange(piece, q);
    }
  }
  return result;
}

SceneResult by_monte_carlo(const OccludedPlates& plates, const Pieces& pieces, int samples) {
  SceneResult result;
  for (const Polygon& piece : pieces) {
    for (const Polygon& q : plates.to) {
      result.exchange += moments(piece).area * monte_carlo(piece, q, samples, plates.blockers).f;
    }
  }
  return result;
}

/// The parts of the blockers inside the box of the patches, the only ones that can stand between
/// them: a blocker of any size then leaves the scene unit to the patches.
std::vector<Polygon> between(const Pieces& patches, const std::vector<Polygon>& blockers) {
  Vec3 low = patches.front().outer.front(), high = low;
  for (const Polygon& patch : patches) {
    for (const Vec3& x : patch.outer) low = glm::min(low, x), high = glm::max(high, x);
  }
  const double margin = 0.01 * glm::length(high - low);
  std::vector<Polygon> parts;
  for (Polygon part : blockers) {
    for (int axis = 0; axis < 3 && !part.outer.empty(); ++axis) {
      Vec3 inward(0);
      inward[axis] = 1;
      part = clip(part, low - margin, inward);
      if (!part.outer.empty()) part = clip(part, high + margin, -inward);
    }
    if (!part.outer.empty() && moments(part).area > 0) parts.push_back(part);
  }
  return parts;
}

/// Pieces first, then Q; blockers belong to no surface. In one scene, so that every piece has a
/// number of its own and the sampling errors of different pieces are independent.
FixedScene fixed_scene(const OccludedPlates& plates, const Pieces& pieces) {
  Pieces patches = pieces;
  patches.insert(patches.end(), plates.to.begin(), plates.to.end());
  return FixedScene::of_polygons(patches, between(patches, plates.blockers));
}

SceneResult by_rays(const OccludedPlates& plates, const Pieces& pieces, int rays) {
  SceneResult result;
  const FixedScene scene = fixed_scene(plates, pieces);
  urad_counters counters{};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const urad::Patch from = urad::patch_at(scene.pod(), std::uint16_t(i));
    for (std::size_t k = 0; k < plates.to.size(); ++k) {
      const urad::Patch to = urad::patch_at(scene.pod(), std::uint16_t(pieces.size() + k));
      const std::uint32_t seen_uq16 =
          urad::visible_fraction_uq16(scene.pod(), from, to, std::uint16_t(rays), true, &counters);
      result.exchange += seen_uq16 / 65536.0 * reference_exchange(pieces[i], plates.to[k]);
    }
  }
  return result;
}

SceneResult by_hemicube(const OccludedPlates& plates, const Pieces& pieces, const MethodSpec& spec,
                        const NetChoice& nets) {
  SceneResult result;
  const FixedScene scene = fixed_scene(plates, pieces);
  const EngineSource source(scene, spec, nets, {});
  std::vector<std::uint32_t> row(pieces.size() + plates.to.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    source.row(std::uint16_t(i), row.data());
    for (std::size_t k = pieces.size(); k < row.size(); ++k) {
      result.exchange += moments(pieces[i]).area * row[k] / 4294967296.0;
    }
  }
  return result;
}

/// The hemicube's visible fraction times the exact factor; rays where a receiver covers no cell.
SceneResult by_hybrid(const OccludedPlates& plates, const Pieces& pieces, int resolution) {
  SceneResult result;
  const FixedScene scene = fixed_scene(plates, pieces);
  const EngineVisibility visible(scene, resolution, kRaysForUncovered);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t k = 0; k < plates.to.size(); ++k) {
      result.exchange += visible.fraction(std::uint16_t(i), std::uint16_t(pieces.size() + k)) *
                         reference_exchange(pieces[i], plates.to[k]);
    }
  }
  return result;
}

SceneMethod scene_method(const MethodSpec& spec, const NetChoice& nets) {
  if (spec.name == "reference") return by_reference;
  if (spec.name == "monte-carlo") {
    const int n = spec.number(100000, 16, 1'000'000'000);
    return
        [n](const auto& plates, const Pieces& pieces) { return by_monte_carlo(plates, pieces, n); };
  }
  if (spec.name == "rays") {
    const int n = spec.number(256, 1, urad::kMaxRays);
    return [n](const auto& plates, const Pieces& pieces) { return by_rays(plates, pieces, n); };
  }
  if (spec.name == "hemicube") {
    spec.number(64, urad::kHemicubeMinResolution, urad::kHemicubeMaxResolution);
    return [spec, &nets](const auto& plates, const Pieces& pieces) {
      return by_hemicube(plates, pieces, spec, nets);
    };
  }
  if (spec.name == "hybrid") {
    const int n = spec.number(64, urad::kHemicubeMinResolution, urad::kHemicubeMaxResolution);
    return [n](const auto& plates, const Pieces& pieces) { return by_hybrid(plates, pieces, n); };
  }
  throw UsageError(fmt::format(
      "--method {}: not for scenes with blockers; those are reference, monte-carlo:N, hemicube:R, "
      "hybrid[:R], rays:N",
      spec.text()));
}

/// P in about n x n pieces.
Pieces pieces_of(const Polygon& polygon, int n) {
  if (n == 1) return {polygon};
  std::size_t total = 0;
  Piece piece = cut_face({polygon, 0, {1, 1}, "--subdivide"}, {n, 0}, &total);
  if (!piece.grid) return piece.patches;
  std::vector<Polygon> patches;
  for (int v = 0; v < piece.grid->count_v; ++v) {
    for (int u = 0; u < piece.grid->count_u; ++u) patches.push_back(grid_patch(*piece.grid, u, v));
  }
  return patches;
}

SceneResult whole(const OccludedPlates& plates, const SceneMethod& method, int subdivide) {
  if (plates.status != "ok") return {0, plates.status};
  Pieces pieces;
  double area = 0;
  for (const Polygon& p : plates.from) {
    for (const Polygon& piece : pieces_of(p, subdivide)) {
      pieces.push_back(piece);
      area += moments(piece).area;
    }
  }
  if (pieces.size() + plates.to.size() > 65535) return {0, "unsupported_too_many_pieces"};
  try {
    SceneResult result = method(plates, pieces);
    result.exchange = std::clamp(result.exchange / area, 0.0, 1.0);
    if (!std::isfinite(result.exchange)) return {0, "unsupported_range"};
    return result;
  } catch (
      const Error&) {  // more vertices than the engine takes, or sizes that no common unit can hold
    return {0, "unsupported_polygon"};
  }
}

}  // namespace

std::string scenes_table(const CsvTable& rows, const MethodSpec& spec, const NetChoice& nets,
                         int subdivide, int threads, bool quiet) {
  const SceneMethod method = scene_method(spec, nets);
  const std::vector<OccludedPlates> scenes = read_scenes(rows);
  std::vector<SceneResult> results(scenes.size());
  Progress progress("scenes", scenes.size(), quiet);
  parallel_for(scenes.size(), threads, [&](std::size_t k) {
    results[k] = whole(scenes[k], method, subdivide);
    progress.add();
  });
  std::string text = csv_line({"scene", "f", "status"});
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const bool ok = results[k].status == "ok";
    text +=
        csv_line({scenes[k].name, ok ? csv_number(results[k].exchange) : "", results[k].status});
  }
  return text;
}

}  // namespace host
