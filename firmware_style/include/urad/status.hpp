// status.hpp -- urad_status with [[nodiscard]].
#pragma once
#include "urad/status.h"

namespace urad {

/// Same values as urad_status; a result that is dropped is a warning, and warnings are errors.
enum class [[nodiscard]] Status : unsigned char{
    ok = URAD_OK,
    bad_argument = URAD_BAD_ARGUMENT,
    bad_scene = URAD_BAD_SCENE,
    bad_net = URAD_BAD_NET,
    out_of_memory = URAD_OUT_OF_MEMORY,
    overflow = URAD_OVERFLOW,
    diverges = URAD_DIVERGES,
};

}  // namespace urad
