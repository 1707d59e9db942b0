/* urad/move.h -- geometry that moves during a solve, in C: only what it touches is made again. */
#ifndef URAD_MOVE_H
#define URAD_MOVE_H

#include "urad/urad.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct urad_box {
  urad_point low, high; /* scene units */
} urad_box;

/* What moves. Pairs are touched when one end is among the patches, or when something that may pass
 * between the two lies in a box. */
typedef struct urad_move {
  uint16_t first_patch, patch_count; /* patches that move or change shape, one after the other */
  uint16_t box_count;                /* 0 .. 2; 0: nothing that moves can stand between others */
  uint16_t reserved;                 /* 0 */
  urad_box box[2];                   /* around moved blockers: where they are, and where they go */
  uint32_t made; /* written: pairs whose factors were made, each once; both calls add up */
  uint32_t kept; /* written: pairs that were left alone. made + kept = 2 n (n-1)/2 in the end */
} urad_move;

/* Before geometry changes: takes away the light that went between touched patches. Then change the
 * scene, or have another one ready, and call urad_radiosity_move_end(): together they leave the
 * unshot power, of either sign, that leads to the light of a solve from the start [Chen 1990]. No
 * memory is needed beside that of the solve. Factors are taken as reciprocal and not small ones left
 * out: sources of pairs are, a hemicube's rows leave their error in what is touched.
 *   move  patches and boxes; counters are set to 0
 * Until the end, steps are refused, urad_radiosity_done() says 1, and light is shown without what
 * went between touched patches.
 * Failure: URAD_BAD_ARGUMENT (patches or boxes out of range, already begun, exported visibility):
 * nothing was written. A status of the source, or URAD_OVERFLOW: the ledger holds, the status stays;
 * a solve from the start would do. */
urad_status urad_radiosity_move_begin(urad_radiosity* state, urad_move* move);

/* After it has changed: gives touched patches the light that goes between them now.
 *   move    as at the beginning
 *   scene   may be null: the same, changed in place. Else kept: another one with as many patches in
 *           the same order and the same materials, such as a door's next place in flash.
 *   source  may be null: the same. Else copied: that of the other scene.
 * Patches keep their powers. Where the area of a patch has changed, urad_radiosity_set_emission()
 * gives a lamp its exitance back.
 * Failure: as above; URAD_BAD_ARGUMENT also when nothing was begun. */
urad_status urad_radiosity_move_end(urad_radiosity* state, urad_move* move, const urad_scene* scene,
                                    const urad_source* source);

/* Makes *blocker the outline of a grid, such as urad_grid_make() has moved.
 *   blocker  in RAM; first_vertex and surface stay as they are
 *   vertex   the scene's list in RAM; four of it are written, from blocker->first_vertex on
 * Failure: URAD_BAD_ARGUMENT for null. */
urad_status urad_blocker_make(const urad_grid* grid, urad_point* vertex, urad_blocker* blocker);

/* Fits the boxes of a hierarchy around blockers that have moved.
 *   bounds   [count], in RAM; its order stays
 *   blocker  the scene's list
 * Failure: URAD_BAD_ARGUMENT for null. */
urad_status urad_bounds_fit(urad_bounds* bounds, uint16_t count, const urad_blocker* blocker);

#ifdef __cplusplus
}
#endif
#endif
