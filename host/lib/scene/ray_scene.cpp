#include "scene/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "geometry/triangulate.hpp"

namespace host {

// What single precision leaves open, of the size of the scene: a segment that ends this near to a
// polygon's plane ends on it, and does not cross it.
constexpr double kSamePlane = 1e-6;

struct RayScene::Tables {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<int> surface;          // by triangle
  std::vector<std::size_t> polygon;  // by triangle
  std::vector<Vec3> normal;          // by polygon
  std::vector<Vec3> on_plane;        // by polygon: a corner, in local coordinates
  Vec3 centre{0};
  double scale = 1;

  Tables() = default;
  Tables(const Tables&) = delete;
  Tables& operator=(const Tables&) = delete;
  ~Tables() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Vec3 local(const Vec3& x) const { return (x - centre) * scale; }
  bool in_plane(std::size_t k, const Vec3& x) const {
    return std::abs(glm::dot(normal[k], x - on_plane[k])) <= kSamePlane;
  }
};

namespace {

struct Context {
  RTCIntersectContext embree;  // first: Embree hands back a pointer to it
  const RayScene::Tables* tables;
  int skip_a, skip_b;
  Vec3 start, end, direction;  // local; a ray without end has end = start
  bool lit_only;
};

// The back of a two-sided sheet lies where its front does: neither stops what starts or ends there.
void leave_out(const RTCFilterFunctionNArguments* arguments) {
  const auto* context = reinterpret_cast<const Context*>(arguments->context);
  const RayScene::Tables& tables = *context->tables;
  const unsigned triangle = RTCHitN_primID(arguments->hit, 1, 0);
  const int surface = tables.surface[triangle];
  const std::size_t polygon = tables.polygon[triangle];
  const bool own = surface >= 0 && (surface == context->skip_a || surface == context->skip_b);
  const bool dark = context->lit_only && glm::dot(context->direction, tables.normal[polygon]) >= 0;
  if (own || dark || tables.in_plane(polygon, context->start) ||
      tables.in_plane(polygon, context->end))
    arguments->valid[0] = 0;
}

RTCRay make_ray(const Vec3& origin, const Vec3& direction, float end) {
  RTCRay ray{};
  ray.org_x = float(origin.x), ray.org_y = float(origin.y), ray.org_z = float(origin.z);
  ray.dir_x = float(direction.x), ray.dir_y = float(direction.y), ray.dir_z = float(direction.z);
  ray.tfar = end;
  ray.mask = ~0u;
  return ray;
}

}  // namespace

RayScene::RayScene(const std::vector<Blocker>& polygons) {
  auto tables = std::make_shared<Tables>();
  Vec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const Blocker& blocker : polygons)
    for (const Vec3& x : blocker.polygon.outer) low = glm::min(low, x), high = glm::max(high, x);
  if (!polygons.empty()) {
    tables->centre = 0.5 * (low + high);
    const Vec3 size = high - low;
    const double largest = std::max({size.x, size.y, size.z});
    if (largest > 0) tables->scale = 1 / largest;
  }
  std::vector<Triangle> triangles;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    tables->normal.push_back(moments(polygons[k].polygon).normal);
    tables->on_plane.push_back(tables->local(polygons[k].polygon.outer.front()));
    for (const Triangle& triangle : triangulate(polygons[k].polygon)) {
      triangles.push_back(triangle);
      tables->surface.push_back(polygons[k].surface);
      tables->polygon.push_back(k);
    }
  }
  tables->device = rtcNewDevice("threads=1");
  if (!tables->device)
    throw Error("Embree cannot start: visibility needs a 64-bit x86 processor with SSE2");
  tables->scene = rtcNewScene(tables->device);
  rtcSetSceneFlags(tables->scene,
                   RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  if (!triangles.empty()) {
    RTCGeometry geometry = rtcNewGeometry(tables->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * triangles.size()));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size()));
    unsigned count = 0;
    for (const Triangle& triangle : triangles)
      for (const Vec3& corner : triangle) {
        const Vec3 x = tables->local(corner);
        for (int axis = 0; axis < 3; ++axis) *vertex++ = float(x[axis]);
        *index++ = count++;
      }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(tables->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(tables->scene);
  tables_ = std::move(tables);
}

std::optional<RayScene::Hit> RayScene::first_hit(const Vec3& origin, const Vec3& direction,
                                                 int skip_surface) const {
  const Vec3 start = tables_->local(origin), along = direction * tables_->scale;
  const auto look = [&](bool lit_only) -> std::optional<Hit> {
    Context context{{}, tables_.get(), skip_surface, -1, start, start, direction, lit_only};
    rtcInitIntersectContext(&context.embree);
    context.embree.filter = leave_out;
    RTCRayHit query{};
    query.ray = make_ray(start, along, std::numeric_limits<float>::infinity());
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(tables_->scene, &context.embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const std::size_t polygon = tables_->polygon[query.hit.primID];
    return Hit{double(query.ray.tfar), polygon, glm::dot(direction, tables_->normal[polygon]) < 0};
  };
  const std::optional<Hit> hit = look(false);
  if (!hit || hit->front) return hit;
  const std::optional<Hit> lit = look(true);
  const bool same = lit && tables_->in_plane(hit->polygon, start + lit->distance * along);
  return same ? lit : hit;
}

bool RayScene::blocked(const Vec3& a, const Vec3& b, int surface_a, int surface_b) const {
  const Vec3 start = tables_->local(a), end = tables_->local(b);
  Context context{{}, tables_.get(), surface_a, surface_b, start, end, end - start, false};
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = leave_out;
  RTCRay ray = make_ray(start, end - start, 1.0f);
  rtcOccluded1(tables_->scene, &context.embree, &ray);
  return ray.tfar < 0;
}

}  // namespace host
