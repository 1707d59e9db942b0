/* urad/auto.h -- the cheapest form factor that is accurate enough, in C. */
#ifndef URAD_AUTO_H
#define URAD_AUTO_H

#include "urad/urad.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a form factor cost: by which way it was found, and how many points of
 * exact sums that took. */
enum {
  URAD_WAY_NONE = 0, /* the two exchange nothing */
  URAD_WAY_KERNEL = 1,
  URAD_WAY_NETWORK = 2,
  URAD_WAY_POINT = 3,
  URAD_WAY_FOUR_POINTS = 4,
  URAD_WAY_NINE_POINTS = 5,
  URAD_WAY_REFINED = 6
};
typedef struct urad_auto_factor {
  uint32_t f_uq32;     /* UQ0.32, saturating at 2^32 - 1 */
  uint32_t error_uq32; /* estimate of the relative error, rounding of f_uq32
                          included, saturating: the true error is below it for
                          99 % of pairs of any kind. Of URAD_WAY_NONE: 0, or
                          2^32 - 1 where the two lie on each other's planes within
                          rounding, so that there may be a factor after all */
  uint16_t points;
  uint16_t way; /* URAD_WAY_* */
} urad_auto_factor;

/* Form factor F from patch `from` to patch `to`, by the cheapest way that is
 * estimated to be off by at most error_uq32; by the most accurate one where
 * none is. Blockers are ignored. from, to    below scene->patch_count; from =
 * to gives 0 net         a general network, or null: without networks
 *   error_uq32  relative error, UQ0.32, 4296 (1e-6) or more: URAD_PERCENT
 *   factor      written on success
 *   counters    may be null; else counts are added to it
 * Failure: URAD_BAD_ARGUMENT, URAD_BAD_NET (not of the inputs of a pair). */
urad_status urad_form_factor_auto(const urad_scene* scene, uint16_t from, uint16_t to,
                                  const urad_net* net, uint32_t error_uq32,
                                  urad_auto_factor* factor, urad_counters* counters);

/* The same for every pair of a solve, with visibility by rays as
 * urad_pair_source_init() has it. memory, bytes  urad_pair_source_bytes()
 * Failure: as there. */
urad_status urad_auto_source_init(urad_source* source, const urad_scene* scene, const urad_net* net,
                                  uint32_t error_uq32, uint16_t rays, urad_counters* counters,
                                  void* memory, size_t bytes);

#ifdef __cplusplus
}
#endif
#endif
