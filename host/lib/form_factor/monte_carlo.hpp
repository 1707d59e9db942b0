// Form factors by sampling, with blockers.
#pragma once
#include <cstdint>
#include <vector>

#include "form_factor/estimate.hpp"
#include "geometry/polygon.hpp"

namespace host {

/// F from p to q past `blockers` (opaque from both sides), from about `samples` rays. Rays start
/// uniformly on the smaller of the two and aim uniformly at the solid angle of the other [Arvo
/// 1995], so that every sample is bounded, also where patches touch; reciprocity does the rest. The
/// points are low-discrepancy, in 16 randomly shifted copies whose scatter is the error estimate
/// (one standard error). Fixed seed: the same call gives the same bits. Blockers coplanar with p or
/// q do not block.
Estimate monte_carlo(const Polygon& p, const Polygon& q, std::int64_t samples,
                     const std::vector<Polygon>& blockers = {}, std::uint64_t seed = 1);

/// Whether the open segment a..b meets the polygon (holes let it pass).
bool segment_hits(const Vec3& a, const Vec3& b, const Polygon& polygon);

}  // namespace host
