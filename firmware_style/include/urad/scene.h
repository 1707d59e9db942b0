/* scene.h -- a scene as plain data in flash: surfaces, materials, blockers. C99 and C++17.
 *
 * Lengths are in scene units: the exporter scales the scene so that every |coordinate| <= 2^29. Areas and second
 * moments are kept as log2 in Q7.24, so that patches of any size keep full precision. Patches are numbered through
 * all surfaces: patch k belongs to the surface with first_patch <= k < first_patch + patch_count.
 */
#ifndef URAD_SCENE_H
#define URAD_SCENE_H
#include <stdint.h>

#define URAD_SCENE_ABI 1       /* the fields up to log2_power_q24: no others are looked at */
#define URAD_SCENE_ABI_SIGHT 2 /* those of sight, too: bounds of blockers, exported visibility */
#define URAD_COORDINATE_MAX 536870912 /* 2^29 */

typedef struct urad_point {
  int32_t x, y, z;
} urad_point;

/* What a planar polygon is to a form factor. M = (1/A) integral (x - c)(x - c)^T dA over the patch. */
typedef struct urad_shape {
  urad_point normal_q30;   /* unit normal on the lit side, Q2.30 */
  int32_t log2_area_q24;   /* log2 A, A in square scene units */
  int32_t log2_spread_q24; /* log2 tr M, in square scene units */
  int16_t spread_q15[6];   /* M / tr M: xx, yy, zz, xy, xz, yz */
  uint16_t fill_uq15;      /* A / (A + 12 tr M): 1/3 for a square, less for slivers */
  uint16_t reserved;       /* 0 */
} urad_shape;

/* Affine grid: patch (u, v) = origin + u step_u + v step_v, counter-clockwise along +step_u, +step_v seen from the
 * lit side; number first_patch + v * count_u + u. No patch is stored: one shape serves all. */
typedef struct urad_grid {
  urad_point origin, step_u, step_v;
  uint16_t count_u, count_v;
  urad_shape shape;
} urad_grid;

/* One patch of a polygon list: a loop in scene.vertex, holes bridged into it, counter-clockwise from the lit side. */
typedef struct urad_polygon {
  urad_shape shape;
  urad_point centroid;   /* within the box of its vertices, or a unit beside it */
  uint32_t first_vertex;
  uint16_t vertex_count; /* 3 .. URAD_POLYGON_MAX_VERTICES */
  uint16_t reserved;     /* 0 */
} urad_polygon;
#define URAD_POLYGON_MAX_VERTICES 64

enum { URAD_SURFACE_PLANAR = 1 /* all patches lie in one plane, facing one way: no light between them */ };

/* Exactly one of grid and polygon is not null. A grid is always planar. */
typedef struct urad_surface {
  uint16_t first_patch, patch_count;
  uint16_t material;
  uint16_t flags;
  const urad_grid *grid;
  const urad_polygon *polygon; /* [patch_count] */
} urad_surface;

/* Exitance and radiosity share one unit, chosen by the exporter (its C comment and report name it). */
typedef struct urad_material {
  uint16_t reflectance_uq15[3]; /* 0 .. 32768 = 1 */
  uint16_t reserved;            /* 0 */
  int32_t exitance[3];          /* emitted exitance, 0 .. 2^30 */
} urad_material;

/* A polygon that may stand between patches; opaque from both sides. */
typedef struct urad_blocker {
  urad_point normal_q30; /* unit normal, either side */
  urad_point low, high;  /* bounding box */
  uint32_t first_vertex;
  uint16_t vertex_count;
  uint16_t surface;      /* the surface it belongs to; 0xFFFF: none */
} urad_blocker;

/* A box around blockers first .. end-1, and around the boxes of their parts, which follow it. Whoever misses it goes
 * on at box `next`: the first one behind that holds none of them. */
typedef struct urad_bounds {
  urad_point low, high;
  uint16_t first, end;
  uint16_t next;     /* bounds_count: none */
  uint16_t reserved; /* 0 */
} urad_bounds;

/* Which part of every pair gets past the blockers, for chips that cannot afford rays. A row holds what a shooter
 * sees of patches 0 .. patch_count-1: codes 0 (nothing) .. 2^bits - 1 (all), the lowest bits of a byte first; or
 * runs of equal codes, a byte each: the code in the highest bits, the length less one below. */
typedef struct urad_visibility {
  uint16_t patch_count; /* that of the scene */
  uint8_t bits;         /* 1 or 4 */
  uint8_t reserved;     /* 0 */
  uint32_t byte_count;
  const uint32_t *row;  /* [patch_count] first byte of the row, and URAD_VISIBILITY_RUNS */
  const uint8_t *code;  /* [byte_count] */
} urad_visibility;
#define URAD_VISIBILITY_RUNS 0x80000000u

enum {
  URAD_SCENE_CONVEX = 1, /* every pair that faces each other sees each other: no visibility at all */
  URAD_SCENE_CLOSED = 2  /* no light leaves: rows sum to 1 after repair */
};

typedef struct urad_scene {
  uint16_t abi;   /* URAD_SCENE_ABI or URAD_SCENE_ABI_SIGHT */
  uint16_t flags; /* URAD_SCENE_CONVEX | URAD_SCENE_CLOSED */
  uint16_t patch_count, surface_count, material_count, blocker_count;
  uint32_t vertex_count;
  const urad_surface *surface;    /* [surface_count], in the order of first_patch */
  const urad_material *material;  /* [material_count] */
  const urad_blocker *blocker;    /* [blocker_count]; null when 0 */
  const urad_point *vertex;       /* [vertex_count]; null when 0 */
  const int32_t *log2_scale_q24;  /* [patch_count] symmetric repair d: G' = d_i G d_j; null: none */
  int32_t log2_power_q24;         /* log2 of power units per (exitance unit x square scene unit) */
  const urad_bounds *bounds;         /* [bounds_count], whole before part; null when 0: blockers one by one */
  const urad_visibility *visibility; /* null: by rays */
  uint16_t bounds_count;
  uint16_t reserved;                 /* 0 */
} urad_scene;

#endif
