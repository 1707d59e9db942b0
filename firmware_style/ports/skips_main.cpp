// skips LABELS [SETTING] -- rows of factors with all skips, with each one off and with all off, between
// region marks, for the instruction counter of bench/icount; or with all on and SETTING alone. Rows of
// shooters spread evenly over the scene.
#include URAD_SCENE_HEADER
#include URAD_NET_HEADER
#include "port.hpp"
#include "regions.hpp"
#include "text.hpp"
#include "urad/form_factor.hpp"
#include "urad/radiosity.hpp"

namespace {

const urad_scene& kScene = URAD_SCENE_NAME;

constexpr uint16_t kLongestRun = 64;
constexpr uint16_t kRays = 16, kManyRays = 64;
constexpr uint32_t kRows = 6;
constexpr int kShots = 6;

uint32_t g_memory[urad::radiosity_bytes(URAD_PATCHES_MAX, kLongestRun) / 4];
uint32_t g_factors[kLongestRun];
urad_counters g_counters;
urad::Radiosity g_radiosity;

bool row(urad::PairSource* pairs, uint16_t shooter) {
  bool good = true;
  for (uint16_t s = 0; s < kScene.surface_count; ++s) {
    const urad_surface& surface = kScene.surface[s];
    const uint32_t end = uint32_t{surface.first_patch} + surface.patch_count;
    for (uint32_t first = surface.first_patch, count; first < end; first += count) {
      count = end - first < kLongestRun ? end - first : kLongestRun;
      good = good && urad::pair_fill(pairs, shooter, s, uint16_t(first), uint16_t(count),
                                     g_factors) == URAD_OK;
    }
  }
  return good;
}

struct Setting {
  const char* label;
  uint32_t skips_off;
  uint32_t bound_uq32;
  uint16_t rays = kRays;
  uint32_t error_uq32 = 0;
};

constexpr uint32_t kBeforeRays = urad::skip_off_far | urad::skip_off_facing | urad::skip_off_same |
                                 urad::skip_off_behind | urad::skip_off_convex |
                                 urad::skip_off_blockers;
constexpr uint32_t kAll = kBeforeRays | urad::skip_off_unseen | urad::skip_off_order;
constexpr Setting kSettings[] = {{"on", 0, 0},
                                 {"same", urad::skip_off_same, 0},
                                 {"behind", urad::skip_off_behind, 0},
                                 {"facing", urad::skip_off_facing, 0},
                                 {"far", urad::skip_off_far, 0},
                                 {"convex", urad::skip_off_convex, 0},
                                 {"blockers", urad::skip_off_blockers, 0},
                                 {"unseen", urad::skip_off_unseen, 0},
                                 {"order", urad::skip_off_order, 0},
                                 {"before_rays", kBeforeRays, 0},
                                 {"all", kAll, 0},
                                 {"bounded", 0, 1u << 26},
                                 {"on_64", 0, 0, kManyRays},
                                 {"all_64", kAll, 0, kManyRays},
                                 {"worth_64", 0, 0, kManyRays, 1u << 26}};

/// Factors whose runs are at times dark, at no cost.
urad_status even_fill(void*, uint16_t, uint16_t surface, uint16_t, uint16_t count,
                      uint32_t* f_uq32) {
  for (uint16_t k = 0; k < count; ++k) f_uq32[k] = surface % 3 ? 1u << 23 : 0;
  return URAD_OK;
}

/// Nothing where the light of the scene does not fit beside the program.
bool shots(port::Writer& labels, const char* label, unsigned flags) {
  if (kScene.patch_count > URAD_PATCHES_MAX) return true;
  bool good = urad::radiosity_init(&g_radiosity, &kScene, {even_fill, nullptr}, flags, kLongestRun,
                                   g_memory, sizeof g_memory) == urad::Status::ok;
  for (int k = 0; good && k < kShots; ++k) {
    URAD_REGION_BEGIN();
    good = urad::radiosity_step(&g_radiosity) == urad::Status::ok;
    URAD_REGION_END();
    labels.text(label).text("\n");
  }
  return good;
}

/// Lights that change colour: one, then two. Any numbers will do for a basis.
void lights(port::Writer& labels) {
  if (kScene.patch_count > URAD_PATCHES_MAX) return;
  const auto* const basis = reinterpret_cast<const uint16_t*>(g_memory + 3 * kScene.patch_count);
  const urad_light light[2] = {{basis, {32768, 16384, 8192}}, {basis, {8192, 16384, 32768}}};
  for (uint16_t count = 1; count <= 2; ++count) {
    URAD_REGION_BEGIN();
    urad::light_mix(light, count, kScene.patch_count, g_memory);
    URAD_REGION_END();
    labels.text(count == 1 ? "light_1\n" : "light_2\n");
  }
}

bool same_word(const char* a, const char* b) {
  while (*a && *a == *b) ++a, ++b;
  return *a == *b;
}

}  // namespace

int run() {
  char path[128], only[16];
  if (!port::word(1, path, sizeof path)) return 2;
  const bool one = port::word(2, only, sizeof only);
  const int file = port::open(path, true);
  if (file < 0) return 1;
  port::Writer labels(file);
  bool good = true;
  for (const Setting& setting : kSettings) {
    if (one && &setting != kSettings && !same_word(setting.label, only)) continue;
    urad::PairSource pairs = {&kScene, &URAD_NET_NAME,    urad::Kernel::moment,
                              kRays,   setting.skips_off, &g_counters};
    pairs.rays = setting.rays;
    pairs.bound_uq32 = setting.bound_uq32;
    pairs.error_uq32 = setting.error_uq32;
    for (uint32_t k = 0; k < kRows; ++k) {
      const auto shooter = uint16_t(((2 * k + 1) * kScene.patch_count) / (2 * kRows));
      URAD_REGION_BEGIN();
      good = row(&pairs, shooter) && good;
      URAD_REGION_END();
      labels.text(setting.label).text("\n");
    }
  }
  if (!one) {
    good =
        shots(labels, "solver_on", URAD_OVERSHOOT) &&
        shots(labels, "solver_all",
              URAD_OVERSHOOT | URAD_SKIP_OFF_CHANNEL | URAD_SKIP_OFF_BLACK | URAD_SKIP_OFF_DARK) &&
        good;
    lights(labels);
  }
  labels.flush();
  port::close(file);
  return good && !labels.failed() ? 0 : 1;
}
