// All attacks, by kind.
#pragma once
#include <string>
#include <vector>

#include "method/nets.hpp"
#include "stress/attack.hpp"

namespace host {

/// Hostile polygon pairs through every method of the command line.
std::vector<Attack> pair_attacks(const NetChoice& nets);

/// Hostile networks through the engine's check, its inference and whole solves; single-bit faults
/// in the shipped ones.
std::vector<Attack> network_attacks(const NetChoice& nets);

/// Hostile reflectances, lamps, areas and factors through the engine's solver.
std::vector<Attack> solver_attacks();

/// Random and mutated scenes through every entry of the engine.
std::vector<Attack> scene_attacks(const NetChoice& nets);

/// Mutated files through every parser.
std::vector<Attack> file_attacks();

/// "pairs", "networks", "solver", "scenes", "files".
std::vector<std::string> stress_kinds();

/// The attacks of one of them. Throws UsageError for another name.
std::vector<Attack> attacks_of(const std::string& kind, const NetChoice& nets);

}  // namespace host
