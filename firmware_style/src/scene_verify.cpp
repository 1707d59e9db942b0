#include "crc32.hpp"
#include "urad/patch.hpp"

namespace urad {

namespace {

/// The numbers of tables, one after the other.
class Numbers : public Crc32 {
 public:
  void add(const urad_point& p) noexcept { word(p.x), word(p.y), word(p.z); }
  void add(const urad_shape& s) noexcept {
    add(s.normal_q30), word(s.log2_area_q24), word(s.log2_spread_q24);
    for (const int16_t m : s.spread_q15) half(uint32_t(int32_t{m}));
    half(s.fill_uq15), half(s.reserved);
  }
  void add(const urad_grid& g) noexcept {
    add(g.origin), add(g.step_u), add(g.step_v), half(g.count_u), half(g.count_v), add(g.shape);
  }
  void add(const urad_polygon& p) noexcept {
    add(p.shape), add(p.centroid), word(p.first_vertex), half(p.vertex_count), half(p.reserved);
  }
  void add(const urad_surface& s) noexcept {
    half(s.first_patch), half(s.patch_count), half(s.material), half(s.flags);
    byte(s.grid ? 1 : 0);
    if (s.grid) add(*s.grid);
    for (uint16_t k = 0; !s.grid && k < s.patch_count; ++k) add(s.polygon[k]);
  }
  void add(const urad_material& m) noexcept {
    for (int c = 0; c < 3; ++c) half(m.reflectance_uq15[c]), word(m.exitance[c]);
    half(m.reserved);
  }
  void add(const urad_blocker& b) noexcept {
    add(b.normal_q30), add(b.low), add(b.high);
    word(b.first_vertex), half(b.vertex_count), half(b.surface);
  }
  void add(const urad_bounds& b) noexcept {
    add(b.low), add(b.high), half(b.first), half(b.end), half(b.next), half(b.reserved);
  }
  void add(const urad_visibility& v) noexcept {
    for (uint16_t k = 0; k < v.patch_count; ++k) word(v.row[k]);
    for (uint32_t k = 0; k < v.byte_count; ++k) byte(v.code[k]);
  }
};

uint32_t fields_crc32(const urad_scene& scene) noexcept {
  Crc32 crc;
  crc.half(scene.abi), crc.half(scene.flags);
  crc.half(scene.patch_count), crc.half(scene.surface_count);
  crc.half(scene.material_count), crc.half(scene.blocker_count);
  crc.word(scene.vertex_count), crc.word(scene.log2_power_q24);
  crc.byte(scene.log2_scale_q24 ? 1 : 0);
  if (scene.abi < URAD_SCENE_ABI_SIGHT) return crc.value();
  crc.half(scene.bounds_count), crc.half(scene.reserved);
  crc.byte(scene.visibility ? 1 : 0);
  if (const urad_visibility* v = scene.visibility) {
    crc.half(v->patch_count), crc.byte(v->bits), crc.byte(v->reserved), crc.word(v->byte_count);
  }
  return crc.value();
}

uint32_t tables_crc32(const urad_scene& scene) noexcept {
  Numbers crc;
  for (uint16_t k = 0; k < scene.surface_count; ++k) crc.add(scene.surface[k]);
  for (uint16_t k = 0; k < scene.material_count; ++k) crc.add(scene.material[k]);
  for (uint16_t k = 0; k < scene.blocker_count; ++k) crc.add(scene.blocker[k]);
  for (uint32_t k = 0; k < scene.vertex_count; ++k) crc.add(scene.vertex[k]);
  for (uint16_t k = 0; scene.log2_scale_q24 && k < scene.patch_count; ++k)
    crc.word(scene.log2_scale_q24[k]);
  if (scene.abi < URAD_SCENE_ABI_SIGHT) return crc.value();
  for (uint16_t k = 0; k < scene.bounds_count; ++k) crc.add(scene.bounds[k]);
  if (scene.visibility) crc.add(*scene.visibility);
  return crc.value();
}

}  // namespace

SceneCrc scene_crc32(const urad_scene& scene) noexcept {
  return {fields_crc32(scene), tables_crc32(scene)};
}

Status scene_verify(const urad_scene* scene, const SceneCrc& crc) noexcept {
  if (!scene || fields_crc32(*scene) != crc.fields) return Status::bad_scene;
  const Status status = scene_check(scene);
  if (status != Status::ok) return status;
  return tables_crc32(*scene) == crc.tables ? Status::ok : Status::bad_scene;
}

}  // namespace urad
