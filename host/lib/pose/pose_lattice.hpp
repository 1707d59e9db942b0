// Places of patches on grids, and which axes of two grids run side by side.
#pragma once
#include <algorithm>

#include "geometry/polygon.hpp"
#include "urad/scene.h"

namespace host {

inline Vec3 to_vec(const urad_point& p) { return {double(p.x), double(p.y), double(p.z)}; }

/// Places of a surface: those of its grid, or a row.
struct Lattice {
  int count[2] = {1, 1};
  Vec3 step[2] = {Vec3(0), Vec3(0)};
  int first = 0;
  bool grid = false;

  explicit Lattice(const urad_surface& surface) : first(surface.first_patch) {
    if ((grid = surface.grid != nullptr)) {
      count[0] = surface.grid->count_u, count[1] = surface.grid->count_v;
      step[0] = to_vec(surface.grid->step_u), step[1] = to_vec(surface.grid->step_v);
    } else {
      count[0] = surface.patch_count;
    }
  }
  std::size_t patch(const int* place) const {
    return std::size_t(first + place[1] * count[0] + place[0]);
  }
};

/// An axis of the receiver's grid that runs along one of the shooter's: only the difference of the
/// two places matters.
struct Partner {
  int axis = -1;     // of the shooter; -1: none
  int sign = 1;      // 1: the same way, -1: the other
  double apart = 0;  // corners of pairs with equal difference, at most
};

/// The axis of `from` that this axis of `to` runs along, if corners of all pairs with equal difference
/// stay within `limit` of each other. `taken` is another's partner.
inline Partner partner_of(const Lattice& from, const Lattice& to, int axis, int taken,
                          double limit) {
  if (!from.grid || !to.grid) return {};
  for (int d = 0; d < 2; ++d) {
    const int shared = std::min(from.count[d], to.count[axis]) - 1;
    for (const int sign : {1, -1}) {
      const double apart = shared * glm::length(to.step[axis] - double(sign) * from.step[d]);
      if (d != taken && shared > 0 && apart <= limit) return {d, sign, apart};
    }
  }
  return {};
}

}  // namespace host
