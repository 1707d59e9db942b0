// Primary rays from a camera into a scene, by Embree.
#pragma once
#include <embree3/rtcore.h>

#include <memory>

#include "report/smooth.hpp"

namespace host {

struct RayHit {
  enum Kind {
    kNothing,
    kDark,
    kFacet
  } kind = kNothing;  ///< kDark: a blocker or the back of a patch
  std::uint32_t facet = 0;
  float u = 0, v = 0;  ///< as in interpolate()
};

/// Embree works in single precision, so the scene is brought to a unit box around its middle first:
/// any scale does.
class PrimaryRays {
 public:
  /// `cull`: patches seen from behind are not there.
  PrimaryRays(const Scene& scene, const CornerMesh& mesh, const Camera& camera, double aspect,
              bool cull);
  PrimaryRays(const PrimaryRays&) = delete;
  PrimaryRays& operator=(const PrimaryRays&) = delete;

  /// The first thing along the ray through the picture at (x, y), from (0, 0) top left to (1, 1)
  /// bottom right.
  RayHit trace(double x, double y) const;

 private:
  void attach(const std::vector<Vec3>& vertices, const std::vector<std::array<unsigned, 4>>& quads);
  static void keep_front(const RTCFilterFunctionNArguments* arguments);

  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> scene_;
  std::vector<Vec3> normal_;  ///< per facet
  Vec3 middle_{0};
  double scale_ = 1;
  Vec3 eye_{0}, forward_{0}, right_{0}, up_{0};
};

}  // namespace host
