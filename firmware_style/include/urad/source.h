/* source.h -- where a solver gets its form factors from: a function that fills runs. C99 and C++17. */
#ifndef URAD_SOURCE_H
#define URAD_SOURCE_H
#include <stdint.h>

#include "urad/scene.h"
#include "urad/status.h"

/* What was done and what was left out, in ordered pairs unless said otherwise. Wraps at 2^32.
 * evaluated + skipped_same + skipped_facing + skipped_small = all pairs asked for, but the shooter
 * with itself. */
typedef struct urad_counters {
  uint32_t evaluated;           /* pairs whose factor was computed (or loaded) */
  uint32_t skipped_same;        /* another patch of the same planar surface */
  uint32_t skipped_facing;      /* one of the two is wholly behind the other's plane */
  uint32_t clipped;             /* evaluated after a cut to the other's front half-space */
  uint32_t far_pairs;           /* evaluated by the kernel alone, network not run */
  uint32_t near_pairs;          /* evaluated by the exact point-to-polygon sum */
  uint32_t blocked;             /* evaluated, no ray got through */
  uint32_t rays;                /* visibility rays made */
  uint32_t ray_tests;           /* ray against polygon */
  uint32_t faces;               /* hemicube faces rasterised */
  uint32_t faces_empty;         /* hemicube faces nothing touched */
  uint32_t cells;               /* hemicube cells written or summed */
  uint32_t skipped_behind;      /* of skipped_facing: found with one look at a whole surface */
  uint32_t skipped_small;       /* too small to ask rays for, taken as 0: PairSource::bound_uq32 */
  uint32_t skipped_convex;      /* evaluated without a thought of blockers: the scene is convex */
  uint32_t networks;            /* networks run */
  uint32_t rays_spared;         /* rays not made: no blocker reaches between the two patches */
  uint32_t blockers_kept;       /* blockers times pairs that rays are tested against */
  uint32_t blockers_rejected;   /* the same, rejected by their bounds before any ray */
  uint32_t rows;                /* hemicube rows summed */
  uint32_t rows_empty;          /* rows of faces in use that nothing touched, left out */
  uint32_t poses;               /* evaluated by a load: pose already seen */
  uint32_t sums;                /* points at which near pairs took an exact sum */
  uint32_t shut_unseen;         /* of blocked: one blocker shuts off all of the pair, no ray made */
  uint32_t sights;              /* evaluated with a visible part that was exported, no ray made */
  uint32_t tests_unseen;        /* of ray_tests: settled by a box or shadow, no look at the polygon */
} urad_counters;

/* Fills f_uq32[0 .. count-1] with the form factors F (UQ0.32, saturating) from patch `shooter` to patches
 * first .. first+count-1, which all belong to `surface`. The shooter itself gets 0. Pairs that cannot exchange
 * light get 0. On failure the contents of f_uq32 are undefined and the solver stops with the status. */
typedef urad_status (*urad_fill)(void *context, uint16_t shooter, uint16_t surface, uint16_t first,
                                 uint16_t count, uint32_t *f_uq32);

typedef struct urad_source {
  urad_fill fill;
  void *context;
} urad_source;

#endif
