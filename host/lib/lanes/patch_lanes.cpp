#include "lanes/patch_lanes.hpp"

#include "urad/patch.hpp"

namespace host {

PatchLanes::PatchLanes(const urad_scene& scene)
    : stride_(scene.patch_count + kPadding), values_(stride_ * row_count) {
  for (std::size_t k = 0; k < stride_; ++k) {
    const auto patch = std::min(k, std::size_t{scene.patch_count} - 1);
    const urad::Patch p = urad::patch_at(scene, std::uint16_t(patch));
    const auto put = [&](int row, std::int32_t x) { values_[std::size_t(row) * stride_ + k] = x; };
    const auto put_point = [&](int row, const urad_point& x) {
      put(row, x.x), put(row + 1, x.y), put(row + 2, x.z);
    };
    put_point(centroid, p.centroid);
    put_point(normal, p.shape->normal_q30);
    for (int m = 0; m < 6; ++m) put(spread + m, p.shape->spread_q15[m]);
    put(log2_area, p.shape->log2_area_q24);
    put(log2_spread, p.shape->log2_spread_q24);
    put(log2_scale, scene.log2_scale_q24 ? scene.log2_scale_q24[patch] : 0);
    put(fill, p.shape->fill_uq15);
  }
}

}  // namespace host
