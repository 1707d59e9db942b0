/* status.h -- what every call that can fail returns. C99 and C++17. */
#ifndef URAD_STATUS_H
#define URAD_STATUS_H

/* A call that does not return URAD_OK has written nothing, unless its own text says otherwise. */
typedef enum urad_status {
  URAD_OK = 0,
  URAD_BAD_ARGUMENT,  /* null pointer, zero count, index or setting outside its documented range */
  URAD_BAD_SCENE,     /* scene tables contradict each other or leave their documented ranges */
  URAD_BAD_NET,       /* unknown ABI, sizes over the limits, wrong checksum, or an accumulator could overflow */
  URAD_OUT_OF_MEMORY, /* memory smaller than the matching *_bytes() asked for, or misaligned */
  URAD_OVERFLOW,      /* a power would leave its 32 bits: export the scene with a smaller light */
  URAD_DIVERGES       /* the unshot power no longer falls: row sums times reflectance reach 1 */
} urad_status;

#endif
