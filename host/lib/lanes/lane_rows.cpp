#include "lanes/lane_rows.hpp"

#include <algorithm>
#include <array>
#include <mutex>

#include "base/parallel.hpp"
#include "lanes/pair_lanes.hpp"
#include "urad/cheapest.hpp"
#include "urad/clip.hpp"
#include "urad/lambert.hpp"

namespace host {

namespace {

/// What one thread works with.
struct Worker {
  urad::PairSource pairs;
  const PatchLanes& patches;
  std::span<std::uint32_t> f_uq32;
  LaneFactors lanes{};
  urad_counters counters{};  // of unordered pairs
  std::array<std::uint32_t, urad::kWays> ways{};

  Worker(const urad::PairSource& source, const PatchLanes& all, std::span<std::uint32_t> factors)
      : pairs(source), patches(all), f_uq32(factors) {
    pairs.counters = &counters;
    pairs.ways = ways.data();
  }
  Worker(const Worker&) = delete;

  const urad_scene& scene() const { return *pairs.scene; }

  std::uint32_t& factor(std::uint16_t i, std::uint16_t j) const {
    return f_uq32[std::size_t{i} * scene().patch_count + j];
  }

  void store(std::uint16_t i, std::uint16_t j, std::int32_t log2_g_q24) {
    if (log2_g_q24 == urad::kNoExchange) return;
    counters.skipped_convex += pairs.rays > 0;
    const auto of = [&](PatchLanes::Row row, std::uint16_t patch) {
      return patches.row(row)[patch];
    };
    log2_g_q24 += of(PatchLanes::log2_scale, i) + of(PatchLanes::log2_scale, j);
    factor(i, j) = urad::form_factor_uq32(log2_g_q24, of(PatchLanes::log2_area, i));
    factor(j, i) = urad::form_factor_uq32(log2_g_q24, of(PatchLanes::log2_area, j));
  }

  std::int32_t exchange_q24(const urad::Patch& i, const urad::Patch& j, urad::Side side) {
    if (pairs.exchange) return pairs.exchange(pairs, i, j, side);
    if (pairs.points) return urad::exchange_exact_q24(scene(), i, j, pairs.points, &counters);
    return urad::exchange_log2_q24(scene(), i, j, pairs.kernel, pairs.net, 0, &counters);
  }

  void one_by_one(const urad::Patch& i, std::uint16_t first, std::uint16_t count, urad::Side side) {
    urad::Patch j = urad::patch_at(scene(), first);
    for (std::uint16_t k = 0; k < count; ++k) {
      if (k) urad::patch_advance(&j);
      store(i.index, j.index, exchange_q24(i, j, side));
    }
  }

  void in_lanes(const urad::Patch& i, std::uint16_t first, std::uint16_t count) {
    lane_factors(patches, i.index, first, count, pairs.kernel, pairs.net, &lanes);
    const std::uint32_t far = pairs.net ? pairs.net->far_rho_uq16 : 0;
    const std::uint32_t near =
        pairs.net && pairs.net->near_rho_uq16 ? pairs.net->near_rho_uq16 : UINT32_MAX;
    for (std::uint16_t k = 0; k < count; ++k) {
      const auto j = std::uint16_t(first + k);
      const std::uint32_t rho = lanes.rho_uq16[k];
      if (rho == LaneFactors::kNotFacing) {
        ++counters.skipped_facing;
      } else if (rho > near) {
        store(i.index, j,
              urad::exchange_exact_q24(scene(), i, urad::patch_at(scene(), j),
                                       urad::kHandOverPoints, &counters));
      } else {
        ++counters.evaluated;
        counters.far_pairs += rho < far;
        counters.networks += pairs.net && rho >= far;
        counters.skipped_convex += pairs.rays > 0;
        factor(i.index, j) = lanes.from_uq32[k];
        factor(j, i.index) = lanes.to_uq32[k];
      }
    }
  }

  /// Patch i with those after it.
  void row(std::uint16_t index) {
    const urad::Patch i = urad::patch_at(scene(), index);
    const bool lanes_know = !pairs.exchange && !pairs.points;
    for (const urad_surface* to = i.surface; to != scene().surface + scene().surface_count; ++to) {
      const auto first = std::max(std::uint16_t(index + 1), to->first_patch);
      const auto count = std::uint16_t(to->first_patch + to->patch_count - first);
      if (count == 0) continue;
      if (to == i.surface && (to->flags & URAD_SURFACE_PLANAR)) {
        counters.skipped_same += count;
        continue;
      }
      const urad::Side side =
          to == i.surface ? urad::Side::both : urad::side_of_run(scene(), i, *to);
      if (side == urad::Side::behind) {
        counters.skipped_facing += count;
      } else if (side == urad::Side::front && lanes_know) {
        in_lanes(i, first, count);
      } else {
        one_by_one(i, first, count, side);
      }
    }
  }

  /// Patches that patch i finds behind with one look at their surface.
  std::uint32_t behind(std::uint16_t index) const {
    const urad::Patch i = urad::patch_at(scene(), index);
    std::uint32_t count = 0;
    for (const urad_surface* to = scene().surface; to != scene().surface + scene().surface_count;
         ++to) {
      const bool same = to == i.surface && (to->flags & URAD_SURFACE_PLANAR);
      if (!same && urad::side_of_run(scene(), i, *to) == urad::Side::behind)
        count += to->patch_count;
    }
    return count;
  }
};

/// Both directions of every pair. Counters are words and nothing else.
void add_twice(const urad_counters& part, urad_counters* sum) {
  const auto* from = reinterpret_cast<const std::uint32_t*>(&part);
  auto* to = reinterpret_cast<std::uint32_t*>(sum);
  for (std::size_t k = 0; k < sizeof part / sizeof *to; ++k) to[k] += 2 * from[k];
}

}  // namespace

bool has_lanes(const urad::PairSource& pairs) {
  return (pairs.scene->flags & URAD_SCENE_CONVEX) && pairs.skips_off == 0;
}

void lane_rows(const urad::PairSource& pairs, int threads, std::span<std::uint32_t> f_uq32,
               urad_counters* counters) {
  const std::size_t n = pairs.scene->patch_count;
  const PatchLanes patches(*pairs.scene);
  std::fill(f_uq32.begin(), f_uq32.end(), 0);
  std::mutex sum;
  const std::size_t workers = std::min(thread_count(threads), n);
  parallel_for(workers, threads, [&](std::size_t worker) {
    Worker work(pairs, patches, f_uq32);
    std::uint32_t behind = 0;
    for (std::size_t i = worker; i < n; i += workers) {
      work.row(std::uint16_t(i));
      behind += work.behind(std::uint16_t(i));
    }
    const std::lock_guard<std::mutex> guard(sum);
    add_twice(work.counters, counters);
    counters->skipped_behind += behind;
    for (std::size_t k = 0; pairs.ways && k < work.ways.size(); ++k)
      pairs.ways[k] += 2 * work.ways[k];
  });
}

}  // namespace host
