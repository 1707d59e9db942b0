// What somebody meant who typed a name that does not exist.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace host {

/// Number of the known name that is fewest letters away, the first of several; nothing when more than
/// a third of its letters would have to change.
std::optional<std::size_t> nearest_name(const std::string& typed,
                                        const std::vector<std::string>& known);

}  // namespace host
