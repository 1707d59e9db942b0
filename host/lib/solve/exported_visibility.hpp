// Visible parts of all pairs as codes in flash, for chips that cannot afford rays (urad_visibility).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scene/fixed_scene.hpp"

namespace host {

/// What a code is: one bit, or a fraction of 15ths.
enum class VisibilityCode : std::uint8_t { bits = 1, fractions = 4 };

/// "bits" or "fractions". Throws UsageError.
VisibilityCode parse_visibility_code(const std::string& name);

/// By `rays` rays a pair (EmbreeVisibility), the same both ways. Nothing and all are exact. Bits of
/// pairs seen in part are chosen, the greatest exchanges first, so that every patch exchanges in sum
/// what it should. Rows are runs or plain codes, whichever is shorter; pairs that exchange no light
/// lengthen the run that they lie in.
VisibilityTables make_visibility(const Scene& scene, const FixedScene& fixed, VisibilityCode code,
                                 int rays, int threads);

/// "17340 bytes: 4 bits a pair, 231 of 290 rows in runs".
std::string to_line(const VisibilityTables& tables);

}  // namespace host
