/* legacy_net.h -- a network of the 1996 report, quantised, as plain data in flash. C99 and C++17.
 *
 *   z_h = b_h + sum_n w_hn x_n,     y = sigma(c + sum_h v_h sigma(z_h))
 *
 * x: 24 raw coordinates in [0, 1], the four vertices of the shooter, then those of the receiver. F = (y - 0.1) / 0.8,
 * or 10^(1 - 10 y) with URAD_LEGACY_LOG.                                            [Martin 1996, sections 3.3, 4.2.3]
 */
#ifndef URAD_LEGACY_NET_H
#define URAD_LEGACY_NET_H
#include <stdint.h>

#define URAD_LEGACY_ABI 1
#define URAD_LEGACY_INPUTS 24
#define URAD_LEGACY_MAX_HIDDEN 64

enum {
  URAD_LEGACY_PROVEN = 1, /* sum |w| + |b| keeps every z_h within +-16: the kernel need not clamp */
  URAD_LEGACY_LOG = 2     /* y is 0.1 - 0.1 log10 F, else 0.8 F + 0.1 */
};

typedef struct urad_legacy_net {
  uint16_t abi;                  /* URAD_LEGACY_ABI */
  uint16_t flags;                /* URAD_LEGACY_* */
  uint8_t hidden;                /* 1 .. URAD_LEGACY_MAX_HIDDEN */
  uint8_t output_shift;          /* fraction bits of output_weight, 0 .. 15 */
  uint8_t reserved[2];           /* 0 */
  const int16_t *hidden_weight;  /* [hidden][24], row by row */
  const uint8_t *hidden_shift;   /* [hidden], fraction bits of the row's weights, 0 .. 24 */
  const int32_t *hidden_bias;    /* [hidden], Q8.23, like z */
  const int16_t *output_weight;  /* [hidden] */
  int32_t output_bias;           /* output_shift + 15 fraction bits */
  uint32_t crc32;                /* IEEE CRC-32 of all fields and tables in the order above, little endian */
} urad_legacy_net;

#endif
