/* pose_table.h -- form factors of equal relative poses, each held once, as plain data in flash. C99 and C++17.
 *
 * Patches of a grid lie on a lattice, so that how one patch stands to another follows from the places of the two.
 * A block describes all pairs from one surface to another: where the factor of a pair lies is a sum of products of
 * places, and a run of receivers is a walk through the values at a constant stride. Surfaces that stand to each
 * other alike, turned or mirrored, share their values. The exporter makes the table (`urad bake --method table`).
 */
#ifndef URAD_POSE_TABLE_H
#define URAD_POSE_TABLE_H
#include <stdint.h>

#define URAD_POSE_TABLE_ABI 1
#define URAD_POSE_NO_BLOCK 65535       /* no light between the two surfaces */
#define URAD_POSE_VALUES_MAX 268435456 /* 2^28 */

/* One axis of the receiver: position = place + from_u a + from_v b + offset, for a shooter at (a, b). */
typedef struct urad_pose_axis {
  int32_t stride;        /* values from one position to the next; may be negative */
  int16_t offset;
  int8_t from_u, from_v; /* -1, 0 or 1; at most one of the two is not 0 */
} urad_pose_axis;

/* Positions below 0 are mirror images of others. */
enum { URAD_POSE_PLAIN = 0, URAD_POSE_ABOUT_0 = 1 /* x is -x */, URAD_POSE_ABOUT_HALF = 2 /* x is -1 - x */ };

/* All pairs from one surface to another. Receiver (u, v), shooter (a, b), x and y the positions of u and v:
 *   F = value[first + x axis[0].stride + y axis[1].stride + a from_stride[0] + b from_stride[1]]
 * Patch k of a polygon list is at (k, 0). */
typedef struct urad_pose_block {
  uint32_t first;
  int32_t from_stride[2]; /* 0 where an axis follows the shooter */
  urad_pose_axis axis[2];
  uint8_t mirror[2];      /* URAD_POSE_PLAIN, _ABOUT_0, _ABOUT_HALF, of axis 0 and 1 */
  uint16_t reserved;      /* 0 */
} urad_pose_block;

typedef struct urad_pose_table {
  uint16_t abi; /* URAD_POSE_TABLE_ABI */
  uint16_t patch_count, surface_count, block_count; /* the first two as in the scene */
  uint32_t value_count;
  const uint16_t *block_of;     /* [surface_count][surface_count], from and to; URAD_POSE_NO_BLOCK: none */
  const urad_pose_block *block; /* [block_count] */
  const uint32_t *value_uq32;   /* [value_count] form factors, UQ0.32; row repair is in them */
} urad_pose_table;

#endif
