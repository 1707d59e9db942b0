# Arm MPS3 with Cortex-M55: Helium; code and data in tightly coupled memory.
set(BOARD_FLAGS "-mcpu=cortex-m55 -mfloat-abi=hard")
set(BOARD_FLASH "ORIGIN = 0x00000000, LENGTH = 512K")
set(BOARD_RAM "ORIGIN = 0x20000000, LENGTH = 512K")
set(BOARD_PATCHES 4096)  # patches of the largest scene
set(BOARD_EMULATOR "qemu-system-arm -M mps3-an547")
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
