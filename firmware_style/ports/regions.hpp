// regions.hpp -- marks what the instruction counter of bench/icount counts: one instruction that does nothing else.
#pragma once

#if defined(__arm__)
#define URAD_REGION_BEGIN() __asm volatile("mov r9, r9" ::: "memory")
#define URAD_REGION_END() __asm volatile("mov r10, r10" ::: "memory")
#elif defined(__riscv)
#define URAD_REGION_BEGIN() __asm volatile(".option push\n .option norvc\n addi x0, x0, 1\n .option pop" ::: "memory")
#define URAD_REGION_END() __asm volatile(".option push\n .option norvc\n addi x0, x0, 2\n .option pop" ::: "memory")
#else
#define URAD_REGION_BEGIN() ((void)0)
#define URAD_REGION_END() ((void)0)
#endif
