// The hemicube as the 1996 report describes it: one ray through the middle of every cell, from the
// centre of the gathering patch, in double.
#pragma once
#include <Eigen/Core>
#include <cstdint>

#include "scene/scene.hpp"

namespace host {

struct HemicubeCount {
  std::uint64_t rays = 0;   ///< one a cell
  std::uint64_t sums = 0;   ///< additions, one for each run of cells in a row that show one patch
  double row_of_cells = 0;  ///< sum of all delta form factors: 1 + 0.54 / resolution^2
};

/// F(i, j) of a scene: Eq. 2.7, and Eq. 2.8 with the factor z that the report leaves out, at the
/// middle of each cell. The cube's first axis lies along the patch's first edge. resolution: even,
/// at least 2, cells along a side of the top face; else Error.
Eigen::MatrixXd centre_hemicube(const Scene& scene, int resolution, int threads,
                                HemicubeCount* count);

/// Cells of such a hemicube: 3 resolution^2.
inline std::int64_t hemicube_cells(int resolution) {
  return std::int64_t{3} * resolution * resolution;
}

}  // namespace host
