// Ends the fuzzer at the first check that does not hold.
#pragma once
#include <cstdio>
#include <cstdlib>

#include "stress/attack.hpp"

inline void must_hold(const host::Findings& findings) {
  for (const host::StressCheck& check : findings.checks()) {
    if (check.holds()) continue;
    std::fprintf(stderr, "does not hold: %s\n", check.what.c_str());
    std::abort();
  }
}
