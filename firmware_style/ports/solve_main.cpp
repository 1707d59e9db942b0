// solve IN OUT [table|legacy] -- radiosity of one exported scene by its network; every integer of the result goes to OUT.
// With the word `table`: by its pose table; with `legacy`: by a network of the 1996 report. The image must have been built
// with them (URAD_POSES, URAD_LEGACY).
//
// IN is a text of integers, read at run time: the error at which to stop (UQ0.32), the largest number of shots, then
// for each material in turn its reflectance (three, UQ1.15) and exitance (three). Materials that are left out stay as
// exported; "-" instead of a file leaves all of them so, and asks for 1 % within 10,000 shots.
// OUT: the materials used and, for each patch, radiosity, shot and unshot power in red, green and blue.
// The same source runs on boards and on the host: the two OUT files must be equal, byte for byte.
#include URAD_SCENE_HEADER
#include URAD_NET_HEADER
#ifdef URAD_POSES_HEADER
#include URAD_POSES_HEADER
#endif
#ifdef URAD_LEGACY_HEADER
#include URAD_LEGACY_HEADER
#endif
#include "port.hpp"
#include "text.hpp"
#include "urad/form_factor.hpp"
#include "urad/legacy.hpp"
#include "urad/network.hpp"
#include "urad/pose_table.hpp"
#include "urad/radiosity.hpp"
#include "urad/urad.h"

namespace {

constexpr uint16_t kPatches = URAD_PATCHES_MAX;
constexpr uint16_t kLongestRun = 64;
constexpr uint16_t kMaterials = 16;

uint32_t g_memory[urad::radiosity_bytes(kPatches, kLongestRun) / 4];
urad_material g_material[kMaterials];
urad_scene g_scene;
urad_counters g_counters;
urad::Radiosity g_radiosity;

#ifdef URAD_POSES_HEADER
const urad_pose_table* const kPoses = &URAD_POSES_NAME;
#else
const urad_pose_table* const kPoses = nullptr;
#endif
#ifdef URAD_LEGACY_HEADER
const urad_legacy_net* const kLegacy = &URAD_LEGACY_NAME;
int32_t g_legacy_memory[urad::legacy_bytes(URAD_LEGACY_MAX_HIDDEN) / 4];
#else
const urad_legacy_net* const kLegacy = nullptr;
int32_t g_legacy_memory[1];
#endif

struct Limits {
  int32_t error_uq32 = URAD_PERCENT;
  int32_t shots = 10000;
};

int fail(const char* why) {
  port::print("solve: ");
  port::print(why);
  port::print("\n");
  return 1;
}

bool read_input(const char* path, Limits* limits) {
  if (path[0] == '-' && !path[1]) return true;
  const int file = port::open(path, false);
  if (file < 0) return false;
  port::Reader in(file);
  bool good = in.integer(&limits->error_uq32) && in.integer(&limits->shots);
  for (uint16_t m = 0; good && m < g_scene.material_count; ++m) {
    int32_t value[6];
    if (!in.integer(&value[0])) break;
    for (int k = 1; k < 6; ++k) good = good && in.integer(&value[k]);
    for (int k = 0; good && k < 3; ++k) {
      good = value[k] >= 0 && value[k] <= 32768;
      g_material[m].reflectance_uq15[k] = uint16_t(value[k]);
      g_material[m].exitance[k] = value[3 + k];
    }
  }
  port::close(file);
  return good;
}

bool write_result(const char* path) {
  const int file = port::open(path, true);
  if (file < 0) return false;
  port::Writer out(file);
  for (uint16_t m = 0; m < g_scene.material_count; ++m) {
    out.text("material ").integer(m);
    for (const uint16_t reflectance : g_material[m].reflectance_uq15) out.text(" ").integer(reflectance);
    for (const int32_t exitance : g_material[m].exitance) out.text(" ").integer(exitance);
    out.text("\n");
  }
  for (uint16_t patch = 0; patch < g_scene.patch_count; ++patch) {
    out.text("patch ").integer(patch);
    for (int c = 0; c < 3; ++c) out.text(" ").integer(urad::radiosity_get(g_radiosity, patch, c));
    for (int c = 0; c < 3; ++c) out.text(" ").integer(g_radiosity.shot[3 * patch + c]);
    for (int c = 0; c < 3; ++c) out.text(" ").integer(g_radiosity.unshot[3 * patch + c]);
    out.text("\n");
  }
  out.flush();
  port::close(file);
  return !out.failed();
}

void report(int32_t steps) {
  const port::Memory memory = port::memory();
  const int terminal = port::open(":tt", true);
  if (terminal < 0) return;
  port::Writer out(terminal);
  out.text("patches ").integer(g_scene.patch_count);
  out.text("  shots ").integer(steps);
  out.text("  error_uq32 ").integer(urad::radiosity_error_uq32(g_radiosity));
  out.text("  pairs ").integer(g_counters.evaluated);
  out.text("  static ").integer(memory.static_bytes);
  out.text("  stack ").integer(memory.stack_bytes);
  out.text("  untouched ").integer(memory.free_bytes).text("\n");
  out.flush();
  port::close(terminal);
}

}  // namespace

int run() {
  char path[128];
  Limits limits;
  g_scene = URAD_SCENE_NAME;
  if (g_scene.patch_count > kPatches || g_scene.material_count > kMaterials)
    return fail("the scene has more patches or materials than this image was built for");
  for (uint16_t m = 0; m < g_scene.material_count; ++m) g_material[m] = URAD_SCENE_NAME.material[m];
  g_scene.material = g_material;

  if (!port::word(1, path, sizeof path) || !read_input(path, &limits))
    return fail("first word must be a file of integers, or -");
  if (urad::scene_check(&g_scene) != urad::Status::ok) return fail("bad scene");
  if (urad::network_check(&URAD_NET_NAME) != urad::Status::ok) return fail("bad network");

  const uint16_t rays = g_scene.flags & URAD_SCENE_CONVEX ? 0 : 16;
  urad::PairSource pairs = {&g_scene, &URAD_NET_NAME, urad::Kernel::moment, rays, 0, &g_counters};
  urad::PoseSource poses = {&g_scene, kPoses, &g_counters};
  urad_source source = {urad::pair_fill, &pairs};
  urad::LegacySource legacy;
  if (port::word(3, path, sizeof path)) {
    if (path[0] == 't') {
      if (urad::pose_table_check(kPoses, &g_scene) != urad::Status::ok) return fail("no pose table, or not of this scene");
      source = {urad::pose_fill, &poses};
    } else if (path[0] == 'l') {
      if (urad::legacy_init(&legacy, &g_scene, kLegacy, rays, &g_counters, g_legacy_memory, sizeof g_legacy_memory) != urad::Status::ok)
        return fail("no network of the report, or a scene of other patches than quads");
      source = {urad::legacy_fill, &legacy};
    } else {
      return fail("third word must be table, legacy or none");
    }
  }
  const uint16_t longest = urad::longest_run(g_scene);
  if (urad::radiosity_init(&g_radiosity, &g_scene, source, URAD_OVERSHOOT, longest < kLongestRun ? longest : kLongestRun, g_memory,
                           sizeof g_memory) != urad::Status::ok)
    return fail("radiosity_init refused");
  int32_t steps = 0;
  for (; steps < limits.shots && !urad::radiosity_done(g_radiosity, uint32_t(limits.error_uq32)); ++steps)
    if (urad::radiosity_step(&g_radiosity) != urad::Status::ok) return fail("radiosity_step failed");
  if (!urad::radiosity_audit(g_radiosity, nullptr)) return fail("the energy ledger does not balance");

  if (!port::word(2, path, sizeof path) || !write_result(path))
    return fail("second word must be a file that can be written");
  report(steps);
  return 0;
}
