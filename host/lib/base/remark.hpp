// What a program says beside its results.
#pragma once
#include <cstdio>
#include <string>

namespace host {

/// Writes to standard error. Where that is closed or full nothing is said, and the work goes on.
inline void remark(const std::string& text) { (void)std::fputs(text.c_str(), stderr); }

}  // namespace host
