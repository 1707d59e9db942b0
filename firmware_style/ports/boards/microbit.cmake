# BBC micro:bit v1: Nordic nRF51822, Cortex-M0 at 16 MHz, no FPU, 256 KB flash, 16 KB RAM.
set(BOARD_FLAGS "-mcpu=cortex-m0 -mfloat-abi=soft")
set(BOARD_FLASH "ORIGIN = 0x00000000, LENGTH = 256K")
set(BOARD_RAM "ORIGIN = 0x20000000, LENGTH = 16K")
set(BOARD_PATCHES 300)  # patches of the largest scene
set(BOARD_EMULATOR "qemu-system-arm -M microbit")
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
