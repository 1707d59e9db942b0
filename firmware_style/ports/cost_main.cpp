// cost LABELS [solves] -- rows of factors by every method and a whole solve between region marks, with what the engine counted
// meanwhile: what the constants of `urad plan` are fitted to, and what it is tested on.
//
// LABELS receives one line per region:
//   row METHOD PATCH runs COUNTERS...    all runs of one shooter; counters in the order of urad_counters
//   init PATCHES                         radiosity_init
//   solver SHOTS UPDATES                 a piece of a solve between two calls of its source; the numbers are those at its
//                                        end, so that the last line holds the whole
//   bytes WHAT BYTES                     an empty region: what an object takes on this chip
// With the word `solves`, whole solves by each method instead:
//   solve METHOD SHOTS                   init to 1 % by the engine's estimate
#include URAD_SCENE_HEADER
#include URAD_NET_HEADER
#ifdef URAD_POSES_HEADER
#include URAD_POSES_HEADER
#endif
#include "port.hpp"
#include "regions.hpp"
#include "text.hpp"
#include "urad/form_factor.hpp"
#include "urad/hemicube_table.hpp"
#include "urad/hybrid.hpp"
#include "urad/pose_table.hpp"
#include "urad/radiosity.hpp"

namespace {

const urad_scene& kScene = URAD_SCENE_NAME;

constexpr uint16_t kPatches = 2048;
constexpr uint16_t kRows = 16;  // shooters whose rows are counted
constexpr uint16_t kRays = 64;  // as `urad solve`
constexpr int kMostResolution = 64;
template <int R>
constexpr urad::HemicubeCells<R> kCells = urad::make_hemicube_table<R>();

uint32_t g_memory[urad::radiosity_bytes(kPatches, kPatches) / 4];
uint32_t g_row[kPatches];
uint32_t
    g_hemicube_memory[urad::hemicube_bytes(kMostResolution, kMostResolution, kPatches, true) / 4];
urad_counters g_counters;
urad::Radiosity g_radiosity;

struct Output {
  port::Writer writer;
  urad_source source;  // of a solve: pieces end where it is called
  bool solves;

  void row(const char* method, const urad_source& from) {
    const uint16_t step =
        kScene.patch_count > kRows ? uint16_t(kScene.patch_count / kRows) : uint16_t{1};
    for (uint16_t patch = 0; patch < kScene.patch_count; patch = uint16_t(patch + step)) {
      g_counters = {};
      URAD_REGION_BEGIN();
      for (uint16_t s = 0; s < kScene.surface_count; ++s) {
        const urad_surface& to = kScene.surface[s];
        from.fill(from.context, patch, s, to.first_patch, to.patch_count, g_row);
      }
      URAD_REGION_END();
      writer.text("row ").text(method).text(" ").integer(patch).text(" ").integer(
          kScene.surface_count);
      const uint32_t* counter = &g_counters.evaluated;
      for (size_t k = 0; k < sizeof g_counters / sizeof *counter; ++k)
        writer.text(" ").integer(counter[k]);
      writer.text("\n");
    }
  }

  void piece() {
    writer.text("solver ")
        .integer(g_radiosity.counters.shots)
        .text(" ")
        .integer(g_radiosity.counters.updates)
        .text("\n");
  }

  void bytes(const char* what, size_t count) {
    URAD_REGION_BEGIN();
    URAD_REGION_END();
    writer.text("bytes ").text(what).text(" ").integer(int64_t(count)).text("\n");
  }
};

/// init to 1 %.
bool whole_solve(Output* output, const char* method, const urad_source& source) {
  URAD_REGION_BEGIN();
  bool good =
      urad::radiosity_init(&g_radiosity, &kScene, source, URAD_OVERSHOOT, urad::longest_run(kScene),
                           g_memory, sizeof g_memory) == urad::Status::ok;
  while (good && !urad::radiosity_done(g_radiosity, 42949673))
    good = urad::radiosity_step(&g_radiosity) == urad::Status::ok;
  URAD_REGION_END();
  output->writer.text("solve ")
      .text(method)
      .text(" ")
      .integer(g_radiosity.counters.shots)
      .text("\n");
  return good;
}

/// Ends a piece before the source is asked, begins the next when it has answered.
urad_status interrupted_fill(void* context, uint16_t shooter, uint16_t surface, uint16_t first,
                             uint16_t count, uint32_t* f_uq32) {
  URAD_REGION_END();
  auto* const output = static_cast<Output*>(context);
  output->piece();
  const urad_status status =
      output->source.fill(output->source.context, shooter, surface, first, count, f_uq32);
  URAD_REGION_BEGIN();
  return status;
}

bool solve(Output* output) {
  const urad_source source = {interrupted_fill, output};
  URAD_REGION_BEGIN();
  bool good =
      urad::radiosity_init(&g_radiosity, &kScene, source, URAD_OVERSHOOT, urad::longest_run(kScene),
                           g_memory, sizeof g_memory) == urad::Status::ok;
  URAD_REGION_END();
  output->writer.text("init ").integer(kScene.patch_count).text("\n");
  URAD_REGION_BEGIN();
  while (good && !urad::radiosity_done(g_radiosity, 42949673))  // 1 %
    good = urad::radiosity_step(&g_radiosity) == urad::Status::ok;
  URAD_REGION_END();
  output->piece();
  return good;
}

constexpr uint16_t kBand = 8;

/// A row or a whole solve.
bool measure(Output* output, const char* method, const urad_source& source) {
  if (output->solves) return whole_solve(output, method, source);
  output->row(method, source);
  return true;
}

/// As `urad solve` asks for them: a hybrid in an occluded scene keeps coverage and looks from four eyes.
template <int R>
bool hemicube(Output* output, const char* alone, const char* banded, const char* hybrid_name) {
  const bool convex = kScene.flags & URAD_SCENE_CONVEX;
  const auto rows = uint16_t(convex ? 0 : R);
  urad::HemicubeSource cube;
  const auto init = [&](uint16_t band, int flags) {
    return urad::hemicube_init(&cube, &kScene, urad::hemicube_table(kCells<R>), band,
                               uint8_t(urad::hemicube_turned | flags), g_hemicube_memory,
                               sizeof g_hemicube_memory, &g_counters) == urad::Status::ok;
  };
  const urad_source by_cube = {urad::hemicube_fill, &cube};
  if (!init(rows, 0) || !measure(output, alone, by_cube)) return false;
  if (!convex && (!init(kBand, 0) || !measure(output, banded, by_cube))) return false;
  urad::HybridSource hybrid;
  return init(rows, convex ? 0 : urad::hemicube_coverage | urad::hemicube_four_eyes) &&
         urad::hybrid_init(&hybrid, &cube, urad::Kernel::moment, &URAD_NET_NAME, kRays,
                           convex ? urad::kThreePatches_uq16 : 0) == urad::Status::ok &&
         measure(output, hybrid_name, {urad::hybrid_fill, &hybrid});
}

}  // namespace

int run() {
  char path[128];
  if (!port::word(1, path, sizeof path)) return 2;
  const int file = port::open(path, true);
  if (file < 0 || kScene.patch_count > kPatches) return 1;
  Output output{port::Writer(file), {}, port::word(2, path, sizeof path)};

  output.bytes("state", sizeof(urad::Radiosity));
  output.bytes("counters", sizeof(urad_counters));
  output.bytes("pair_source", sizeof(urad::PairSource));
  output.bytes("pose_source", sizeof(urad::PoseSource));
  output.bytes("hemicube_source", sizeof(urad::HemicubeSource));
  output.bytes("hybrid_source", sizeof(urad::HybridSource));

  urad::PairSource pairs = {&kScene, nullptr, urad::Kernel::moment, kRays, 0, &g_counters};
  const urad_source by_pairs = {urad::pair_fill, &pairs};
  bool good = measure(&output, "moment", by_pairs);
  pairs.net = &URAD_NET_NAME;
  good = good && measure(&output, "net", by_pairs);
  pairs.points = 1;
  good = good && measure(&output, "lambert1", by_pairs);
  pairs.points = 2;
  good = good && measure(&output, "lambert2", by_pairs);
  pairs.points = 0;
  output.source = by_pairs;
#ifdef URAD_POSES_HEADER
  urad::PoseSource poses = {&kScene, &URAD_POSES_NAME, &g_counters};
  output.source = {urad::pose_fill, &poses};
  good = good && measure(&output, "table", output.source);
#endif
  good = good && (output.solves || solve(&output)) &&
         hemicube<32>(&output, "hemicube32", "hemicube32_bands", "hybrid32") &&
         hemicube<64>(&output, "hemicube64", "hemicube64_bands", "hybrid64");
  output.writer.flush();
  port::close(file);
  return good && !output.writer.failed() ? 0 : 1;
}
