/* GCC calls these even in freestanding code. Weak: a C library may bring better ones. */
#include <stddef.h>

#define OWN_LOOP __attribute__((weak, optimize("no-tree-loop-distribute-patterns")))

OWN_LOOP void *memcpy(void *to, const void *from, size_t bytes) {
  char *t = to;
  const char *f = from;
  while (bytes--) *t++ = *f++;
  return to;
}

OWN_LOOP void *memset(void *to, int value, size_t bytes) {
  char *t = to;
  while (bytes--) *t++ = (char)value;
  return to;
}
