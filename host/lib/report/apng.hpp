// Several pictures as one animated PNG, which every browser shows.
#pragma once
#include <string>
#include <vector>

#include "report/picture.hpp"

namespace host {

/// An APNG file's bytes: `frames` one after the other, `milliseconds` (1 .. 65535) each, for ever.
/// All frames have the size and channels of the first. Viewers that know no animation show the
/// first. Throws Error for no frame or frames of different sizes.
std::string apng(const std::vector<Image>& frames, int milliseconds);

}  // namespace host
