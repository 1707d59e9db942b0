// What the engine counted, as every report writes it.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>

#include "urad/source.h"

namespace host {

/// Ordered pairs that the counters account for: evaluated + skipped.
inline std::uint64_t counted_pairs(const urad_counters& c) {
  return std::uint64_t{c.evaluated} + c.skipped_same + c.skipped_facing + c.skipped_small;
}

/// All counters by name, and the pairs that they add up to: evaluated and skipped.
nlohmann::ordered_json counters_json(const urad_counters& c);

}  // namespace host
