#include "move_shaft.hpp"
#include "radiosity_change.hpp"
#include "urad/move.hpp"
#include "urad/patch.hpp"
#include "urad/radiosity.hpp"
#include "urad/vec.hpp"
#include "visibility_block.hpp"
#include "visibility_row.hpp"

namespace urad {

namespace {

constexpr int64_t kMostPart = int64_t{1} << 32;  // twice what any patch has shot

bool holds(const urad_point& low, const urad_point& high) noexcept {
  const auto along = [](int32_t a, int32_t b) {
    return a >= -URAD_COORDINATE_MAX && a <= b && b <= URAD_COORDINATE_MAX;
  };
  return along(low.x, high.x) && along(low.y, high.y) && along(low.z, high.z);
}

bool moves(const Move& move, uint32_t patch) noexcept {
  return patch - move.first_patch < move.patch_count;
}

/// Some of the box lies in front of the plane of a patch.
bool in_front(const Patch& patch, const Box& box) noexcept {
  const urad_point& n = patch.shape->normal_q30;
  const urad_point corner{n.x < 0 ? box.low.x : box.high.x, n.y < 0 ? box.low.y : box.high.y,
                          n.z < 0 ? box.low.z : box.high.z};
  return plane_distance(n, patch.centroid, corner) > -kPlaneTolerance;
}

CoarseBox around(const urad_scene& scene, const Patch& patch) noexcept {
  urad_point low = patch_vertex(scene, patch, 0), high = low;
  for (uint16_t k = 1; k < patch.vertex_count; ++k) {
    const urad_point p = patch_vertex(scene, patch, k);
    stretch(p, p, &low, &high);
  }
  return coarse_box(low, high);
}

/// One look at all pairs: light between the touched ones is given, or taken away.
class Look {
 public:
  Look(Radiosity* s, Move* move, bool give) noexcept : s_(*s), move_(*move), give_(give) {
    for (uint32_t b = 0; b < move_.box_count; ++b)
      box_[b] = coarse_box(move_.box[b].low, move_.box[b].high);
  }

  Status all() noexcept {
    for (uint32_t i = 0; i < s_.scene->patch_count; ++i) {
      const Status status = row(uint16_t(i));
      if (status != Status::ok) return status;
    }
    return Status::ok;
  }

 private:
  bool lit(uint32_t patch) const noexcept {
    const int32_t* const shot = s_.shot + 3 * patch;
    return shot[0] || shot[1] || shot[2];
  }
  int64_t with_sign(int64_t x) const noexcept { return give_ ? x : -x; }

  /// Whether the pair is that of this row: a moved end has all its pairs, else the first patch.
  bool has(uint32_t j) const noexcept {
    return moved_ == moves(move_, j) ? j > from_.index : moved_;
  }
  /// Whether a moved blocker may stand between.
  bool may_part(const Patch& receiver) const noexcept {
    const CoarseBox to = around(*s_.scene, receiver);
    for (uint32_t b = 0; b < move_.box_count; ++b)
      if (seen_[b] && shaft_meets(reach_, to, box_[b])) return true;
    return false;
  }

  Status row(uint16_t i) noexcept {
    const urad_scene& scene = *s_.scene;
    from_ = patch_at(scene, i);
    moved_ = moves(move_, i);
    lit_ = lit(i);
    for (int c = 0; c < 3; ++c) met_[c] = reflected_[c] = 0;
    bool any = moved_;
    if (!moved_ && move_.box_count) {
      reach_ = around(scene, from_);
      for (uint32_t b = 0; b < move_.box_count; ++b)
        any = (seen_[b] = in_front(from_, move_.box[b])) || any;
    }
    for (uint32_t k = 0; k < scene.surface_count; ++k) {
      const urad_surface& surface = scene.surface[k];
      const bool same = &surface == from_.surface && (surface.flags & URAD_SURFACE_PLANAR);
      const Status status = run(uint16_t(k), any && !same);
      if (status != Status::ok) return status;
    }
    return book(i, met_, reflected_);
  }

  /// Asks for touched receivers of one surface, as many at a time as stand side by side.
  Status run(uint16_t number, bool may_touch) noexcept {
    const urad_surface& surface = s_.scene->surface[number];
    Patch receiver = patch_at(*s_.scene, surface.first_patch);
    uint16_t first = 0, length = 0;
    for (uint32_t place = 0; place < surface.patch_count; ++place) {
      const bool own = has(receiver.index), last = place + 1u == surface.patch_count;
      const bool touched =
          own && may_touch && (lit_ || lit(receiver.index)) && (moved_ || may_part(receiver));
      move_.kept += own && !touched;
      if (touched && length++ == 0) first = receiver.index;
      if (length && (!touched || last || length == s_.longest_run)) {
        const Status status = exchange(number, first, length);
        if (status != Status::ok) return status;
        length = 0;
      }
      if (!last) patch_advance(&receiver);
    }
    return Status::ok;
  }

  Status exchange(uint16_t number, uint16_t first, uint16_t count) noexcept {
    const urad_status status =
        s_.source.fill(s_.source.context, from_.index, number, first, count, s_.factors);
    if (status != URAD_OK) return Status(status);
    move_.made += count;
    const urad_surface& surface = s_.scene->surface[number];
    const urad_material& material = s_.scene->material[surface.material];
    for (uint32_t k = 0; k < count; ++k) {
      if (s_.factors[k] == 0) continue;
      gather(surface, first + k, s_.factors[k]);
      const Status sent = lit_ ? send(material, first + k, s_.factors[k]) : Status::ok;
      if (sent != Status::ok) return sent;
    }
    return Status::ok;
  }

  /// From the patch of the row to patch j.
  Status send(const urad_material& material, uint32_t j, uint32_t f_uq32) noexcept {
    int64_t met[3], reflected[3];
    for (uint32_t c = 0; c < 3; ++c) {
      const int64_t power_q32 = int64_t{f_uq32} * s_.shot[3u * from_.index + c];
      met[c] = with_sign(round_shift(power_q32, 32));
      reflected[c] =
          with_sign(round_shift(round_shift(power_q32, 16) * material.reflectance_uq15[c], 31));
    }
    return book(j, met, reflected);
  }

  /// From patch j to the patch of the row: F_ji = F_ij A_i / A_j, with a bit more than a unit. Each
  /// pair is rounded by itself: which others are looked at changes no bit.
  void gather(const urad_surface& surface, uint32_t j, uint32_t f_uq32) noexcept {
    const int32_t log2_ratio_q24 =
        from_.shape->log2_area_q24 - log2_area_of(surface, j - surface.first_patch);
    for (uint32_t c = 0; c < 3; ++c) {
      if (s_.shot[3 * j + c] == 0) continue;
      const int64_t part = round_shift(int64_t{f_uq32} * s_.shot[3 * j + c], 31);
      int64_t met = log2_ratio_q24 ? times_exp2(part, log2_ratio_q24) : part;
      // F_ji is at most 1: only a source that is not reciprocal has more.
      met = met > kMostPart ? kMostPart : met < -kMostPart ? -kMostPart : met;
      const urad_material& material = s_.scene->material[from_.surface->material];
      met_[c] += with_sign(round_shift(met, 1));
      reflected_[c] += with_sign(round_shift(met * material.reflectance_uq15[c], 16));
    }
  }

  Status book(uint32_t patch, const int64_t* met, const int64_t* reflected) noexcept {
    const Changed to = changed(s_, patch, reflected);
    if (!to.fits) return Status::overflow;
    write(&s_, patch, to);
    for (int c = 0; c < 3; ++c) {
      s_.reflected[c] += reflected[c];
      s_.ledger.absorbed[c] += met[c] - reflected[c];
      s_.ledger.escaped[c] -= met[c];
    }
    return Status::ok;
  }

  Radiosity& s_;
  Move& move_;
  const bool give_;
  CoarseBox box_[2], reach_;
  bool seen_[2] = {false, false};  // by the patch of the row
  bool moved_ = false, lit_ = false;
  Patch from_;
  int64_t met_[3], reflected_[3];  // by the patch of the row
};

Status look(Radiosity* s, Move* move, bool give) noexcept {
  const Status status = Look(s, move, give).all();
  if (status != Status::ok) s->status = uint8_t(status);
  return status;
}

}  // namespace

Status radiosity_move_begin(Radiosity* s, Move* move) noexcept {
  if (!s || !move || (s->flags & kMoving) || visibility_of(*s->scene)) return Status::bad_argument;
  const uint32_t end = uint32_t{move->first_patch} + move->patch_count;
  if (end > s->scene->patch_count || move->box_count > 2) return Status::bad_argument;
  for (uint32_t b = 0; b < move->box_count; ++b)
    if (!holds(move->box[b].low, move->box[b].high)) return Status::bad_argument;
  if (s->status != URAD_OK) return Status(s->status);
  move->made = move->kept = 0;
  s->flags |= kMoving;
  return look(s, move, false);
}

Status radiosity_move_end(Radiosity* s, Move* move, const urad_scene* scene,
                          const urad_source* source) noexcept {
  if (!s || !move || !(s->flags & kMoving) || (source && !source->fill)) {
    return Status::bad_argument;
  }
  if (scene && (scene->patch_count != s->scene->patch_count || visibility_of(*scene))) {
    return Status::bad_argument;
  }
  if (s->status != URAD_OK) return Status(s->status);
  if (scene) s->scene = scene;
  if (source) s->source = *source;
  const Status status = look(s, move, true);
  s->flags = uint8_t(s->flags & ~kMoving);
  if (status != Status::ok) return status;
  measure_scene(s);
  begin_again(s);
  return Status::ok;
}

}  // namespace urad
