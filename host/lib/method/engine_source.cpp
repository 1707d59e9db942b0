#include "method/engine_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <mutex>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "lanes/lane_rows.hpp"
#include "urad/form_factor.hpp"
#include "urad/hemicube_table.hpp"
#include "urad/hybrid.hpp"
#include "urad/lambert.hpp"
#include "urad/legacy.hpp"
#include "urad/pose_table.hpp"
#include "urad/visibility.hpp"

namespace host {

namespace {

constexpr int kDefaultHemicube = 64;

constexpr std::array kEngineMethods = {"fixed-kernel", "fixed-moment", "fixed-lambert",
                                       "net",          "auto",         "hemicube",
                                       "hybrid",       "table",        "legacy"};

void add(urad_counters* sum, const urad_counters& part) {
  auto* to = reinterpret_cast<std::uint32_t*>(sum);
  const auto* from = reinterpret_cast<const std::uint32_t*>(&part);
  for (std::size_t k = 0; k < sizeof(urad_counters) / sizeof(std::uint32_t); ++k) to[k] += from[k];
}

/// A hemicube with the tables and the memory it points to.
struct HemicubeHolder {
  std::vector<std::uint32_t> top, side, memory;
  urad::HemicubeSource source{};
  std::size_t bytes = 0;

  void init(const urad_scene& scene, int resolution, bool coverage, urad_counters* counters,
            bool four_eyes = false) {
    const std::size_t quarter = std::size_t(resolution / 2) * std::size_t(resolution / 2);
    std::vector<double> scratch(2 * quarter);
    top.resize(quarter);
    side.resize(quarter);
    urad::fill_hemicube_cells(resolution, scratch.data(), top.data(), side.data());
    const bool convex = scene.flags & URAD_SCENE_CONVEX;
    const auto rows = std::uint16_t(convex ? 0 : resolution);
    const auto flags =
        std::uint8_t(urad::hemicube_turned | (coverage && !convex ? urad::hemicube_coverage : 0) |
                     (four_eyes && !convex ? urad::hemicube_four_eyes : 0));
    bytes = urad::hemicube_bytes(std::uint16_t(resolution), rows, scene.patch_count,
                                 coverage && !convex);
    memory.resize((bytes + 3) / 4);
    const urad::HemicubeTable table{std::uint16_t(resolution), top.data(), side.data()};
    if (urad::hemicube_init(&source, &scene, table, rows, flags, memory.data(), memory.size() * 4,
                            counters) != urad::Status::ok) {
      throw UsageError(
          fmt::format("hemicube:{}: the resolution should be even, from 16 to 128", resolution));
    }
  }
};

}  // namespace

struct EngineSource::State {
  const urad_scene* scene = nullptr;
  urad_counters counters{};
  std::array<std::uint32_t, urad::kWays> ways{};
  urad::PairSource pairs{};
  HemicubeHolder hemicube;
  urad::HybridSource hybrid{};
  urad::PoseSource poses{};
  urad::LegacySource legacy{};
  std::vector<std::int32_t> legacy_memory;
  urad_source source{};
  std::size_t ram = 0;

  void use_pairs(urad::Kernel kernel, const urad_net* net, const EngineOptions& options) {
    pairs = {scene, net, kernel, std::uint16_t(options.rays), options.skips, &counters, 0};
    pairs.depth = std::uint8_t(options.cuts);
    pairs.error_uq32 = std::uint32_t(options.ray_error * 4294967296.0);
    pairs.bound_uq32 = std::uint32_t(options.bound * 4294967296.0);
    source = {urad::pair_fill, &pairs};
    ram = sizeof pairs;
  }

  void use_poses(const urad_pose_table* table) {
    if (!table)
      throw UsageError("--method table: only scenes have a pose table, free pairs do not");
    poses.scene = scene, poses.table = table, poses.counters = &counters;
    source = {urad::pose_fill, &poses};
    ram = sizeof poses;
  }

  void use_cheapest(std::int16_t log2_error_q8, const urad_net* net, const EngineOptions& options) {
    use_pairs(urad::Kernel::moment, net, options);
    pairs.log2_error_q8 = log2_error_q8;
    pairs.exchange = urad::cheapest_of_source;
    pairs.ways = ways.data();
  }

  void use_hemicube(int resolution, bool coverage, const EngineOptions& options) {
    hemicube.init(*scene, resolution, coverage, &counters, coverage);
    if (options.all_rows) hemicube.source.flags |= urad::hemicube_all_rows;
    ram = hemicube.bytes;
    source = {urad::hemicube_fill, &hemicube.source};
  }

  void use_hybrid(int resolution, const urad_net* net, const EngineOptions& options) {
    use_hemicube(resolution, true, options);
    const bool convex = scene->flags & URAD_SCENE_CONVEX;
    if (urad::hybrid_init(&hybrid, &hemicube.source, urad::Kernel::moment, net,
                          std::uint16_t(options.rays),
                          convex ? urad::kThreePatches_uq16 : 0) != urad::Status::ok) {
      throw Error("hybrid: the engine refused the hemicube");
    }
    hybrid.skips_off = options.skips;
    source = {urad::hybrid_fill, &hybrid};
    ram += sizeof hybrid;
  }

  void use_legacy(const urad_legacy_net& net, const EngineOptions& options) {
    const std::size_t bytes = urad::legacy_bytes(net.hidden);
    legacy_memory.resize(bytes / sizeof(std::int32_t));
    if (urad::legacy_init(&legacy, scene, &net, std::uint16_t(options.rays), &counters,
                          legacy_memory.data(), bytes) != urad::Status::ok)
      throw Error(
          "legacy: the report's networks read up to four vertices; a mesh of quads and triangles "
          "would do");
    source = {urad::legacy_fill, &legacy};
    ram = sizeof legacy + bytes;
  }
};

std::int16_t auto_error_q8(const MethodSpec& spec) {
  return std::int16_t(std::floor(256 * std::log2(spec.real(0.01, 1e-6, 0.5))));
}

bool is_engine_method(const MethodSpec& spec) {
  return std::find(kEngineMethods.begin(), kEngineMethods.end(), spec.name) != kEngineMethods.end();
}

EngineSource::EngineSource(const FixedScene& scene, const MethodSpec& spec, const NetChoice& nets,
                           const EngineOptions& options)
    : state_(std::make_unique<State>()) {
  state_->scene = &scene.pod();
  if (spec.name == "fixed-kernel") {
    spec.expect_no_argument();
    state_->use_pairs(urad::Kernel::centre, nullptr, options);
  } else if (spec.name == "fixed-moment") {
    spec.expect_no_argument();
    state_->use_pairs(urad::Kernel::moment, nullptr, options);
  } else if (spec.name == "fixed-lambert") {
    state_->use_pairs(urad::Kernel::moment, nullptr, options);
    state_->pairs.points = std::uint8_t(spec.number(1, 1, urad::kMostLambertPoints));
  } else if (spec.name == "net") {
    state_->use_pairs(urad::Kernel::moment, &nets.find(spec.argument), options);
  } else if (spec.name == "auto") {
    state_->use_cheapest(auto_error_q8(spec), nets.general(), options);
  } else if (spec.name == "hemicube") {
    state_->use_hemicube(
        spec.number(kDefaultHemicube, urad::kHemicubeMinResolution, urad::kHemicubeMaxResolution),
        false, options);
  } else if (spec.name == "hybrid") {
    state_->use_hybrid(
        spec.number(kDefaultHemicube, urad::kHemicubeMinResolution, urad::kHemicubeMaxResolution),
        &nets.find(""), options);
  } else if (spec.name == "table") {
    spec.expect_no_argument();
    state_->use_poses(options.poses);
  } else if (spec.name == "legacy") {
    state_->use_legacy(nets.find_legacy(spec.argument), options);
  } else {
    throw UsageError(fmt::format("--method {}: not a method of the engine; those are {}",
                                 spec.text(), fmt::join(kEngineMethods, ", ")));
  }
}

EngineSource::~EngineSource() = default;
EngineSource::EngineSource(EngineSource&&) noexcept = default;

urad_source EngineSource::source() const { return state_->source; }
const urad_counters& EngineSource::counters() const { return state_->counters; }
const urad::PairSource* EngineSource::pairs() const {
  return state_->source.fill == urad::pair_fill ? &state_->pairs : nullptr;
}
const std::array<std::uint32_t, urad::kWays>& EngineSource::ways() const { return state_->ways; }
std::size_t EngineSource::ram_bytes() const { return state_->ram; }

void EngineSource::row(std::uint16_t shooter, std::uint32_t* f_uq32) const {
  const urad_scene& scene = *state_->scene;
  for (std::uint16_t s = 0; s < scene.surface_count; ++s) {
    const urad_surface& surface = scene.surface[s];
    const urad_status status =
        state_->source.fill(state_->source.context, shooter, s, surface.first_patch,
                            surface.patch_count, f_uq32 + surface.first_patch);
    if (status != URAD_OK)
      throw Error(fmt::format("patch {}: the engine answered status {}", shooter, int(status)));
  }
}

struct EngineVisibility::State {
  const urad_scene* scene = nullptr;
  int rays = 0;
  urad_counters counters{};
  HemicubeHolder hemicube;
};

EngineVisibility::EngineVisibility(const FixedScene& scene, int resolution, int rays)
    : state_(std::make_unique<State>()) {
  state_->scene = &scene.pod();
  state_->rays = rays;
  state_->hemicube.init(scene.pod(), resolution, true, &state_->counters, true);
}

EngineVisibility::~EngineVisibility() = default;

double EngineVisibility::fraction(std::uint16_t shooter, std::uint16_t receiver) const {
  const urad_scene& scene = *state_->scene;
  if (scene.flags & URAD_SCENE_CONVEX) return 1;
  if (urad::hemicube_render(&state_->hemicube.source, shooter) != urad::Status::ok) {
    throw Error(fmt::format("patch {}: the engine could not render its hemicube", shooter));
  }
  const double covered = state_->hemicube.source.coverage_uq32[receiver];
  if (covered > 0) return std::min(1.0, state_->hemicube.source.visible_uq32[receiver] / covered);
  return urad::visible_fraction_uq16(scene, urad::patch_at(scene, shooter),
                                     urad::patch_at(scene, receiver), std::uint16_t(state_->rays),
                                     true, &state_->counters) /
         65536.0;
}

EngineRows engine_rows(const FixedScene& scene, const MethodSpec& spec, const NetChoice& nets,
                       const EngineOptions& options, int threads) {
  EngineRows rows;
  rows.patches = scene.pod().patch_count;
  rows.f_uq32.resize(rows.patches * rows.patches);
  const auto since = [](std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const EngineSource first(scene, spec, nets, options);
  rows.ram_bytes = first.ram_bytes();
  if (const urad::PairSource* pairs = first.pairs(); pairs && has_lanes(*pairs)) {
    const auto start = std::chrono::steady_clock::now();
    lane_rows(*pairs, threads, rows.f_uq32, &rows.counters);
    rows.seconds = since(start) * double(thread_count(threads));
    rows.ways = first.ways();
    return rows;
  }
  std::mutex sum;
  const std::size_t workers = std::min(thread_count(threads), rows.patches);
  parallel_for(workers, threads, [&](std::size_t worker) {
    const auto start = std::chrono::steady_clock::now();
    const EngineSource source(scene, spec, nets, options);
    for (std::size_t i = worker; i < rows.patches; i += workers) {
      source.row(std::uint16_t(i), &rows.f_uq32[i * rows.patches]);
    }
    const std::lock_guard<std::mutex> guard(sum);
    add(&rows.counters, source.counters());
    for (std::size_t k = 0; k < rows.ways.size(); ++k) rows.ways[k] += source.ways()[k];
    rows.seconds += since(start);
  });
  return rows;
}

}  // namespace host
