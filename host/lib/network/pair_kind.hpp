// What makes a pair hard: how the two polygons touch.
#pragma once
#include <array>
#include <string_view>

#include "geometry/polygon.hpp"

namespace host {

enum class PairKind {
  edge,     ///< touch along a piece of an edge
  corner,   ///< touch in a point
  clipped,  ///< apart, one cuts the other's plane
  near,     ///< apart, unclipped, rho > 0.3
  middle,   ///< the rest that the network is run on
  far,      ///< the kernel alone
};
inline constexpr std::array kPairKinds{PairKind::edge, PairKind::corner, PairKind::clipped,
                                       PairKind::near, PairKind::middle, PairKind::far};

std::string_view name(PairKind kind);

enum class Contact { none, corner, edge };

/// How two boundaries touch; distances below 1e-9 of the smaller polygon's size count as zero.
Contact contact(const Polygon& p, const Polygon& q);

/// far_rho: below it the kernel stands alone.
PairKind kind_of(Contact contact, bool clipped, double rho, double far_rho);

}  // namespace host
