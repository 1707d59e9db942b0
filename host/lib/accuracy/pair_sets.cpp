#include "accuracy/pair_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "accuracy/pair_families.hpp"
#include "base/parallel.hpp"
#include "form_factor/kernel.hpp"
#include "form_factor/reference.hpp"

namespace host {

namespace {

constexpr int kLowest = -6, kDecades = 6;
constexpr std::size_t kBatch = 1024;
constexpr double kKernelWithin =
    30;  // farther off than that the kernel is not, for pairs that matter here

/// 0 .. kDecades - 1, or -1.
int decade_of(double f) {
  if (!(f > 0)) return -1;
  const int decade = int(std::floor(std::log10(f))) - kLowest;
  return decade >= 0 && decade < kDecades ? decade : -1;
}

/// A draw: the pair and its factor, 0 where that was not worth the time.
struct Draw {
  PolygonPair pair;
  double exact = 0;
};

Draw draw(std::uint64_t seed, std::size_t index, const std::vector<PairSet>& sets,
          std::size_t per_decade) {
  Random random(seed, index);
  Draw result{random_facing_quads(random)};
  const double about = moment_kernel_estimate(result.pair.p, result.pair.q).f;
  const int low =
      std::max(0, decade_of(std::max(about / kKernelWithin, 2 * std::pow(10, kLowest))));
  const int high = std::max(low, decade_of(std::min(about * kKernelWithin, 0.99)));
  for (int d = low; d <= high; ++d) {
    if (sets[std::size_t(d)].pairs.size() == per_decade) continue;
    result.exact = reference_form_factor(result.pair.p, result.pair.q);
    return result;
  }
  return result;
}

}  // namespace

std::vector<PairSet> free_quads_by_decade(std::uint64_t seed, std::size_t per_decade, int threads) {
  std::vector<PairSet> sets(kDecades);
  for (int d = 0; d < kDecades; ++d)
    sets[std::size_t(d)].name = fmt::format(
        "F 1e{}..{}", kLowest + d, d + 1 < kDecades ? fmt::format("1e{}", kLowest + d + 1) : "1");
  const auto full = [&](const PairSet& set) { return set.pairs.size() == per_decade; };
  for (std::size_t first = 0; !std::all_of(sets.begin(), sets.end(), full); first += kBatch) {
    std::vector<Draw> draws(kBatch);
    parallel_for(kBatch, threads,
                 [&](std::size_t k) { draws[k] = draw(seed, first + k, sets, per_decade); });
    for (const Draw& one : draws) {
      const int decade = decade_of(one.exact);
      if (decade < 0 || full(sets[std::size_t(decade)])) continue;
      sets[std::size_t(decade)].pairs.push_back(one.pair);
      sets[std::size_t(decade)].exact.push_back(one.exact);
    }
  }
  return sets;
}

PairSet concave_part(const std::vector<PairSet>& sets, bool concave) {
  PairSet part;
  part.name = concave ? "with a concave quad" : "both convex";
  for (const PairSet& set : sets) {
    for (std::size_t k = 0; k < set.pairs.size(); ++k) {
      const PolygonPair& pair = set.pairs[k];
      if ((is_concave(pair.p) || is_concave(pair.q)) != concave) continue;
      part.pairs.push_back(pair);
      part.exact.push_back(set.exact[k]);
    }
  }
  return part;
}

PairSet room_pairs(std::uint64_t seed, std::size_t count, int threads) {
  std::vector<Draw> draws(count);
  parallel_for(count, threads, [&](std::size_t k) {
    draws[k].pair = general_pair(PairFamily::room, seed, k);
    draws[k].exact = reference_form_factor(draws[k].pair.p, draws[k].pair.q);
  });
  PairSet set;
  set.name = "two walls of a room";
  for (const Draw& one : draws) {
    if (!(one.exact > 0)) continue;
    set.pairs.push_back(one.pair);
    set.exact.push_back(one.exact);
  }
  return set;
}

}  // namespace host
