# Arm MPS2 with Cortex-M4 and single-precision FPU.
set(BOARD_FLAGS "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard")
set(BOARD_FLASH "ORIGIN = 0x00000000, LENGTH = 4M")
set(BOARD_RAM "ORIGIN = 0x20000000, LENGTH = 4M")
set(BOARD_PATCHES 4096)  # patches of the largest scene
set(BOARD_EMULATOR "qemu-system-arm -M mps2-an386")
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
