#include "solve/pair_statistics.hpp"

#include <atomic>

#include "base/parallel.hpp"
#include "solve/embree_visibility.hpp"
#include "solve/exact.hpp"

namespace host {

PairStatistics pair_statistics(const Scene& scene, int threads, int rays) {
  const EmbreeVisibility visibility(scene, rays);
  const std::size_t n = scene.patches.size();
  std::atomic<std::uint64_t> facing{0}, partly{0}, blocked{0};
  parallel_for(n, threads, [&](std::size_t i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const ScenePatch &p = scene.patches[i], &q = scene.patches[j];
      const bool same = p.surface == q.surface && scene.surfaces[std::size_t(p.surface)].planar;
      if (same || !can_face(p, q)) continue;
      ++facing;
      const double seen = scene.convex ? 1 : visibility.fraction(i, j);
      if (seen == 0) ++blocked;
      if (seen > 0 && seen < 1) ++partly;
    }
  });
  PairStatistics result;
  result.all = n * (n - 1) / 2;
  result.facing = facing;
  result.partly = partly;
  result.blocked = blocked;
  result.seen = result.facing - result.partly - result.blocked;
  return result;
}

}  // namespace host
