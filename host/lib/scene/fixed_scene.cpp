#include "scene/fixed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "geometry/bridge.hpp"
#include "scene/bounds.hpp"
#include "scene/grid_detect.hpp"

namespace host {

struct FixedScene::Tables {
  std::vector<urad_surface> surface;
  std::vector<urad_material> material;
  std::vector<urad_blocker> blocker;
  std::vector<urad_bounds> bounds;
  std::vector<urad_point> vertex;
  std::vector<urad_grid> grid;
  std::vector<urad_polygon> polygon;
  std::vector<int32_t> log2_scale_q24;
  VisibilityTables sight;
  urad_visibility visibility{};
  urad_scene pod{};
  double units_per_length = 1;
  double exitance_unit = 1;
};

namespace {

constexpr double kCoordinateMax = URAD_COORDINATE_MAX;
constexpr double kPowerMax = 0x1p30;
// Light that is reflected for ever has no bound; a scene of mirrors gets this many times its
// emission.
constexpr double kMostReflections = 256;

struct Box {
  Vec3 low{std::numeric_limits<double>::max()};
  Vec3 high{std::numeric_limits<double>::lowest()};

  void add(const Polygon& polygon) {
    for (const Vec3& x : polygon.outer) low = glm::min(low, x), high = glm::max(high, x);
  }
};

Box box_of(const Scene& scene) {
  Box box;
  for (const ScenePatch& patch : scene.patches) box.add(patch.polygon);
  for (const Blocker& blocker : scene.blockers) box.add(blocker.polygon);
  return box;
}

/// Places and lengths of the file in scene units.
class Units {
 public:
  explicit Units(const Box& box) : centre_(0.5 * (box.low + box.high)) {
    const Vec3 half = 0.5 * (box.high - box.low);
    const double largest = std::max({half.x, half.y, half.z});
    if (!(largest > 0) || !std::isfinite(largest))
      throw Error("the scene has no size or an infinite one");
    // A far edge at origin + count * step may pass 1 by rounding: that must not cost a bit (`point`
    // clamps it).
    constexpr double kRounding = 1 - 1e-12;
    exponent_ = int(std::floor(std::log2(kCoordinateMax / (largest * kRounding))));
    while (std::ldexp(largest * kRounding, exponent_) > kCoordinateMax) --exponent_;
  }
  double per_length() const { return std::ldexp(1.0, exponent_); }
  double area(double a) const { return std::ldexp(a, 2 * exponent_); }
  Vec3 place(const Vec3& x) const { return (x - centre_) * per_length(); }
  Vec3 vector(const Vec3& x) const { return x * per_length(); }

 private:
  Vec3 centre_;
  int exponent_;
};

int32_t to_int(double x) { return int32_t(std::llround(x)); }

urad_point point(const Vec3& x) {
  // A corner may round past the box by one unit of double precision.
  const Vec3 y = glm::clamp(x, Vec3(-kCoordinateMax), Vec3(kCoordinateMax));
  return {to_int(y.x), to_int(y.y), to_int(y.z)};
}

urad_point normal_q30(const Vec3& n) {
  return {to_int(n.x * 0x1p30), to_int(n.y * 0x1p30), to_int(n.z * 0x1p30)};
}

int32_t log2_q24(double x, const char* what) {
  const double y = std::log2(x);
  if (!(std::abs(y) < 127))
    throw Error(fmt::format("{} of {:.3g} scene units is out of the engine's range", what, x));
  return to_int(y * 0x1p24);
}

urad_shape shape_of(const Moments& m, const Units& units) {
  urad_shape shape{};
  const glm::dmat3& s = m.second;
  const double trace = s[0][0] + s[1][1] + s[2][2];
  shape.normal_q30 = normal_q30(m.normal);
  shape.log2_area_q24 = log2_q24(units.area(m.area), "the area of a patch");
  shape.log2_spread_q24 = log2_q24(units.area(trace), "the spread of a patch");
  const double part[6] = {s[0][0], s[1][1], s[2][2], s[0][1], s[0][2], s[1][2]};
  for (int k = 0; k < 6; ++k)
    shape.spread_q15[k] = int16_t(std::min(std::llround(part[k] / trace * 0x1p15), 32767LL));
  shape.fill_uq15 = uint16_t(std::llround(m.area / (m.area + 12 * trace) * 0x1p15));
  return shape;
}

/// Steps are rounded towards zero to even numbers and the grid is laid about its centre: it never
/// leaves the box, and the two halves of a symmetric wall are exact mirror images. The loss is at
/// most 2 units a patch.
urad_grid grid_of(const Grid& grid, const Moments& patch, const Units& units) {
  const auto even = [](const Vec3& x) { return 2.0 * glm::trunc(0.5 * x); };
  const Vec3 u = even(units.vector(grid.step_u)), v = even(units.vector(grid.step_v));
  const Vec3 span = double(grid.count_u) * grid.step_u + double(grid.count_v) * grid.step_v;
  const Vec3 centre = glm::round(units.place(grid.origin + 0.5 * span));
  urad_grid fixed{};
  fixed.origin = point(centre - 0.5 * (double(grid.count_u) * u + double(grid.count_v) * v));
  fixed.step_u = {to_int(u.x), to_int(u.y),
                  to_int(u.z)};  // a step may span the box, twice a coordinate's limit
  fixed.step_v = {to_int(v.x), to_int(v.y), to_int(v.z)};
  fixed.count_u = uint16_t(grid.count_u);
  fixed.count_v = uint16_t(grid.count_v);
  fixed.shape = shape_of(patch, units);
  return fixed;
}

// Appends the loop, holes bridged, and returns its length.
uint16_t add_loop(const Polygon& polygon, const Units& units, std::vector<urad_point>* vertex) {
  const Loop loop = bridge_holes(polygon);
  if (loop.size() > URAD_POLYGON_MAX_VERTICES)
    throw Error(fmt::format("a polygon with {} vertices (holes joined); the engine takes {}",
                            loop.size(), URAD_POLYGON_MAX_VERTICES));
  for (const Vec3& x : loop) vertex->push_back(point(units.place(x)));
  return uint16_t(loop.size());
}

double largest_channel(const Vec3& x) { return std::max({x.x, x.y, x.z}); }

/// Largest power of two p with x * p <= limit.
double fit(double x, double limit) { return std::exp2(std::floor(std::log2(limit / x))); }

template <class T>
uint16_t count16(const std::vector<T>& items, const char* what) {
  if (items.size() > 65535)
    throw Error(fmt::format("{} {}; the engine takes 65535", items.size(), what));
  return uint16_t(items.size());
}

template <class T>
const T* data_or_null(const std::vector<T>& items) {
  return items.empty() ? nullptr : items.data();
}

}  // namespace

FixedScene::FixedScene(const Scene& scene) : tables_(std::make_shared<Tables>()) {
  if (scene.patches.empty()) throw Error(scene.name + ": a scene without patches");
  Tables& t = *tables_;
  const Units units(box_of(scene));
  t.units_per_length = units.per_length();

  // Reflected light adds up to emission / (1 - reflectance) at most, in power and, where one patch
  // gets it all, in radiosity: units leave room for that. Powers of two, so that they cost no
  // rounding.
  double reflectance = 0, brightest = 0;
  Vec3 emitted(0);
  for (std::size_t k = 0; k < scene.patches.size(); ++k) {
    const Material& material = scene.material_of(k);
    reflectance = std::max(reflectance, largest_channel(material.reflectance));
    brightest = std::max(brightest, largest_channel(material.exitance));
    emitted += units.area(scene.patches[k].moments.area) * material.exitance;
  }
  const double gain =
      std::min(1 / std::max(1 - reflectance, 1 / kMostReflections), kMostReflections);
  if (brightest > 0) t.exitance_unit = 1 / fit(brightest * gain, kPowerMax);
  // The engine keeps the sum of a patch's channels below the limit.
  const double power = (emitted.x + emitted.y + emitted.z) / t.exitance_unit * gain;
  const double power_units = power > 0 ? fit(power, 0.999 * kPowerMax) : 1;

  for (const Material& material : scene.materials) {
    urad_material fixed{};
    for (int c = 0; c < 3; ++c) {
      fixed.reflectance_uq15[c] = uint16_t(std::llround(material.reflectance[c] * 0x1p15));
      fixed.exitance[c] = to_int(std::min(material.exitance[c] / t.exitance_unit, 0x1p30));
    }
    t.material.push_back(fixed);
  }
  std::size_t polygons = 0;
  for (const Surface& surface : scene.surfaces)
    polygons += surface.grid ? 0 : std::size_t(surface.patch_count);
  t.grid.reserve(scene.surfaces.size());  // pointers into both must last
  t.polygon.reserve(polygons);
  for (const Surface& surface : scene.surfaces) {
    urad_surface fixed{};
    fixed.first_patch = uint16_t(surface.first_patch);
    fixed.patch_count = uint16_t(surface.patch_count);
    fixed.material = uint16_t(surface.material);
    fixed.flags = surface.planar ? URAD_SURFACE_PLANAR : 0;
    const ScenePatch* patch = &scene.patches[std::size_t(surface.first_patch)];
    if (surface.grid) {
      t.grid.push_back(grid_of(*surface.grid, patch->moments, units));
      fixed.grid = &t.grid.back();
    } else {
      fixed.polygon = t.polygon.data() + t.polygon.size();
      for (const ScenePatch* end = patch + surface.patch_count; patch != end; ++patch) {
        urad_polygon polygon{};
        polygon.shape = shape_of(patch->moments, units);
        polygon.centroid = point(units.place(patch->moments.centroid));
        polygon.first_vertex = uint32_t(t.vertex.size());
        polygon.vertex_count = add_loop(patch->polygon, units, &t.vertex);
        t.polygon.push_back(polygon);
      }
    }
    t.surface.push_back(fixed);
  }
  for (const Blocker& blocker : scene.blockers) {
    Box box;
    box.add(blocker.polygon);
    urad_blocker fixed{};
    fixed.normal_q30 = normal_q30(moments(blocker.polygon).normal);
    fixed.low = point(units.place(box.low));
    fixed.high = point(units.place(box.high));
    fixed.first_vertex = uint32_t(t.vertex.size());
    fixed.vertex_count = add_loop(blocker.polygon, units, &t.vertex);
    fixed.surface = blocker.surface < 0 ? uint16_t{0xFFFF} : uint16_t(blocker.surface);
    t.blocker.push_back(fixed);
  }

  t.bounds = make_bounds(&t.blocker);

  urad_scene& pod = t.pod;
  pod.abi = t.bounds.empty() ? URAD_SCENE_ABI : URAD_SCENE_ABI_SIGHT;
  pod.flags =
      uint16_t((scene.convex ? URAD_SCENE_CONVEX : 0) | (scene.closed ? URAD_SCENE_CLOSED : 0));
  pod.patch_count = count16(scene.patches, "patches");
  pod.surface_count = count16(t.surface, "surfaces");
  pod.material_count = count16(t.material, "materials");
  pod.blocker_count = count16(t.blocker, "blockers");
  pod.vertex_count = uint32_t(t.vertex.size());
  pod.surface = t.surface.data();
  pod.material = t.material.data();
  pod.blocker = data_or_null(t.blocker);
  pod.bounds_count = uint16_t(t.bounds.size());
  pod.bounds = data_or_null(t.bounds);
  pod.vertex = data_or_null(t.vertex);
  pod.log2_power_q24 = log2_q24(power_units, "the power unit");
}

const urad_scene& FixedScene::pod() const { return tables_->pod; }
double FixedScene::units_per_length() const { return tables_->units_per_length; }
double FixedScene::exitance_unit() const { return tables_->exitance_unit; }

void FixedScene::set_scale(const std::vector<double>& scale) {
  Tables& t = *tables_;
  if (!scale.empty() && scale.size() != t.pod.patch_count)
    throw Error(fmt::format("{} repair factors for {} patches", scale.size(), t.pod.patch_count));
  t.log2_scale_q24.clear();
  for (const double d : scale)
    t.log2_scale_q24.push_back(log2_q24(d, "the repair factor of a patch"));
  t.pod.log2_scale_q24 = data_or_null(t.log2_scale_q24);
}

void FixedScene::set_visibility(VisibilityTables tables) {
  Tables& t = *tables_;
  if (tables.row.size() != t.pod.patch_count)
    throw Error(
        fmt::format("{} rows of visibility for {} patches", tables.row.size(), t.pod.patch_count));
  t.sight = std::move(tables);
  t.visibility = {t.pod.patch_count,  t.sight.bits,       0, std::uint32_t(t.sight.code.size()),
                  t.sight.row.data(), t.sight.code.data()};
  t.pod.visibility = &t.visibility;
  t.pod.abi = URAD_SCENE_ABI_SIGHT;
}

FixedScene FixedScene::of_polygons(const std::vector<Polygon>& patches,
                                   const std::vector<Polygon>& blockers) {
  Scene scene;
  scene.name = "polygons";
  scene.materials.emplace_back();
  for (const Polygon& polygon : patches) {
    const int index = int(scene.patches.size());
    scene.patches.push_back({polygon, moments(polygon), index});
    Surface surface;
    surface.first_patch = index;
    surface.patch_count = 1;
    scene.surfaces.push_back(surface);
  }
  for (const Polygon& polygon : blockers) scene.blockers.push_back({polygon, -1});
  scene.convex = blockers.empty();
  return FixedScene(scene);
}

}  // namespace host
