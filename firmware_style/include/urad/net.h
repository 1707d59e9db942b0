/* net.h -- a quantised network, as plain data in flash. C99 and C++17; weights/NAME.h includes only this.
 *
 *   y = b + sum_h v_h sigma(z_h) + sum_n s_n x_n,     z_h = b_h + sum_n w_hn x_n        one hidden layer, linear skip
 *
 * It corrects a kernel:  log2 G = log2 K + g^2 y,  g = rho / (1 + rho)                  DESIGN section 3
 */
#ifndef URAD_NET_H
#define URAD_NET_H
#include <stdint.h>

#define URAD_NET_ABI 1
#define URAD_NET_MAX_INPUTS 32
#define URAD_NET_MAX_HIDDEN 64

/* value = round(accumulator * multiplier / 2^shift), ties away from zero; 17 <= shift <= 47. */
typedef struct urad_rescale {
  uint16_t multiplier;
  uint16_t shift;
} urad_rescale;

enum {
  URAD_NET_PROVEN = 1 /* sum |w| + |b| keeps every z_h within +-16: the kernel need not clamp */
};

typedef struct urad_net {
  uint16_t abi;         /* URAD_NET_ABI */
  uint16_t flags;       /* URAD_NET_PROVEN or 0 */
  uint8_t inputs;       /* 1 .. URAD_NET_MAX_INPUTS */
  uint8_t hidden;       /* 1 .. URAD_NET_MAX_HIDDEN */
  uint8_t weight_bits;  /* 8: hidden_weight is int8_t, 16: int16_t */
  uint8_t reserved;     /* 0 */
  uint16_t far_rho_uq16;/* a pair with rho below this takes the kernel alone (g^2 counts as 0) */
  uint16_t near_rho_uq16; /* a pair with rho above this, or clipped, takes the exact sum instead; 0: never */
  const void *hidden_weight;           /* [hidden][inputs], row by row */
  const int32_t *hidden_bias;          /* [hidden], in units of weight times Q0.15 input */
  const urad_rescale *hidden_rescale;  /* [hidden], accumulator -> z in Q4.11 */
  const int16_t *output_weight;        /* [hidden], times UQ1.15 sigmoids */
  const int16_t *skip_weight;          /* [inputs], times Q0.15 inputs */
  int32_t output_bias;                 /* in units of those products */
  urad_rescale output_rescale;         /* accumulator -> y = log2 of the correction, Q15.16 */
  uint32_t crc32;                      /* IEEE CRC-32 of all fields and tables in the order above, little endian */
} urad_net;

#endif
