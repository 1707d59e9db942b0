#include "solve/moving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>

#include "base/error.hpp"
#include "scene/blockers.hpp"
#include "scene/grid_detect.hpp"
#include "urad/move.hpp"
#include "urad/radiosity.hpp"

namespace host {

namespace {

struct Bounds {
  Vec3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};

  void add(const Vec3& x) { low = glm::min(low, x), high = glm::max(high, x); }
  bool empty() const { return low.x > high.x; }
};

Bounds bounds_of(const Scene& scene, int surface) {
  Bounds bounds;
  const Surface& s = scene.surfaces[std::size_t(surface)];
  for (int k = s.first_patch; k < s.first_patch + s.patch_count; ++k)
    for (const Vec3& x : scene.patches[std::size_t(k)].polygon.outer) bounds.add(x);
  return bounds;
}

bool among(const std::vector<int>& surfaces, int surface) {
  return std::find(surfaces.begin(), surfaces.end(), surface) != surfaces.end();
}

void apply(const Motion& motion, Polygon* polygon) {
  for (Vec3& x : polygon->outer) x = motion(x);
  for (Loop& hole : polygon->holes)
    for (Vec3& x : hole) x = motion(x);
}

/// Every opaque polygon: whole grids, and the patches of lists.
std::vector<Blocker> outlines(const Scene& scene) {
  std::vector<Blocker> all;
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const Surface& surface = scene.surfaces[k];
    if (surface.grid) {
      all.push_back({grid_outline(*surface.grid), int(k)});
      continue;
    }
    for (int p = surface.first_patch; p < surface.first_patch + surface.patch_count; ++p)
      all.push_back({scene.patches[std::size_t(p)].polygon, int(k)});
  }
  return all;
}

/// Surfaces by the object they belong to: those that share a corner.
std::vector<int> objects_of(const Scene& scene) {
  std::vector<int> object(scene.surfaces.size());
  std::iota(object.begin(), object.end(), 0);
  std::map<std::array<double, 3>, int> owner;
  for (std::size_t k = 0; k < scene.patches.size(); ++k) {
    for (const Vec3& x : scene.patches[k].polygon.outer) {
      const int own = object[std::size_t(scene.patches[k].surface)];
      const auto [at, fresh] = owner.insert({{x.x, x.y, x.z}, scene.patches[k].surface});
      const int other = object[std::size_t(at->second)];
      if (other != own) std::replace(object.begin(), object.end(), own, other);
    }
  }
  return object;
}

void demand(urad_status status, const char* what) {
  if (status != URAD_OK)
    throw Error(fmt::format("{}: the engine answered status {}", what, int(status)));
}

urad_box box_of(const urad_scene& pod, const std::vector<int>& surfaces) {
  urad_box box{{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
  for (std::uint32_t k = 0; k < pod.blocker_count; ++k) {
    const urad_blocker& b = pod.blocker[k];
    if (!among(surfaces, b.surface)) continue;
    box.low = {std::min(box.low.x, b.low.x), std::min(box.low.y, b.low.y),
               std::min(box.low.z, b.low.z)};
    box.high = {std::max(box.high.x, b.high.x), std::max(box.high.y, b.high.y),
                std::max(box.high.z, b.high.z)};
  }
  return box;
}

}  // namespace

Scene moved_scene(const Scene& scene, const std::vector<int>& surfaces, const Motion& motion) {
  Scene moved = scene;
  for (const int k : surfaces) {
    Surface& surface = moved.surfaces[std::size_t(k)];
    if (surface.grid) {
      Grid& grid = *surface.grid;
      grid.origin = motion(grid.origin);
      grid.step_u = motion.turn * grid.step_u, grid.step_v = motion.turn * grid.step_v;
    }
    for (int p = surface.first_patch; p < surface.first_patch + surface.patch_count; ++p) {
      ScenePatch& patch = moved.patches[std::size_t(p)];
      apply(motion, &patch.polygon);
      patch.moments = moments(patch.polygon);
    }
  }
  moved.blockers = find_blockers(moved, outlines(moved));
  moved.convex = moved.blockers.empty();
  return moved;
}

std::vector<int> smallest_object(const Scene& scene) {
  const std::vector<int> object = objects_of(scene);
  std::map<int, int> patches;  // of each object that may move
  for (const Blocker& blocker : scene.blockers)
    if (blocker.surface >= 0) patches[object[std::size_t(blocker.surface)]] = 0;
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const auto at = patches.find(object[k]);
    if (at == patches.end()) continue;
    const bool lamp = scene.materials[std::size_t(scene.surfaces[k].material)].exitance != Vec3(0);
    if (lamp)
      patches.erase(at);
    else
      at->second += scene.surfaces[k].patch_count;
  }
  std::vector<int> smallest;
  const auto fewest = std::min_element(patches.begin(), patches.end(),
                                       [](auto& a, auto& b) { return a.second < b.second; });
  for (std::size_t k = 0; fewest != patches.end() && k < object.size(); ++k)
    if (object[k] == fewest->first) smallest.push_back(int(k));
  return smallest;
}

Vec3 free_way(const Scene& scene, const std::vector<int>& surfaces, const Vec3& up) {
  Bounds own;
  for (const int k : surfaces) {
    const Bounds b = bounds_of(scene, k);
    own.add(b.low), own.add(b.high);
  }
  const Vec3 size = own.high - own.low, high = glm::abs(up);
  const int upright = high.x > high.y ? (high.x > high.z ? 0 : 2) : (high.y > high.z ? 1 : 2);
  Vec3 best(0);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == upright) continue;
    for (const int sign : {-1, 1}) {
      double way = std::numeric_limits<double>::max();
      for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
        if (among(surfaces, int(k))) continue;
        const Bounds b = bounds_of(scene, int(k));
        bool beside = false;  // or only touched: a floor
        for (int other = 0; other < 3; ++other) {
          const double slack = 1e-3 * size[other];
          beside = beside || (other != axis && (b.low[other] > own.high[other] - slack ||
                                                b.high[other] < own.low[other] + slack));
        }
        const double gap = sign > 0 ? b.low[axis] - own.high[axis] : own.low[axis] - b.high[axis];
        if (!beside && gap >= 0) way = std::min(way, gap);
      }
      if (way < std::numeric_limits<double>::max() && way / 2 > glm::length(best)) {
        best = Vec3(0);
        best[axis] = 0.5 * sign * way;
      }
    }
  }
  return best;
}

struct Moving::Stage {
  Scene scene;
  FixedScene fixed;
  EngineSource source;
  std::size_t patches;
  std::vector<std::vector<std::uint32_t>> rows;
  bool direct = false;  // moving: runs, not rows, are asked for

  Stage(const Scene& s, const MethodSpec& method, const NetChoice& nets,
        const EngineOptions& options)
      : scene(s),
        fixed(scene),
        source(fixed, method, nets, options),
        patches(scene.patches.size()),
        rows(patches) {}

  static urad_status fill(void* context, std::uint16_t shooter, std::uint16_t surface,
                          std::uint16_t first, std::uint16_t count, std::uint32_t* f_uq32) {
    Stage& self = *static_cast<Stage*>(context);
    std::vector<std::uint32_t>& row = self.rows[shooter];
    if (row.empty() && self.direct) {
      const urad_source& source = self.source.source();
      return source.fill(source.context, shooter, surface, first, count, f_uq32);
    }
    if (row.empty()) {
      row.resize(self.patches);
      self.source.row(shooter, row.data());
    }
    std::copy_n(row.begin() + first, count, f_uq32);
    return URAD_OK;
  }
  urad_source as_source() { return {fill, this}; }
};

Moving::Moving(const Scene& scene, const MethodSpec& method, const NetChoice& nets,
               const EngineOptions& options, bool overshoot)
    : method_(method), nets_(nets), options_(options), now_(stage(scene)) {
  const urad_scene& pod = now_->fixed.pod();
  const std::uint16_t run = urad::longest_run(pod);
  memory_.resize(urad::radiosity_bytes(pod.patch_count, run) / 4);
  demand(urad_status(urad::radiosity_init(&state_, &pod, now_->as_source(),
                                          overshoot ? URAD_OVERSHOOT : 0, run, memory_.data(),
                                          memory_.size() * 4)),
         "starting a solve");
}

Moving::~Moving() = default;

std::unique_ptr<Moving::Stage> Moving::stage(const Scene& scene) const {
  return std::make_unique<Stage>(scene, method_, nets_, options_);
}

const Scene& Moving::scene() const { return now_->scene; }

void Moving::move(const std::vector<int>& surfaces, const Motion& motion) {
  std::unique_ptr<Stage> next = stage(moved_scene(now_->scene, surfaces, motion));
  if (next->fixed.units_per_length() != now_->fixed.units_per_length() ||
      next->fixed.exitance_unit() != now_->fixed.exitance_unit())
    throw Error(now_->scene.name + ": a move out of the box of the scene; a shorter one would do");
  last_ = {};
  std::size_t first = now_->patches, end = 0;
  for (const int k : surfaces) {
    const Surface& s = now_->scene.surfaces[std::size_t(k)];
    first = std::min(first, std::size_t(s.first_patch));
    end = std::max(end, std::size_t(s.first_patch + s.patch_count));
  }
  last_.first_patch = std::uint16_t(first);
  last_.patch_count = std::uint16_t(end - std::min(first, end));
  for (const Stage* s : {now_.get(), next.get()}) {
    const urad_box box = box_of(s->fixed.pod(), surfaces);
    if (box.low.x <= box.high.x) last_.box[last_.box_count++] = box;
  }
  now_->direct = next->direct = true;
  demand(urad_radiosity_move_begin(&state_, &last_), "a move");
  const urad_source source = next->as_source();
  demand(urad_radiosity_move_end(&state_, &last_, &next->fixed.pod(), &source), "a move");
  next->direct = false;
  now_ = std::move(next);
}

int Moving::step(int shots) {
  std::uint32_t made = 0;
  demand(urad_status(urad::radiosity_steps(&state_, std::uint32_t(shots), 0, &made)), "shooting");
  return int(made);
}

std::vector<Vec3> Moving::radiosity() const {
  std::vector<Vec3> b(now_->patches);
  for (std::size_t k = 0; k < b.size(); ++k) {
    for (int c = 0; c < 3; ++c)
      b[k][c] = urad::radiosity_get(state_, std::uint16_t(k), c) * now_->fixed.exitance_unit();
  }
  return b;
}

}  // namespace host
