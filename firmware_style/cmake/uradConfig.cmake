# find_package(urad) -> urad::urad (engine), urad::weights (shipped networks, "weights/NAME.h"). No dependencies.
include(${CMAKE_CURRENT_LIST_DIR}/uradTargets.cmake)
