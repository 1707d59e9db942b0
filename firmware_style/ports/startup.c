#include "startup.h"

int main(void);

/* GCC would turn these loops into calls of memcpy and memset or into vector code. */
__attribute__((optimize("no-tree-loop-distribute-patterns", "no-tree-vectorize"))) void start(void) {
  const uint32_t *from = data_load;
  for (uint32_t *to = data_begin; to < data_end;) *to++ = *from++;
  for (uint32_t *to = bss_begin; to < bss_end;) *to++ = 0;
  uint32_t *const here = (uint32_t *)__builtin_frame_address(0) - 16; /* 16: room for this frame */
  for (uint32_t *to = bss_end; to < here;) *to++ = STACK_PAINT;
  for (void (*const *constructor)(void) = init_begin; constructor < init_end; ++constructor)
    (*constructor)();
  semihosting_exit(main());
}
