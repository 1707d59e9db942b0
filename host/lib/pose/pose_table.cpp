#include "pose/pose_table.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "form_factor/reference.hpp"
#include "solve/embree_visibility.hpp"

namespace host {

namespace {

std::uint32_t uq32(double f) {
  return std::uint32_t(std::clamp(std::round(f * 0x1p32), 0.0, 0x1p32 - 1));
}

}  // namespace

PoseTable::PoseTable(const Scene& scene, PoseLayout layout, const PoseExchange& exchange,
                     int threads)
    : layout_(std::move(layout)) {
  std::vector<std::uint32_t> factor(layout_.factor.size(), 0);
  parallel_for(factor.size() - 1, threads, [&](std::size_t k) {
    const PoseFactor& pair = layout_.factor[k + 1];
    // Both directions ask for the same exchange.
    const double g =
        exchange(std::min(pair.from, pair.to), std::max(pair.from, pair.to), pair.occluded);
    factor[k + 1] = uq32(g / scene.patches[pair.from].moments.area);
  });
  value_uq32_.reserve(layout_.values());
  for (const std::uint32_t at : layout_.factor_at) value_uq32_.push_back(factor[at]);

  pod_.abi = URAD_POSE_TABLE_ABI;
  pod_.patch_count = std::uint16_t(layout_.patches);
  pod_.surface_count = std::uint16_t(layout_.surfaces);
  pod_.block_count = std::uint16_t(layout_.block.size());
  pod_.value_count = std::uint32_t(value_uq32_.size());
  pod_.block_of = layout_.block_of.data();
  pod_.block = layout_.block.data();
  pod_.value_uq32 = value_uq32_.data();
}

PoseTable make_pose_table(const Scene& scene, const FixedScene& fixed, int threads, int rays) {
  const EmbreeVisibility visibility(scene, rays);
  const PoseExchange exchange = [&](std::size_t i, std::size_t j, bool occluded) {
    const double seen = occluded ? visibility.fraction(i, j) : 1;
    return seen == 0
               ? 0.0
               : seen * reference_exchange(scene.patches[i].polygon, scene.patches[j].polygon);
  };
  return PoseTable(scene, pose_layout(scene, fixed), exchange, threads);
}

}  // namespace host
