# Luminary LM3S6965 evaluation board: Cortex-M3, 256 KB flash, 64 KB RAM.
set(BOARD_FLAGS "-mcpu=cortex-m3 -mfloat-abi=soft")
set(BOARD_FLASH "ORIGIN = 0x00000000, LENGTH = 256K")
set(BOARD_RAM "ORIGIN = 0x20000000, LENGTH = 64K")
set(BOARD_PATCHES 1500)  # patches of the largest scene
set(BOARD_EMULATOR "qemu-system-arm -M lm3s6965evb")
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
