#include "urad/legacy.hpp"

#include "urad/log2.hpp"
#include "urad/sigmoid.hpp"
#include "urad/vec.hpp"
#include "urad/visibility.hpp"

namespace urad {

namespace {

constexpr int32_t kZLimit_q11 = 32767;  // the sigmoid is flat beyond +-16
constexpr int32_t kHalf_q30 = 1 << 29;  // centre of the scene's box

constexpr int32_t clamped(int32_t x) noexcept {
  return x > kZLimit_q11 ? kZLimit_q11 : x < -kZLimit_q11 ? -kZLimit_q11 : x;
}

constexpr int64_t weighed(const int16_t* weight, const urad_point& x) noexcept {
  return wide_mul(weight[0], x.x) + wide_mul(weight[1], x.y) + wide_mul(weight[2], x.z);
}

constexpr int32_t to_q23(int64_t sum, int fraction_bits) noexcept {
  return int32_t(round_shift(sum, fraction_bits + 7));
}

/// All four vertices moved by `step`.
int32_t moved_q23(const int16_t* weight, int fraction_bits, const urad_point& step) noexcept {
  int64_t sum = 0;
  for (int k = 0; k < 4; ++k) sum += weighed(weight + 3 * k, step);
  return to_q23(sum, fraction_bits);
}

struct Corners {
  urad_point vertex[4];
};

Corners corners_of(const urad_scene& scene, const Patch& patch) noexcept {
  Corners corners;
  const uint16_t last = uint16_t(patch.vertex_count - 1);
  for (uint16_t k = 0; k < 4; ++k)
    corners.vertex[k] = patch_vertex(scene, patch, k < last ? k : last);
  return corners;
}

/// The rows of memory.
struct Rows {
  int32_t *p, *z, *du, *dv;
};
Rows rows_of(const LegacySource& source) noexcept {
  const int hidden = source.net->hidden;
  int32_t* m = source.memory;
  return {m, m + hidden, m + 2 * hidden, m + 3 * hidden};
}

const int16_t* weights(const urad_legacy_net& net, int h, int polygon) noexcept {
  return net.hidden_weight + h * URAD_LEGACY_INPUTS + polygon * (URAD_LEGACY_INPUTS / 2);
}

void take_shooter(LegacySource* source, const Patch& from) noexcept {
  if (source->shooter == from.index) return;
  const urad_legacy_net& net = *source->net;
  const Rows rows = rows_of(*source);
  const Corners corners = corners_of(*source->scene, from);
  for (int h = 0; h < net.hidden; ++h)
    rows.p[h] = net.hidden_bias[h] +
                legacy_half_q23(weights(net, h, 0), net.hidden_shift[h], corners.vertex);
  source->shooter = from.index;
}

/// z for one receiver, from its corners.
void take_receiver(const LegacySource& source, const Patch& to) noexcept {
  const urad_legacy_net& net = *source.net;
  const Rows rows = rows_of(source);
  const Corners corners = corners_of(*source.scene, to);
  for (int h = 0; h < net.hidden; ++h)
    rows.z[h] =
        rows.p[h] + legacy_half_q23(weights(net, h, 1), net.hidden_shift[h], corners.vertex);
}

/// z and its steps for patch (u, v) of a grid, from patch (0, 0): whole numbers, so that every way
/// to a patch gives the same.
void take_grid(const LegacySource& source, const Patch& to) noexcept {
  const urad_legacy_net& net = *source.net;
  const urad_grid& grid = *to.surface->grid;
  const Rows rows = rows_of(source);
  take_receiver(source, patch_at(*source.scene, to.surface->first_patch));
  for (int h = 0; h < net.hidden; ++h) {
    rows.du[h] = moved_q23(weights(net, h, 1), net.hidden_shift[h], grid.step_u);
    rows.dv[h] = moved_q23(weights(net, h, 1), net.hidden_shift[h], grid.step_v);
    rows.z[h] += to.u * rows.du[h] + to.v * rows.dv[h];
  }
}

void step_grid(const LegacySource& source, const Patch& to) noexcept {
  const Rows rows = rows_of(source);
  const int hidden = source.net->hidden;
  if (to.u) {
    for (int h = 0; h < hidden; ++h) rows.z[h] += rows.du[h];
  } else {
    const int32_t back = to.surface->grid->count_u - 1;
    for (int h = 0; h < hidden; ++h) rows.z[h] = rows.z[h] - back * rows.du[h] + rows.dv[h];
  }
}

bool in_front(const Patch& of, const Patch& patch) noexcept {
  return plane_distance(of.shape->normal_q30, of.centroid, patch.centroid) > kPlaneTolerance;
}

/// F times a factor 2^x, saturating.
uint32_t scaled_uq32(uint32_t f_uq32, int32_t x_q24) noexcept {
  const uint64_t product = wide_umul(f_uq32, exp2_uq(x_q24, 16)) + 0x8000u;
  return product >> 48 ? 0xFFFFFFFFu : uint32_t(product >> 16);
}

uint32_t factor_uq32(const LegacySource& source, const Patch& from, const Patch& to) noexcept {
  const urad_scene& scene = *source.scene;
  urad_counters& counters = *source.counters;
  if (!in_front(from, to) || !in_front(to, from)) {
    ++counters.skipped_facing;
    return 0;
  }
  ++counters.evaluated;
  const urad_legacy_net& net = *source.net;
  uint32_t f_uq32 = legacy_form_factor_uq32(net, legacy_output_uq15(net, rows_of(source).z));
  if (scene.log2_scale_q24)
    f_uq32 = scaled_uq32(f_uq32, scene.log2_scale_q24[from.index] + scene.log2_scale_q24[to.index]);
  if (source.rays && !(scene.flags & URAD_SCENE_CONVEX)) {
    const uint32_t seen_uq16 =
        visible_fraction_uq16(scene, from, to, source.rays, true, source.counters);
    f_uq32 = uint32_t((wide_umul(f_uq32, seen_uq16) + 0x8000u) >> 16);
  }
  return f_uq32;
}

}  // namespace

int32_t legacy_half_q23(const int16_t* weight, int fraction_bits,
                        const urad_point vertex[4]) noexcept {
  int64_t sum = 0;
  for (int k = 0; k < 4; ++k) {
    const int16_t* w = weight + 3 * k;
    sum += weighed(w, vertex[k]) + wide_mul(w[0] + w[1] + w[2], kHalf_q30);
  }
  return to_q23(sum, fraction_bits);
}

uint16_t legacy_output_uq15(const urad_legacy_net& net, const int32_t* z_q23) noexcept {
  int32_t sum = net.output_bias;
  const bool proven = net.flags & URAD_LEGACY_PROVEN;
  for (int h = 0; h < net.hidden; ++h) {
    int32_t z_q11 = round_shift(z_q23[h], 12);
    if (!proven) z_q11 = clamped(z_q11);
    sum += net.output_weight[h] * int32_t{sigmoid_uq15(int16_t(z_q11))};
  }
  return sigmoid_uq15(int16_t(clamped(round_shift(sum, net.output_shift + 4))));
}

uint32_t legacy_form_factor_uq32(const urad_legacy_net& net, uint16_t y_uq15) noexcept {
  if (net.flags & URAD_LEGACY_LOG) {
    // log2 F = log2(10) (1 - 10 y)
    constexpr int64_t slope_q19 = 17416470;   // 10 log2(10) 2^19
    constexpr int32_t offset_q24 = 55732705;  // log2(10) 2^24
    return exp2_uq(offset_q24 - int32_t(round_shift(slope_q19 * y_uq15, 10)), 32);
  }
  // (y - 0.1) / 0.8 = 1.25 y - 0.125; 1.25 2^32 / 2^15 = 163840
  constexpr uint32_t least_uq15 = 3277, most_uq15 = 29491;  // 0.1 and 0.9, F = 0 .. 1 between
  if (y_uq15 < least_uq15) return 0;
  if (y_uq15 > most_uq15) return 0xFFFFFFFFu;
  return y_uq15 * 163840u - 0x20000000u;
}

Status legacy_init(LegacySource* source, const urad_scene* scene, const urad_legacy_net* net,
                   uint16_t rays, urad_counters* counters, void* memory, size_t bytes) noexcept {
  if (!source || !scene || !counters || !memory) return Status::bad_argument;
  const Status status = legacy_check(net);
  if (status != Status::ok) return status;
  if (bytes < legacy_bytes(net->hidden) || reinterpret_cast<uintptr_t>(memory) % alignof(int32_t))
    return Status::out_of_memory;
  for (uint16_t s = 0; s < scene->surface_count; ++s) {
    const urad_surface& surface = scene->surface[s];
    for (uint16_t k = 0; !surface.grid && k < surface.patch_count; ++k)
      if (surface.polygon[k].vertex_count > 4) return Status::bad_argument;
  }
  *source = {scene, net, rays, 0xFFFF, counters, static_cast<int32_t*>(memory)};
  return Status::ok;
}

urad_status legacy_fill(void* legacy_source, uint16_t shooter, uint16_t surface, uint16_t first,
                        uint16_t count, uint32_t* f_uq32) noexcept {
  LegacySource& source = *static_cast<LegacySource*>(legacy_source);
  const urad_scene& scene = *source.scene;
  const urad_surface& to = scene.surface[surface];
  const Patch from = patch_at(scene, shooter);
  if (from.surface == &to && (to.flags & URAD_SURFACE_PLANAR)) {
    const bool holds_shooter = shooter >= first && shooter - first < count;
    source.counters->skipped_same += uint32_t(count - holds_shooter);
    for (uint16_t k = 0; k < count; ++k) f_uq32[k] = 0;
    return URAD_OK;
  }
  take_shooter(&source, from);
  Patch receiver = patch_at(scene, first);
  if (to.grid) take_grid(source, receiver);
  for (uint16_t k = 0; k < count; ++k) {
    if (k && to.grid) step_grid(source, receiver);
    if (!to.grid) take_receiver(source, receiver);
    f_uq32[k] = receiver.index == shooter ? 0 : factor_uq32(source, from, receiver);
    if (k + 1 < count) patch_advance(&receiver);
  }
  return URAD_OK;
}

}  // namespace urad
