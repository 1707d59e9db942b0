#include "urad/clip.hpp"

#include "urad/log2.hpp"
#include "urad/vec.hpp"

namespace urad {

namespace {

/// Gathers signed distances and says which sides were seen.
class SideCount {
 public:
  void add(int32_t distance) noexcept {
    front_ = front_ || distance > kPlaneTolerance;
    behind_ = behind_ || distance < -kPlaneTolerance;
  }
  Side side() const noexcept { return !front_ ? Side::behind : behind_ ? Side::both : Side::front; }

 private:
  bool front_ = false, behind_ = false;
};

/// The crossing of the edge a b (distances of opposite sign) with the plane: the end nearer to it
/// moved along by t = da/(da-db).
urad_point crossing(const urad_point& a, int32_t da, const urad_point& b, int32_t db) noexcept {
  const uint32_t from = magnitude(da), whole = from + magnitude(db);
  const uint32_t t_uq31 = from == 0 ? 0 : exp2_uq(log2_q24(from) - log2_q24(whole), 31);
  const auto along = [=](int32_t p, int32_t q) {
    return int32_t(p + round_shift((int64_t{q} - p) * t_uq31, 31));
  };
  return {along(a.x, b.x), along(a.y, b.y), along(a.z, b.z)};
}

/// One edge of the part in front: both ends, or nothing.
struct Edge {
  urad_point a, b;
  bool kept;
};

Edge front_part(const urad_point& a, int32_t da, const urad_point& b, int32_t db) noexcept {
  if (da < 0 && db < 0) return {a, b, false};
  Edge edge{a, b, true};
  if (da < 0) edge.a = crossing(b, db, a, da);
  if (db < 0) edge.b = crossing(a, da, b, db);
  return edge;
}

/// Walks the clipped edges and hands them to `visit`.
template <class Visit>
void for_each_front_edge(const urad_scene& scene, const Patch& patch, const urad_point& on,
                         const urad_point& normal_q30, Visit visit) noexcept {
  urad_point a = patch_vertex(scene, patch, uint16_t(patch.vertex_count - 1));
  int32_t da = plane_distance(normal_q30, on, a);
  for (uint16_t k = 0; k < patch.vertex_count; ++k) {
    const urad_point b = patch_vertex(scene, patch, k);
    const int32_t db = plane_distance(normal_q30, on, b);
    const Edge edge = front_part(a, da, b, db);
    if (edge.kept) visit(edge, da < 0 || db < 0);
    a = b;
    da = db;
  }
}

int32_t component(const urad_point& p, int axis) noexcept {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

int dominant_axis(const urad_point& n) noexcept {
  const uint32_t x = magnitude(n.x), y = magnitude(n.y), z = magnitude(n.z);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// Sums over the fan (centre, a, b): doubled area, first and second moments on lengths scaled to 20
/// and 16 bits.
struct FanSums {
  int64_t area = 0;  // cross products of 20-bit lengths, along the dominant axis: 41 bits an edge
  int64_t first[3] = {};   // times 3
  int64_t second[6] = {};  // times 12, xx yy zz xy xz yz
};

class Fan {
 public:
  Fan(const urad_point& centre, int extent_bits, int axis) noexcept
      : centre_(centre),
        shift_(20 - extent_bits),
        u_(axis == 2 ? 0 : axis + 1),
        v_(axis == 0 ? 2 : axis - 1) {}

  void add(const Edge& edge) noexcept {
    int32_t a[3], b[3];
    place(edge.a, a);
    place(edge.b, b);
    const int64_t cross = wide_mul(a[u_], b[v_]) - wide_mul(a[v_], b[u_]);
    sums_.area += cross;
    const int64_t weight = round_shift(cross, 23);  // 18 bits
    int32_t a18[3], b18[3];
    for (int k = 0; k < 3; ++k) {
      sums_.first[k] += round_shift(cross, 10) * (int64_t{a[k]} + b[k]);
      a18[k] = round_shift(a[k], 2);
      b18[k] = round_shift(b[k], 2);
    }
    constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; ++k) {
      const int r = row[k], c = column[k];
      sums_.second[k] += weight * (wide_mul(a18[r], a18[c]) + wide_mul(b18[r], b18[c]) +
                                   wide_mul(a18[r] + b18[r], a18[c] + b18[c]));
    }
  }
  const FanSums& sums() const noexcept { return sums_; }

 private:
  void place(const urad_point& p, int32_t* out) const noexcept {
    const urad_point d = p - centre_;
    const int32_t value[3] = {d.x, d.y, d.z};
    for (int k = 0; k < 3; ++k)
      out[k] = shift_ >= 0 ? value[k] * (int32_t{1} << shift_) : round_shift(value[k], -shift_);
  }
  urad_point centre_;
  int shift_, u_, v_;
  FanSums sums_;
};

/// numerator / denominator times 2^fraction_bits, limited to 31 bits; relative error 5.3e-6.
/// denominator > 0.
int32_t ratio(int64_t numerator, uint64_t denominator, int fraction_bits) noexcept {
  const uint64_t size = magnitude(numerator);
  if (size == 0) return 0;
  const uint32_t value = exp2_uq(log2_q24(size) - log2_q24(denominator), fraction_bits);
  const int32_t limited = value > 0x7FFFFFFFu ? 0x7FFFFFFF : int32_t(value);
  return numerator < 0 ? -limited : limited;
}

}  // namespace

PatchPlane plane_of(const Patch& patch) noexcept {
  const urad_surface& surface = *patch.surface;
  if (surface.grid) return {surface.grid->origin, surface.grid->shape.normal_q30};
  if (!(surface.flags & URAD_SURFACE_PLANAR)) return {patch.centroid, patch.shape->normal_q30};
  return {surface.polygon[0].centroid, surface.polygon[0].shape.normal_q30};
}

Side side_of_plane(const urad_scene& scene, const Patch& patch, const urad_point& on,
                   const urad_point& normal_q30) noexcept {
  SideCount count;
  if (const urad_grid* const grid = patch.surface->grid; grid && along_an_axis(normal_q30)) {
    const auto rise = [&](const urad_point& step) {
      return plane_distance(normal_q30, {0, 0, 0}, step);
    };
    const int32_t at = plane_distance(normal_q30, on, patch_vertex(scene, patch, 0));
    const int32_t u = rise(grid->step_u), v = rise(grid->step_v);
    count.add(at + (u < 0 ? u : 0) + (v < 0 ? v : 0));  // the lowest corner
    count.add(at + (u > 0 ? u : 0) + (v > 0 ? v : 0));
    return count.side();
  }
  for (uint16_t k = 0; k < patch.vertex_count; ++k)
    count.add(plane_distance(normal_q30, on, patch_vertex(scene, patch, k)));
  return count.side();
}

Side side_of_plane(const urad_scene&, const urad_surface& surface, const urad_point& on,
                   const urad_point& normal_q30) noexcept {
  if (!surface.grid) return Side::both;
  const urad_grid& grid = *surface.grid;
  SideCount count;
  for (int corner = 0; corner < 4; ++corner) {
    const int32_t u = corner & 1 ? grid.count_u : 0, v = corner & 2 ? grid.count_v : 0;
    const urad_point at{grid.origin.x + u * grid.step_u.x + v * grid.step_v.x,
                        grid.origin.y + u * grid.step_u.y + v * grid.step_v.y,
                        grid.origin.z + u * grid.step_u.z + v * grid.step_v.z};
    count.add(plane_distance(normal_q30, on, at));
  }
  return count.side();
}

Side side_of_run(const urad_scene& scene, const Patch& shooter,
                 const urad_surface& surface) noexcept {
  const PatchPlane ahead = plane_of(shooter);
  const Side receivers = side_of_plane(scene, surface, ahead.on, ahead.normal_q30);
  if (receivers == Side::behind || !(surface.flags & URAD_SURFACE_PLANAR))
    return receivers == Side::behind ? receivers : Side::both;
  const PatchPlane behind = plane_of(patch_at(scene, surface.first_patch));
  const Side back = side_of_plane(scene, shooter, behind.on, behind.normal_q30);
  return back == Side::front ? receivers : back;
}

bool clipped_shape(const urad_scene& scene, const Patch& patch, const urad_point& on,
                   const urad_point& normal_q30, urad_shape* shape, urad_point* centroid) noexcept {
  urad_point centre{0, 0, 0};
  bool cut = false;
  for_each_front_edge(scene, patch, on, normal_q30, [&](const Edge& edge, bool crosses) {
    if (crosses && !cut) {
      centre = plane_distance(normal_q30, on, edge.a) <= plane_distance(normal_q30, on, edge.b)
                   ? edge.a
                   : edge.b;
      cut = true;
    }
  });
  if (!cut) return false;

  uint32_t extent = 0;
  for_each_front_edge(scene, patch, on, normal_q30, [&](const Edge& edge, bool) {
    const urad_point a = edge.a - centre, b = edge.b - centre;
    extent |= magnitude(a.x) | magnitude(a.y) | magnitude(a.z) | magnitude(b.x) | magnitude(b.y) |
              magnitude(b.z);
  });
  const int axis = dominant_axis(patch.shape->normal_q30);
  const int extent_bits = top_bit(extent) + 1;
  Fan fan(centre, extent_bits, axis);
  for_each_front_edge(scene, patch, on, normal_q30, [&](const Edge& edge, bool) { fan.add(edge); });

  // The doubled area seen along the dominant axis has the sign of the normal there.
  const FanSums& sums = fan.sums();
  const int32_t dominant = component(patch.shape->normal_q30, axis);
  const bool flip = dominant < 0;
  const int64_t area = flip ? -sums.area : sums.area;
  if (area <= 0) return false;

  const int lift = 20 - extent_bits;  // 20-bit lengths are scene units times 2^lift
  int32_t offset[3];                  // centroid - centre on 20-bit lengths times 2^8
  for (int k = 0; k < 3; ++k) {
    offset[k] = ratio(flip ? -sums.first[k] : sums.first[k], uint64_t(area) * 3, 18);
  }
  int64_t spread[6];  // M on 20-bit lengths times 2^-12
  constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k) {
    const int64_t about_centre =
        ratio(flip ? -sums.second[k] : sums.second[k], uint64_t(area) * 12, 15);
    const int64_t of_centroid = round_shift(wide_mul(offset[row[k]], offset[column[k]]), 28);
    spread[k] = about_centre - of_centroid;
  }
  const int64_t trace = spread[0] + spread[1] + spread[2];
  if (trace <= 0) return false;

  *shape = *patch.shape;
  const int32_t log2_dominant_q24 = log2_q24(magnitude(dominant)) - (30 << 24);
  shape->log2_area_q24 =
      log2_q24(uint64_t(area)) - (1 << 24) - log2_dominant_q24 - lift * (1 << 25);
  shape->log2_spread_q24 = log2_q24(uint64_t(trace)) + (12 << 24) - lift * (1 << 25);
  for (int k = 0; k < 6; ++k) shape->spread_q15[k] = int16_t(ratio(spread[k], uint64_t(trace), 15));
  const int32_t log2_ratio_q24 = shape->log2_spread_q24 - shape->log2_area_q24;
  constexpr uint32_t thin = uint32_t{1} << 27;  // tr M / A at most, UQ12.20: the fill is then 2^-11
  const uint32_t ratio_uq20 = exp2_uq(log2_ratio_q24, 20);
  shape->fill_uq15 =
      uint16_t(exp2_uq(-log2_1p_q24((ratio_uq20 < thin ? ratio_uq20 : thin) * 12, 20), 15));
  const auto moved = [=](int32_t c, int32_t d) {
    const int down = lift + 8;
    return int32_t(c + (down > 0 ? round_shift(d, down) : d * (int32_t{1} << -down)));
  };
  *centroid = {moved(centre.x, offset[0]), moved(centre.y, offset[1]), moved(centre.z, offset[2])};
  return true;
}

}  // namespace urad
