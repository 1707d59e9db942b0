# Reset and trap of a RISC-V core in machine mode.
  .option arch, +zicsr
  .section .vectors, "ax"
  .globl reset
reset:
  .option push
  .option norelax
  la gp, global_pointer
  .option pop
  la sp, stack_top
  la t0, trap
  csrw mtvec, t0
  j start

  .balign 4
trap:
  li a0, 97  # EXIT_FAULT
  j semihosting_exit
