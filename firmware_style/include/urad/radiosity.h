/* radiosity.h -- state, ledger and counters of a solve, as plain data. C99 and C++17.
 *
 * Power is area times radiosity, a signed 32-bit integer per patch and channel in the scene's power
 * unit: power = exitance * 2^(log2_area + log2_power). Functions are in urad.h (C) and
 * radiosity.hpp (C++).
 */
#ifndef URAD_RADIOSITY_H
#define URAD_RADIOSITY_H
#include <stddef.h>

#include "urad/source.h"

/* Bytes of memory a solve needs: 24 a patch and 4 for each factor of the longest run asked for. A
 * constant expression, so that the memory can be a static array:
 *   static uint32_t memory[URAD_RADIOSITY_BYTES(294, 49) / 4]; */
#define URAD_RADIOSITY_BYTES(patch_count, longest_run) \
  ((size_t)24 * (patch_count) + (size_t)4 * (longest_run))

/* Bytes more for light that changes: the emitted power of every patch, 12 each. */
#define URAD_RELIGHT_BYTES(patch_count) ((size_t)12 * (patch_count))

/* |red| + |green| + |blue| of the unshot power of a patch stays below this, or the solve stops. */
#define URAD_POWER_LIMIT 1073741824 /* 2^30 */

/* Settings of a solve. The skips switched off are for tests: the light keeps its bits, the counters
 * change. */
enum {
  URAD_OVERSHOOT = 1,        /* shoot what will come back, too [Feda & Purgathofer 1992] */
  URAD_SKIP_OFF_CHANNEL = 2, /* multiply channels in which this shot has no power */
  URAD_SKIP_OFF_BLACK = 4,   /* multiply for receivers that reflect nothing in this channel */
  URAD_SKIP_OFF_DARK = 8,    /* multiply for runs whose factors are all zero */
  URAD_SKIP_OFF_UNSHOT = 16  /* ask for the factors of a shot even when no power is left */
};

/* Where the power is, per channel. emitted = absorbed + unshot + escaped holds exactly after every
 * shot. What a shot hands out is absorbed but for the part that is reflected into unshot. */
typedef struct urad_ledger {
  int64_t emitted[3];
  int64_t absorbed[3];
  int64_t unshot[3];
  int64_t escaped[3]; /* 0 in a closed scene unless rows_off counts */
} urad_ledger;

/* updates + skipped_* = 3 * patch_count * shots. Wraps at 2^32. */
typedef struct urad_radiosity_counters {
  uint32_t shots;           /* shots that moved power */
  uint32_t shots_empty;     /* steps that found no unshot power */
  uint32_t updates;         /* receivers times channels that were multiplied */
  uint32_t skipped_channel; /* the same, left out: this shot has no power in the channel */
  uint32_t skipped_black;   /* the receiver reflects nothing in it, and absorbs all the same */
  uint32_t skipped_dark;    /* all factors of the run are zero */
  uint32_t rows_over;       /* row sums above 1: the surplus turns into negative unshot power */
  uint32_t rows_off;        /* closed scene, row sum off by over 2^-8: the rest counts as escaped */
  uint32_t rows_cut;        /* row sums above 1.5: cut there, in the order of the patches */
  uint32_t worst_row_uq16;  /* largest |row sum - 1|; of an open scene, row sum - 1 */
} urad_radiosity_counters;

/* A solve. Its memory is the caller's and must outlive it. Read it through the functions. */
typedef struct urad_radiosity {
  const urad_scene* scene;
  urad_source source;
  int32_t* unshot;   /* [patch_count][3] */
  int32_t* shot;     /* [patch_count][3], what has been shot: B = (shot + unshot) / area */
  uint32_t* factors; /* [longest_run] */
  int32_t* emitted;  /* [patch_count][3], emitted power, for light that changes; null: it does not */
  uint16_t longest_run;
  uint16_t shooter;             /* the next one */
  uint16_t window_shots;        /* shots since the divergence guard looked */
  uint8_t window_strikes;       /* times in a row it found too little progress */
  uint8_t flags;                /* URAD_OVERSHOOT, URAD_SKIP_OFF_*; 32 and more: the solver's own */
  uint8_t status;               /* urad_status; once not URAD_OK, it stays */
  uint64_t remaining;           /* sum of |unshot| over patches and channels */
  uint64_t window_remaining;    /* the same when the guard looked last */
  int32_t log2_area_q24;        /* of all patches together */
  uint32_t reflectance_uq16[3]; /* area-weighted mean */
  uint32_t closure_uq16;        /* mean row sum of recent shots, at most 1 */
  int64_t reflected[3];         /* what receivers have reflected: shot + unshot - emitted */
  urad_ledger ledger;
  urad_radiosity_counters counters;
} urad_radiosity;

/* One light of several whose colours change: B that it makes alone, and how bright it is now. B is
 * linear in the lights, so that this needs no shots. */
typedef struct urad_light {
  const uint16_t* basis;   /* [patch_count][3], B of this light at colour 1, in any unit */
  uint16_t colour_uq15[3]; /* 0 .. 65535; 32768 = 1 */
} urad_light;

#endif
