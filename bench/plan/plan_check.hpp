// Plans against what was counted and solved.
#pragma once
#include <string>
#include <vector>

namespace bench {

/// Plans the scene of every seed and writes docs/PLAN.md: bytes, instructions and errors, planned and
/// measured.
void check(const std::string& work, const std::string& out, const std::vector<std::string>& seeds);

}  // namespace bench
