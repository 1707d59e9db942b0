// The pairs of two surfaces as a block of a pose table: which pairs share a value, and where it
// lies.
#pragma once
#include <cstdint>
#include <vector>

#include "urad/pose_table.h"

namespace host {

/// A box of values with up to four sides: positions along u and v of the receiver, places a and b
/// of the shooter (of length 1 where an axis follows the shooter). The first side runs fastest.
struct PoseBox {
  std::size_t size[4] = {1, 1, 1, 1};
  std::vector<std::uint32_t> id;  ///< what is to be found there; equal ids share a value

  std::size_t count() const { return size[0] * size[1] * size[2] * size[3]; }
};

/// Where a box went in a common store of values: of the two mirrored sides, what was folded; of
/// each side, the stride.
struct PosePlace {
  std::uint32_t first = 0;
  std::int32_t stride[4] = {0, 0, 0, 0};
  std::uint8_t mirror[2] = {URAD_POSE_PLAIN, URAD_POSE_PLAIN};
  int centre[2] = {0, 0};  ///< positions count from here: place of the mirror, or 0
};

/// A store of ids in which boxes that are alike, turned, mirrored or with sides exchanged, lie only
/// once.
class PoseStore {
 public:
  /// Folds the first two sides where they are their own mirror image, then looks for the box in the
  /// store, and appends it if it is not there.
  PosePlace add(const PoseBox& box);
  const std::vector<std::uint32_t>& ids() const { return ids_; }

 private:
  struct Kept {
    std::size_t size[4];
    std::size_t first;
  };
  std::vector<std::uint32_t> ids_;
  std::vector<Kept> kept_;
};

}  // namespace host
