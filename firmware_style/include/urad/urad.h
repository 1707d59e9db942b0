/* urad.h -- the C interface of the engine. C99; C++ programs may use it, or the .hpp files.
 *
 * A solve in a few lines (status codes left out):
 *
 *   static uint64_t pairs[16];                                 at least urad_pair_source_bytes()
 *   static uint32_t light[URAD_RADIOSITY_BYTES(294, 49) / 4];  patches, patches a surface
 *   urad_counters counters = {0};
 *   urad_source source;
 *   urad_radiosity state;
 *   urad_pair_source_init(&source, &scene, URAD_KERNEL_MOMENT, &net, 16, &counters, pairs,
 *                         sizeof pairs);                    16 rays a pair; a convex scene asks none
 *   urad_radiosity_init(&state, &scene, &source, URAD_OVERSHOOT, 49, light, sizeof light);
 *   while (!urad_radiosity_done(&state, URAD_PERCENT)) urad_radiosity_step(&state);
 *   urad_radiosity_get(&state, patch, 0, &red);
 *
 * For every function:
 *
 *   Pointers  may be null only where the text says so; null gives URAD_BAD_ARGUMENT, or 0 where no
 *             status is returned. Objects behind pointers to const are not written. "Kept": the
 *             object must outlive the one that keeps a pointer to it.
 *   Failure   any status but URAD_OK: nothing was written, unless the text says otherwise.
 *   Memory    is the caller's, none is allocated. There is no global state: threads may work on
 *             different objects at once.
 *   Data      scenes and nets are trusted once urad_scene_check() and urad_net_check() have passed;
 *             the other functions do not look again.
 *   Formats   are in the names: _uq32 has 32 fraction bits, 4294967296 = 1. No floats.
 */
#ifndef URAD_URAD_H
#define URAD_URAD_H
#include <stddef.h>
#include <stdint.h>

#include "urad/net.h"
#include "urad/pose_table.h"
#include "urad/radiosity.h"
#include "urad/scene.h"
#include "urad/source.h"
#include "urad/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- data ---------------------------------------------------------------------------------- */

/* Walks all tables of a scene: counts, ranges, null pointers, unit normals, materials. URAD_OK, or
 * URAD_BAD_SCENE; a null scene is URAD_BAD_SCENE too. Tables must be as long as the counts say. */
urad_status urad_scene_check(const urad_scene* scene);

/* CRC-32 of a scene that has passed its check: of its fields to crc32[0], of its tables to crc32[1].
 * Exporters write both as urad_NAME_crc32. Null: URAD_BAD_ARGUMENT. */
urad_status urad_scene_crc32(const urad_scene* scene, uint32_t crc32[2]);

/* urad_scene_check() and both CRCs, the fields first, so that no faulty count is followed: finds
 * every single-bit fault. URAD_OK or URAD_BAD_SCENE; null crc32: URAD_BAD_ARGUMENT. */
urad_status urad_scene_verify(const urad_scene* scene, const uint32_t crc32[2]);

/* Checks a net: ABI, sizes, shifts, accumulators that cannot overflow, CRC-32. URAD_OK, or
 * URAD_BAD_NET; a null net is URAD_BAD_NET too. */
urad_status urad_net_check(const urad_net* net);

/* Checks a pose table against the scene it was made for: that no factor lies outside its values.
 * URAD_OK, URAD_BAD_SCENE, or URAD_BAD_ARGUMENT for null. */
urad_status urad_pose_table_check(const urad_pose_table* table, const urad_scene* scene);

/* ---- geometry ------------------------------------------------------------------------------ */

/* A grid of count_u x count_v patches: patch (u, v) has its corner at origin + u step_u + v step_v
 * and its lit side along step_u x step_v. For geometry that is made or moved on the chip; exporters
 * write grids themselves.
 *   grid  written on success
 * Failure: URAD_BAD_ARGUMENT when a count is 0, the steps are parallel, or a corner leaves
 * URAD_COORDINATE_MAX. */
urad_status urad_grid_make(urad_point origin, urad_point step_u, urad_point step_v,
                           uint16_t count_u, uint16_t count_v, urad_grid* grid);

/* ---- form factors -------------------------------------------------------------------------- */

enum { URAD_KERNEL_CENTRE = 0, URAD_KERNEL_MOMENT = 1 };
#define URAD_RAYS_MAX 1024

/* Form factor F from patch `from` to patch `to`, as a pair source gives it to a solver.
 *   from, to  below scene->patch_count; from = to gives 0
 *   kernel    URAD_KERNEL_*
 *   net       may be null: the kernel alone
 *   rays      visibility rays, 0 .. URAD_RAYS_MAX; 0: blockers are ignored. None if convex.
 *   f_uq32    one value, UQ0.32, saturating at 2^32 - 1; written on success
 *   counters  may be null; else counts are added to it
 * Failure: URAD_BAD_ARGUMENT, URAD_BAD_NET (not of the inputs of a pair). */
urad_status urad_form_factor(const urad_scene* scene, uint16_t from, uint16_t to, unsigned kernel,
                             const urad_net* net, uint16_t rays, uint32_t* f_uq32,
                             urad_counters* counters);

/* ---- sources: where a solver gets its factors from ------------------------------------------ */
/* Each init function lays an object out in `memory` and writes a urad_source that works on it.
 *   memory   aligned like a uint64_t, `bytes` long, at least the matching *_bytes()
 *   kept     memory, scene, net, counters, and what they point to
 * Failure: URAD_BAD_ARGUMENT, URAD_BAD_NET (not of the inputs of a pair), URAD_OUT_OF_MEMORY (too
 * few bytes, or misaligned). */

size_t urad_pair_source_bytes(void);

/* Kernel or network for every pair, as urad_form_factor(). net may be null; counters may not. */
urad_status urad_pair_source_init(urad_source* source, const urad_scene* scene, unsigned kernel,
                                  const urad_net* net, uint16_t rays, urad_counters* counters,
                                  void* memory, size_t bytes);

/* Rays by the worth of a pair, for a source from urad_pair_source_init() or urad_auto_source_init():
 * as many as were asked for where F is above f_uq32, half of them at a quarter of it, and so on, 4 at
 * least. At first every pair gets them all. docs/SKIPPING.md says what 64 rays by a worth of 1/64 save.
 *   f_uq32  UQ0.32, 2^26 is 1/64; 0: all rays for every pair
 *   cuts    0 .. 6: cuts of patches into four where rays disagree
 * Failure: URAD_BAD_ARGUMENT (another source, too many cuts). */
urad_status urad_pair_source_worth(const urad_source* source, uint32_t f_uq32, unsigned cuts);

size_t urad_pose_source_bytes(void);

/* A load per pair from a table made on the host, which holds visibility and repair. Kept: table,
 * too. */
urad_status urad_pose_source_init(urad_source* source, const urad_scene* scene,
                                  const urad_pose_table* table, urad_counters* counters,
                                  void* memory, size_t bytes);

/* Delta form factors of a quadrant of the top and of half a side, UQ0.32, [R/2 * R/2] each;
 * R = resolution, even, 16 .. 128. The exporter writes them as arrays. */
typedef struct urad_hemicube_table {
  uint16_t resolution;
  const uint32_t* top;
  const uint32_t* side;
} urad_hemicube_table;

enum {
  URAD_HEMICUBE_TURNED = 1,   /* turned by an angle that differs by patch: half the aliasing */
  URAD_HEMICUBE_COVERAGE = 2, /* keep what each patch would cover alone, for a hybrid source */
  URAD_HEMICUBE_FOUR_EYES = 8 /* the mean of half cubes on the middles of the patch's four quarters:
                                 four times the work; for a hybrid source, whose visible fractions
                                 one centre gets wrong behind louvres and under tables */
};

/* Bytes for a hemicube source on this scene. rows: height of a band of the item buffer, 1 ..
 * resolution; 0: none (convex scenes only). flags: URAD_HEMICUBE_*. 0 if scene is null. */
size_t urad_hemicube_source_bytes(const urad_scene* scene, uint16_t resolution, uint16_t rows,
                                  unsigned flags);

/* A hemicube on the centre of the shooter, rendered when a new shooter is asked for.
 *   table  copied; its two arrays are kept
 *   rows   height of a band of the item buffer, 1 .. resolution, the same bits for all;
 *          0: none, for convex scenes only
 *   flags  URAD_HEMICUBE_* */
urad_status urad_hemicube_source_init(urad_source* source, const urad_scene* scene,
                                      const urad_hemicube_table* table, uint16_t rows,
                                      unsigned flags, urad_counters* counters, void* memory,
                                      size_t bytes);

size_t urad_hybrid_source_bytes(void);

/* Visibility from a hemicube source, magnitude from kernel or network.
 *   hemicube       from urad_hemicube_source_init(), with URAD_HEMICUBE_COVERAGE unless convex.
 *                  The hybrid uses its memory from now on; the urad_source is not kept.
 *   net            may be null: the kernel alone
 *   rays           1 .. URAD_RAYS_MAX, for receivers that cover no cell
 *   near_rho_uq16  0: all pairs. Else only pairs whose (tr M_i + tr M_j) / R^2 is above it; 2427 is
 *                  three patches from centre to centre, for equal squares. */
urad_status urad_hybrid_source_init(urad_source* source, const urad_source* hemicube,
                                    unsigned kernel, const urad_net* net, uint16_t rays,
                                    uint32_t near_rho_uq16, void* memory, size_t bytes);

/* ---- radiosity: progressive refinement ----------------------------------------------------- */

#define URAD_PERCENT 42949673u /* 1 % as UQ0.32, for urad_radiosity_done() */

/* Patches of the largest surface; 0 if scene is null. */
uint16_t urad_longest_run(const urad_scene* scene);

/* Starts a solve.
 *   state   written on success; plain data, may be copied while memory stays where it is
 *   scene   kept
 *   source  copied; its context is kept. Any function that fills runs will do.
 *   flags   URAD_OVERSHOOT and URAD_SKIP_OFF_*
 *   run     1 .. 65535 factors asked for at a time. Fewer than urad_longest_run() cost calls, not
 *           accuracy: the light has the same bits.
 *   memory  4-byte aligned, bytes >= URAD_RADIOSITY_BYTES(scene->patch_count, run); kept
 * Failure: URAD_BAD_ARGUMENT, URAD_BAD_SCENE (no patch), URAD_OUT_OF_MEMORY (too few bytes, or
 * misaligned), URAD_OVERFLOW (a patch that emits URAD_POWER_LIMIT or more). */
urad_status urad_radiosity_init(urad_radiosity* state, const urad_scene* scene,
                                const urad_source* source, unsigned flags, uint16_t run,
                                void* memory, size_t bytes);

/* One shot, from the patch with the largest unshot power. With nothing unshot: URAD_OK and nothing
 * done. Null: URAD_BAD_ARGUMENT. After any other failure the state is whole and its ledger holds:
 *   of the source  what was handed out before stays; step may be called again, B keeps the error
 *   URAD_OVERFLOW  a patch has reached URAD_POWER_LIMIT; nothing wrapped; the status stays
 *   URAD_DIVERGES  over patch_count shots (with URAD_OVERSHOOT over 64 at least, four times in a
 *                  row) the unshot power fell by less than 1/4096; the status stays */
urad_status urad_radiosity_step(urad_radiosity* state);

/* 1 when the estimated relative error of B is at most error_uq32 (URAD_PERCENT), or the solve has
 * stopped with a status, or state is null: a loop `while (!done) step` always ends. Else 0. */
int urad_radiosity_done(const urad_radiosity* state, uint32_t error_uq32);

/* Steps until done at error_uq32 or `budget` shots are made: what a renderer calls once a frame.
 * shots: may be null; else how many were made. Failure: as urad_radiosity_step(). */
urad_status urad_radiosity_steps(urad_radiosity* state, uint32_t budget, uint32_t error_uq32,
                                 uint32_t* shots);

/* The estimate: what is still to be reflected over all that will be, UQ0.32. 0 if state is null. */
uint32_t urad_radiosity_error_uq32(const urad_radiosity* state);

/* Radiosity B of a patch in channel 0 .. 2, in the scene's exitance unit, saturating, to *exitance.
 * URAD_BAD_ARGUMENT: patch or channel out of range. */
urad_status urad_radiosity_get(const urad_radiosity* state, uint16_t patch, unsigned channel,
                               int32_t* exitance);

/* The same plus reflectance times the ambient term: for pictures before the solve is done. */
urad_status urad_radiosity_display(const urad_radiosity* state, uint16_t patch, unsigned channel,
                                   int32_t* exitance);

/* 1 when emitted = absorbed + unshot + escaped in every channel, with unshot summed again from the
 * patches; else 0, also for a null state. ledger: may be null; else written. */
int urad_radiosity_audit(const urad_radiosity* state, urad_ledger* ledger);

/* ---- light that changes -------------------------------------------------------------------- */
/* Moved lights, switched lamps and painted walls: the difference becomes unshot power of either
 * sign [Chen 1990], and the steps that follow lead from the present light to that of a solve from
 * the start, within the error asked for. At 30 frames a second: change what has changed, then
 * urad_radiosity_steps(&state, shots_a_frame, URAD_PERCENT, 0), then urad_radiosity_display() of
 * what is drawn: the picture follows within a few frames and is never worse than the last.
 * 40 % of 48 million instructions a second are room for 20 shots a frame of 294 patches by a table
 * on a Cortex-M0; a lamp that moves by a patch is back to 2 % after 5 frames, 7 next to a wall.
 * Geometry that moves: urad/move.h. */

/* Keeps what every patch emits in `memory`, from the scene's materials: call it before they change.
 *   memory  4-byte aligned, bytes >= URAD_RELIGHT_BYTES(scene->patch_count); kept
 * Failure: URAD_BAD_ARGUMENT, URAD_OUT_OF_MEMORY (too few bytes, or misaligned). */
urad_status urad_radiosity_relight_init(urad_radiosity* state, void* memory, size_t bytes);

/* Patch `patch` emits exitance[3] from now on.
 *   exitance  0 .. 2^30 each, the scene's unit
 * Failure: URAD_BAD_ARGUMENT (out of range; no urad_radiosity_relight_init() before), URAD_OVERFLOW
 * (a power would reach URAD_POWER_LIMIT). */
urad_status urad_radiosity_set_emission(urad_radiosity* state, uint16_t patch,
                                        const int32_t* exitance);

/* One material of the scene gets another reflectance; the scene's `material` must be in RAM.
 *   material          an element of the scene's table; written on success
 *   reflectance_uq15  [3], 32768 = 1
 * A wall that was black costs a row of factors a patch: the light that met it is gathered.
 * Failure: URAD_BAD_ARGUMENT, URAD_OVERFLOW, a status of the source. Nothing is then changed. */
urad_status urad_radiosity_set_reflectance(urad_radiosity* state, urad_material* material,
                                           const uint16_t* reflectance_uq15);

/* Lights whose colours change need no shots: B is the sum of what each makes alone, times its
 * colour, each product rounded.
 *   lights     0 .. 32767, whose sum cannot leave 32 bits
 *   radiosity  [patches][3], written
 * Failure: URAD_BAD_ARGUMENT (a null pointer, too many lights). */
urad_status urad_light_mix(const urad_light* light, uint16_t lights, uint16_t patches,
                           uint32_t* radiosity);

#ifdef __cplusplus
}
#endif
#endif
