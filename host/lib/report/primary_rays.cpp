#include "report/primary_rays.hpp"

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "geometry/triangulate.hpp"
#include "report/camera.hpp"

namespace host {
namespace {

/// What a ray's filter needs, behind Embree's context.
struct CullContext {
  RTCIntersectContext embree;
  const std::vector<Vec3>* normal;
};

/// A unit vector at right angles to `axis`, as close to `wish` as can be.
Vec3 upright(const Vec3& axis, const Vec3& wish) {
  for (const Vec3& candidate : {wish, Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    const Vec3 side = candidate - glm::dot(candidate, axis) * axis;
    if (glm::length(side) > 1e-6 * glm::length(candidate)) return glm::normalize(side);
  }
  return {1, 0, 0};
}

}  // namespace

PrimaryRays::PrimaryRays(const Scene& scene, const CornerMesh& mesh, const Camera& camera,
                         double aspect, bool cull) {
  if (mesh.facets.empty())
    throw Error("scene " + scene.name + ": nothing to draw, no patch has an area");
  const Bounds bounds = bounds_of(scene);
  middle_ = bounds.middle();
  scale_ = 1 / bounds.radius();

  device_.reset(rtcNewDevice(nullptr));
  if (!device_) throw Error("Embree does not run on this processor");
  scene_.reset(rtcNewScene(device_.get()));
  // Without it rays along a shared edge, or along the diagonal of a quad, may pass between.
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);

  std::vector<std::array<unsigned, 4>> quads;
  for (const Facet& f : mesh.facets) {
    const auto& c = f.vertex;  // Embree's triangle: the last two corners of a quad are the same
    quads.push_back({unsigned(c[0]), unsigned(c[1]), unsigned(c[2]), unsigned(c[3])});
    normal_.push_back(scene.patches[f.patch].moments.normal);
  }
  attach(mesh.vertex, quads);

  // A blocker that belongs to a surface lies in that surface's patches.
  std::vector<Vec3> corners;
  quads.clear();
  for (const Blocker& blocker : scene.blockers) {
    if (blocker.surface >= 0) continue;
    for (const Triangle& t : triangulate(blocker.polygon)) {
      const unsigned first = unsigned(corners.size());
      corners.insert(corners.end(), t.begin(), t.end());
      quads.push_back({first, first + 1, first + 2, first + 2});
    }
  }
  if (!quads.empty()) attach(corners, quads);
  if (cull)
    rtcSetGeometryIntersectFilterFunction(rtcGetGeometry(scene_.get(), 0),
                                          &PrimaryRays::keep_front);
  rtcCommitGeometry(rtcGetGeometry(scene_.get(), 0));
  rtcCommitScene(scene_.get());

  eye_ = (camera.eye - middle_) * scale_;
  forward_ = glm::normalize(camera.target - camera.eye);
  const Vec3 up = upright(forward_, camera.up);
  const double half_height = std::tan(glm::radians(0.5 * camera.field_of_view));
  right_ = (camera.mirrored ? -1 : 1) * half_height * aspect * glm::cross(forward_, up);
  up_ = half_height * up;
}

void PrimaryRays::attach(const std::vector<Vec3>& vertices,
                         const std::vector<std::array<unsigned, 4>>& quads) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_QUAD);
  auto* point = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices.size()));
  auto* corner = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), quads.size()));
  if (!point || !corner) throw Error("not enough memory to draw the scene");
  for (const Vec3& x : vertices)
    for (int k = 0; k < 3; ++k) *point++ = float((x[k] - middle_[k]) * scale_);
  for (const auto& quad : quads)
    for (const unsigned index : quad) *corner++ = index;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
}

void PrimaryRays::keep_front(const RTCFilterFunctionNArguments* arguments) {
  const auto* context = reinterpret_cast<const CullContext*>(arguments->context);
  for (unsigned k = 0; k < arguments->N; ++k) {
    if (arguments->valid[k] == 0) continue;
    const Vec3& normal = (*context->normal)[RTCHitN_primID(arguments->hit, arguments->N, k)];
    const Vec3 direction(RTCRayN_dir_x(arguments->ray, arguments->N, k),
                         RTCRayN_dir_y(arguments->ray, arguments->N, k),
                         RTCRayN_dir_z(arguments->ray, arguments->N, k));
    if (glm::dot(normal, direction) >= 0) arguments->valid[k] = 0;
  }
}

RayHit PrimaryRays::trace(double x, double y) const {
  const Vec3 direction = glm::normalize(forward_ + (2 * x - 1) * right_ + (1 - 2 * y) * up_);
  CullContext context;
  rtcInitIntersectContext(&context.embree);
  context.normal = &normal_;
  RTCRayHit query{};
  query.ray.org_x = float(eye_.x), query.ray.org_y = float(eye_.y), query.ray.org_z = float(eye_.z);
  query.ray.dir_x = float(direction.x);
  query.ray.dir_y = float(direction.y);
  query.ray.dir_z = float(direction.z);
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_.get(), &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const bool back = query.hit.geomID == 0 && glm::dot(normal_[query.hit.primID], direction) >= 0;
  if (query.hit.geomID != 0 || back) return {RayHit::kDark};
  return {RayHit::kFacet, query.hit.primID, query.hit.u, query.hit.v};
}

}  // namespace host
