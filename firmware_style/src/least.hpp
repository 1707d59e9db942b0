// least.hpp -- the lesser of two.
#pragma once
#include <stdint.h>

namespace urad {

constexpr int32_t least(int32_t a, int32_t b) noexcept { return a < b ? a : b; }

}  // namespace urad
