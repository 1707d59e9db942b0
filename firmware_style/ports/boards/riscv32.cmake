# QEMU's RISC-V machine "virt" with a 32-bit core without FPU; everything runs from RAM. The toolchain has no libstdc++,
# so gcc links.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR riscv32)
set(CMAKE_C_COMPILER riscv64-unknown-elf-gcc)
set(CMAKE_CXX_COMPILER riscv64-unknown-elf-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)
set(CMAKE_C_FLAGS_INIT "-march=rv32imac -mabi=ilp32 -mcmodel=medany")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT}")
set(CMAKE_ASM_FLAGS_INIT "${CMAKE_C_FLAGS_INIT}")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,--no-warn-rwx-segments")  # one block of RAM holds all
set(BOARD_RAM "ORIGIN = 0x80000000, LENGTH = 1M")
set(BOARD_STARTUP startup_riscv.S)
set(BOARD_SCRIPT riscv.ld.in)
set(BOARD_PATCHES 4096)  # patches of the largest scene
set(BOARD_EMULATOR "qemu-system-riscv32 -M virt -bios none")
