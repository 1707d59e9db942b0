# No board that is sold: Cortex-M0 code on the memory of the MPS2, for counting instructions on scenes that do not fit a
# micro:bit. Every instruction of the Cortex-M0 is one of the Cortex-M3, so that the count is that of a Cortex-M0.
set(BOARD_FLAGS "-mcpu=cortex-m0 -mfloat-abi=soft")
set(BOARD_FLASH "ORIGIN = 0x00000000, LENGTH = 4M")
set(BOARD_RAM "ORIGIN = 0x20000000, LENGTH = 4M")
set(BOARD_PATCHES 4096)  # patches of the largest scene
set(BOARD_PROGRAMS cost)
set(BOARD_EMULATOR "qemu-system-arm -M mps2-an385")
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
