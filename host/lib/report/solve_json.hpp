// What one solve did, for programs.
#pragma once
#include <string>

#include "solve/pair_statistics.hpp"
#include "solve/scene_solver.hpp"

namespace host {

/// Shots, errors against the exact solution and the exact factors, counters of the sweep and the
/// solve, energy ledger, bytes.
std::string solve_json(const Scene& scene, const std::string& method, const MethodRun& run);

/// The same for the exact solution: seconds, row sums, and how many pairs see each other.
std::string exact_json(const Scene& scene, const ExactSolution& exact, const PairStatistics& pairs);

}  // namespace host
