// How two patches stand to each other, and when two such poses are one.
//
// A pose is seen in a frame fixed to the first patch: origin at the mean of its corners, first axis
// along its first edge, third axis its normal. Two poses are equal when, for one choice of first
// corner, of direction (a mirror image) and of which patch is the first, all corners coincide
// within a distance. Corners are compared, nothing is rounded: the distance that was allowed, and
// the one that was met, bound how far the exchanges can differ.
#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "geometry/polygon.hpp"

namespace host {

/// The corners of a patch in scene units, counter-clockwise from its lit side.
struct PoseOutline {
  Loop corner;
  Vec3 centre{0};  ///< mean of the corners
  Vec3 normal{0};
  double area = 0, perimeter = 0, radius = 0;  ///< radius: of the corners about the centre
};

/// Throws nothing; a loop without area has normal 0.
PoseOutline pose_outline(Loop corners);

/// How much F can differ, either way, between pairs of patches like these whose corners are apart
/// by `distance` at most:
///
///   distance (perimeter_p min(1, A_q / (pi d^2)) + perimeter_q min(1, A_p / (pi d^2))) / smaller A
///
/// d: a distance that the patches keep from each other. Proof: G is the flux through p of the
/// vector irradiance of q, which has no sources outside q and is nowhere longer than 1 or A_q / (pi
/// d^2). What passes through p and not through its image passes through the ribbon between their
/// outlines, whose area is at most distance times perimeter. The same for q. Where a patch reaches
/// behind the other's plane the flux is cut, and twice the perimeters stand for it: lines that meet
/// one of p and its image but not the other cross the ribbon, from one side or the other.
double pose_difference(const PoseOutline& p, const PoseOutline& q, double distance);

/// How far corners may be apart for poses to count as equal: 2^-16 of the side of equal squares,
/// what six printed decimals leave open on a patch of a tenth of the scene.
double pose_tolerance(const PoseOutline& p, const PoseOutline& q);

/// Classes of equal poses, in the order in which they were first met.
class PoseClasses {
 public:
  struct Found {
    std::size_t index = 0;
    bool swapped = false;  ///< q stands where the first pair of the class has its p
    double distance = 0;   ///< of corners from those of the first pair, at most
  };
  /// The class of a pair, a new one if it equals none.
  Found find(const PoseOutline& p, const PoseOutline& q);
  std::size_t size() const { return count_; }

 private:
  struct Pose {
    Loop p, q;
    double height_p = 0, height_q = 0;  ///< of the other's centre above each patch
    std::size_t index = 0;
  };
  struct View;
  static Pose pose_of(const View& p, const View& q);
  std::optional<double> distance(const Pose& known, const PoseOutline& p, const PoseOutline& q,
                                 double limit) const;

  std::size_t count_ = 0;
  std::multimap<double, Pose> by_distance_;  ///< of the centres
};

}  // namespace host
