/* Reset and vector table of any Cortex-M. */
#include "startup.h"

/* Switches the FPU and Helium on (CPACR: CP10 and CP11) before any other code may use them. */
void reset(void);
void reset(void) {
#if defined(__ARM_FP) || defined(__ARM_FEATURE_MVE)
  *(volatile uint32_t *)0xE000ED88u |= 0xFu << 20;
  __asm volatile("dsb\n isb" ::: "memory");
#endif
  start();
}

static void fault(void) { semihosting_exit(EXIT_FAULT); }

typedef void (*Vector)(void);

__attribute__((section(".vectors"), used)) static const Vector vectors[16] = {
    (Vector)stack_top, reset, fault, fault, fault, fault, fault, 0, 0, 0, 0, fault, fault, 0, fault, fault,
};
