// Every entry of the engine, called on a scene that nobody has vouched for.
#pragma once
#include "stress/attack.hpp"
#include "stress/choices.hpp"
#include "urad/urad.h"

namespace host {

/// The scene that `choices` make of a good one, through check, factors, sources and a solve.
void attack_engine(Choices choices, const urad_net& net, Findings* findings);

/// Null pointers, numbers out of range and memory too small, on a good scene: a status each time,
/// and nothing written.
void attack_arguments(Choices choices, const urad_net& net, Findings* findings);

/// Bits of a good scene turned one at a time: urad_scene_verify() finds them all.
void attack_bits(Choices choices, Findings* findings);

}  // namespace host
