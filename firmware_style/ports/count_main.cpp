// count LABELS -- runs pieces of the engine between region marks, for the instruction counter of
// bench/icount.
//
// LABELS receives one line per region, in the order in which the counter writes its counts. A piece
// that depends on its input is run on many inputs: every patch of the other surfaces, seen from the
// middle of the first surface.
#include URAD_SCENE_HEADER
#include URAD_NET_HEADER
#ifdef URAD_POSES_HEADER
#include URAD_POSES_HEADER
#endif
#ifdef URAD_LEGACY_HEADER
#include URAD_LEGACY_HEADER
#endif
#include "port.hpp"
#include "regions.hpp"
#include "text.hpp"
#include "urad/cheapest.hpp"
#include "urad/form_factor.hpp"
#include "urad/hemicube_table.hpp"
#include "urad/hybrid.hpp"
#include "urad/lambert.hpp"
#include "urad/legacy.hpp"
#include "urad/pose_table.hpp"
#include "urad/radiosity.hpp"
#include "urad/urad.h"

namespace {

const urad_scene& kScene = URAD_SCENE_NAME;

constexpr uint16_t kLongestRun = 64;
constexpr int kShots = 8;
constexpr int kMostResolution = 64;
template <int R>
constexpr urad::HemicubeCells<R> kCells = urad::make_hemicube_table<R>();

uint32_t g_memory[urad::radiosity_bytes(URAD_PATCHES_MAX, kLongestRun) / 4];
uint32_t g_factors[kLongestRun];
uint32_t g_hemicube_memory[urad::hemicube_bytes(kMostResolution, 0, URAD_PATCHES_MAX, false) / 4];
urad_counters g_counters;
urad::Radiosity g_radiosity;
volatile int32_t g_sink;

/// A piece of work between marks, labelled.
template <class Work>
void measure(port::Writer& labels, const char* label, const Work& work) {
  URAD_REGION_BEGIN();
  work();
  URAD_REGION_END();
  labels.text(label).text("\n");
}

/// The solver alone: all patches see each other alike, at no cost.
urad_status even_fill(void*, uint16_t, uint16_t, uint16_t, uint16_t count, uint32_t* f_uq32) {
  for (uint16_t k = 0; k < count; ++k) f_uq32[k] = 1u << 23;
  return URAD_OK;
}

void pairs(port::Writer& labels, uint16_t shooter, uint16_t receiver) {
  const auto exchange = [&](urad::Kernel kernel, const urad_net* net) {
    return [&, kernel, net] {
      const urad::Patch i = urad::patch_at(kScene, shooter), j = urad::patch_at(kScene, receiver);
      g_sink = urad::exchange_log2_q24(kScene, i, j, kernel, net, 0, &g_counters);
    };
  };
  const urad_counters before = g_counters;
  exchange(urad::Kernel::moment, &URAD_NET_NAME)();
  if (g_counters.evaluated == before.evaluated) return;  // the two do not face each other
  const bool clipped = g_counters.clipped != before.clipped;
  const bool far = g_counters.far_pairs != before.far_pairs;
  measure(labels, "pair_centre", exchange(urad::Kernel::centre, nullptr));
  measure(labels, "pair_moment", exchange(urad::Kernel::moment, nullptr));
  measure(labels,
          clipped ? "pair_network_clipped"
          : far   ? "pair_network_far"
                  : "pair_network",
          exchange(urad::Kernel::moment, &URAD_NET_NAME));
}

/// What auto takes, without a network, and one point of an exact sum.
void sums(port::Writer& labels, uint16_t shooter, uint16_t receiver) {
  const urad::Patch i = urad::patch_at(kScene, shooter), j = urad::patch_at(kScene, receiver);
  const auto cheapest = [&] {
    return urad::cheapest_exchange(kScene, i, j, nullptr, urad::kPercentError_q8, &g_counters);
  };
  if (cheapest().way == urad::Way::none) return;
  measure(labels, "pair_auto", [&] { g_sink = cheapest().log2_exchange_q24; });
  measure(labels, "pair_point",
          [&] { g_sink = urad::lambert_refined(kScene, i, j, 1, 0).log2_exchange_q24; });
}

bool shots(port::Writer& labels, const char* label, const urad_source& source, int count) {
  bool good = urad::radiosity_init(&g_radiosity, &kScene, source, URAD_OVERSHOOT, kLongestRun,
                                   g_memory, sizeof g_memory) == urad::Status::ok;
  for (int k = 0; good && k < count; ++k)
    measure(labels, label, [&] { good = urad::radiosity_step(&g_radiosity) == urad::Status::ok; });
  return good;
}

/// init to done, 1 %.
bool solve(port::Writer& labels, const char* label, const urad_source& source) {
  bool good = false;
  measure(labels, label, [&] {
    good = urad::radiosity_init(&g_radiosity, &kScene, source, URAD_OVERSHOOT, kLongestRun,
                                g_memory, sizeof g_memory) == urad::Status::ok;
    while (good && !urad::radiosity_done(g_radiosity, URAD_PERCENT))
      good = urad::radiosity_step(&g_radiosity) == urad::Status::ok;
  });
  return good;
}

/// Only on a convex scene: its hemicube needs no item buffer, which would not fit beside the light
/// in 16 KB.
template <int R>
bool hemicube_shots(port::Writer& labels, const char* alone, const char* with_network) {
  if (!(kScene.flags & URAD_SCENE_CONVEX)) return true;
  urad::HemicubeSource hemicube;
  if (urad::hemicube_init(&hemicube, &kScene, urad::hemicube_table(kCells<R>), 0,
                          urad::hemicube_turned, g_hemicube_memory, sizeof g_hemicube_memory,
                          &g_counters) != urad::Status::ok ||
      !shots(labels, alone, {urad::hemicube_fill, &hemicube}, kShots))
    return false;
  urad::HybridSource hybrid;
  return urad::hybrid_init(&hybrid, &hemicube, urad::Kernel::moment, &URAD_NET_NAME, 1,
                           urad::kThreePatches_uq16) == urad::Status::ok &&
         shots(labels, with_network, {urad::hybrid_fill, &hybrid}, kShots);
}

#ifdef URAD_POSES_HEADER
bool table(port::Writer& labels, uint16_t shooter) {
  urad::PoseSource poses = {&kScene, &URAD_POSES_NAME, &g_counters};
  for (uint16_t s = 1; s < kScene.surface_count; ++s) {
    const urad_surface& surface = kScene.surface[s];
    const uint16_t count = surface.patch_count < kLongestRun ? surface.patch_count : kLongestRun;
    measure(labels, "run_table", [&] {
      g_sink = urad::pose_fill(&poses, shooter, s, surface.first_patch, count, g_factors);
    });
  }
  return shots(labels, "shot_table", {urad::pose_fill, &poses}, kShots) &&
         solve(labels, "solve_table", {urad::pose_fill, &poses});
}
#else
bool table(port::Writer&, uint16_t) { return true; }
#endif

#ifdef URAD_LEGACY_HEADER
int32_t g_legacy_memory[urad::legacy_bytes(URAD_LEGACY_MAX_HIDDEN) / 4];

/// One pair by itself: all 24 coordinates weighed.
int32_t legacy_pair(uint16_t shooter, uint16_t receiver) {
  urad_point vertex[2][4];
  for (uint16_t k = 0; k < 4; ++k) {
    vertex[0][k] = urad::patch_vertex(kScene, urad::patch_at(kScene, shooter), k);
    vertex[1][k] = urad::patch_vertex(kScene, urad::patch_at(kScene, receiver), k);
  }
  const urad_legacy_net& net = URAD_LEGACY_NAME;
  for (int h = 0; h < net.hidden; ++h) {
    const int16_t* weight = net.hidden_weight + h * URAD_LEGACY_INPUTS;
    const int bits = net.hidden_shift[h];
    g_legacy_memory[h] = net.hidden_bias[h] + urad::legacy_half_q23(weight, bits, vertex[0]) +
                         urad::legacy_half_q23(weight + URAD_LEGACY_INPUTS / 2, bits, vertex[1]);
  }
  return int32_t(
      urad::legacy_form_factor_uq32(net, urad::legacy_output_uq15(net, g_legacy_memory)));
}

/// The report's own network. Its weights are fixed-point and its first layer is factored: 1996 had
/// neither.
bool legacy(port::Writer& labels, uint16_t shooter) {
  urad::LegacySource source;
  if (urad::legacy_init(&source, &kScene, &URAD_LEGACY_NAME, 0, &g_counters, g_legacy_memory,
                        sizeof g_legacy_memory) != urad::Status::ok)
    return false;
  for (uint16_t s = 1; s < kScene.surface_count; ++s) {
    const urad_surface& surface = kScene.surface[s];
    for (uint16_t k = 0; k < surface.patch_count; ++k)
      measure(labels, "pair_legacy",
              [&] { g_sink = legacy_pair(shooter, uint16_t(surface.first_patch + k)); });
    const uint16_t count = surface.patch_count < kLongestRun ? surface.patch_count : kLongestRun;
    measure(labels, "run_legacy", [&] {
      g_sink = urad::legacy_fill(&source, shooter, s, surface.first_patch, count, g_factors);
    });
  }
  return shots(labels, "shot_legacy", {urad::legacy_fill, &source}, kShots);
}
#else
bool legacy(port::Writer&, uint16_t) { return true; }
#endif

}  // namespace

int run() {
  char path[128];
  if (!port::word(1, path, sizeof path)) return 2;
  const int file = port::open(path, true);
  if (file < 0) return 1;
  port::Writer labels(file);
  const uint16_t shooter = uint16_t(kScene.surface[0].patch_count / 2);

  measure(labels, "empty", [] {});
  for (uint16_t receiver = 0; receiver < kScene.patch_count; ++receiver)
    pairs(labels, shooter, receiver);
  for (uint16_t receiver = 0; receiver < kScene.patch_count; ++receiver)
    sums(labels, shooter, receiver);

  urad::PairSource network = {&kScene, &URAD_NET_NAME, urad::Kernel::moment, 0, 0, &g_counters};
  urad::PairSource kernel = {&kScene, nullptr, urad::Kernel::moment, 0, 0, &g_counters};
  for (uint16_t s = 1; s < kScene.surface_count; ++s) {
    const urad_surface& surface = kScene.surface[s];
    const uint16_t count = surface.patch_count < kLongestRun ? surface.patch_count : kLongestRun;
    measure(labels, "run_network", [&] {
      g_sink = urad::pair_fill(&network, shooter, s, surface.first_patch, count, g_factors);
    });
  }

  const bool good =
      shots(labels, "shot_solver_alone", {even_fill, nullptr}, kShots) &&
      shots(labels, "shot_moment", {urad::pair_fill, &kernel}, kShots) &&
      shots(labels, "shot_network", {urad::pair_fill, &network}, kShots) &&
      solve(labels, "solve_network", {urad::pair_fill, &network}) && table(labels, shooter) &&
      legacy(labels, shooter) &&
      hemicube_shots<32>(labels, "shot_hemicube_32", "shot_hemicube_32_near_network") &&
      hemicube_shots<64>(labels, "shot_hemicube_64", "shot_hemicube_64_near_network");
  labels.flush();
  port::close(file);
  return good && !labels.failed() ? 0 : 1;
}
