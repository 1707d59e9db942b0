/* startup.h -- what the start-up code of a board and the linker script share. */
#ifndef URAD_PORTS_STARTUP_H
#define URAD_PORTS_STARTUP_H
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Linker script. */
extern uint32_t data_load[], data_begin[], data_end[], bss_begin[], bss_end[], stack_top[];
extern void (*const init_begin[])(void);
extern void (*const init_end[])(void);

/* Free RAM is filled with this before main, so that the deepest stack can be read off afterwards. */
#define STACK_PAINT 0x5AFE57ACu

/* Exit code of an image that ran into a fault. */
#define EXIT_FAULT 97

/* C part of the reset: copies .data, clears .bss, paints the stack below the caller, runs constructors and main.
 * Vector units may still be off: it is compiled without them. */
void start(void) __attribute__((noreturn));

/* Ends the emulation with this exit code. */
void semihosting_exit(int code) __attribute__((noreturn));

#ifdef __cplusplus
}
#endif

#endif
