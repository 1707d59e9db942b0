// Light as a chip would leave it: a method's factors, stopped by the engine's own estimate.
#pragma once
#include "method/nets.hpp"
#include "method/spec.hpp"
#include "scene/scene.hpp"

namespace bench {

/// Relative rms of B against the exact solution when the estimate says `stop`.
double chip_light_error(const host::Scene& scene, const host::MethodSpec& spec,
                        const host::NetChoice& nets, double stop);

}  // namespace bench
