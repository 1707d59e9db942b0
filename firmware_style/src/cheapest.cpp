#include "urad/cheapest.hpp"

#include "cheapest_floor.hpp"
#include "cheapest_models.hpp"
#include "cheapest_traits.hpp"
#include "lambert_refiner.hpp"
#include "urad/network.hpp"
#include "urad/third_order.hpp"

namespace urad {

namespace {

constexpr int32_t kMostError_q8 = 4 * 256;      // beyond a factor 16 all are equally useless
constexpr int32_t kLeastError_q8 = -19 * 256;   // log2 and exp2 are chords
constexpr int32_t kSumRounding_q8 = -31 * 256;  // of a sum, relative to a factor of 1

int32_t by_kernel_q24(const PairKernel& kernel) noexcept {
  return kernel.log2_kernel_q24 + kernel.log2_bend_q24;
}

int32_t by_network_q24(const PairKernel& kernel, const urad_net& net) noexcept {
  if (kernel.rho_uq16 < net.far_rho_uq16) return by_kernel_q24(kernel);
  Pair inputs;
  pair_inputs(kernel, &inputs);
  return by_kernel_q24(kernel) + word_q24(network_run(net, inputs.input_q15), inputs.gate_uq16);
}

constexpr int32_t greatest(int32_t a, int32_t b) noexcept { return a > b ? a : b; }

/// One pair on its way from cheap to dear.
class Search {
 public:
  /// estimate: whether result.log2_error_q8 is wanted, too; it takes all of a guess to say it.
  Search(const ErrorModels& models, const urad_scene& scene, const Patch& i, const Patch& j,
         bool estimate) noexcept
      : models_(models), scene_(scene), i_(i), j_(j), estimate_(estimate) {}

  /// False when the two exchange nothing.
  bool begin(Side side) noexcept {
    bool cut = false;
    if (!clipped_kernel(scene_, i_, j_, &cuts_, &kernel_, &limit_q24_, &cut, side)) return false;
    fill_traits(scene_, i_, j_, cuts_, kernel_, &traits_);
    return true;
  }

  CheapestPair run(const urad_net* net, int16_t log2_error_q8) noexcept {
    wanted_q8_ = log2_error_q8;
    floor_q8_ = grid_q8(traits_);
    if (moments_do(traits_)) {
      if (kernel_does()) return found(by_kernel_q24(kernel_), Way::kernel);
      if (net && !cut() && guess(models_.network))
        return found(by_network_q24(kernel_, *net), Way::network);
    }
    LambertPair pair;
    if (!lambert_pair(scene_, i_, j_, &pair)) return nothing();
    floor_q8_ = grid_q8(traits_, kernel_);
    if (guess(models_.point) && sum(pair, 1, models_.point, Way::point)) return result_;
    if (guess(models_.before_four) && sum(pair, 2, models_.four_points, Way::four_points))
      return result_;
    return refine(pair);
  }

  CheapestPair nothing() const noexcept {
    return {kNoExchange, none_q8(scene_, i_, j_), Way::none, point_sums_, 0};
  }

  bool cut() const noexcept { return traits_.pair_class == PairClass::cut; }

 private:
  bool guess(const ErrorModel& model) noexcept {
    if (!estimate_) return error_within(model, traits_, wanted_q8_);
    guess_q8_ = error_q8(model, traits_);
    return guess_q8_ <= wanted_q8_;
  }
  /// The kernel with third moments is as good for lopsided patches as the one without is for
  /// symmetric ones, and one guess does for both. They are only computed where they may matter.
  bool kernel_does() noexcept {
    if (traits_.pair_class != PairClass::lopsided) return guess(models_.kernel);
    int16_t& shapes = traits_.log2_q8[trait_shapes];
    const int16_t lopsided = shapes;
    shapes = 0;
    const bool good = guess(models_.kernel);
    shapes = lopsided;
    if (good) third_moments();
    return good;
  }

  void third_moments() noexcept {
    const int32_t third_q8 = most_third_q8(traits_);
    if (third_q8 <= wanted_q8_) {
      guess_q8_ = greatest(guess_q8_, third_q8);
      return;
    }
    const ThirdOrder third = third_order(scene_, i_, j_, kernel_);
    kernel_.log2_bend_q24 = log2_bend_q24(kernel_, third.t3_q22);
    cubics_ = third.cubics;
  }

  /// The guess, or what rounding leaves open where that is more.
  int16_t said_q8(int32_t rounding_q8) const noexcept {
    return int16_t(least(greatest(greatest(guess_q8_, floor_q8_), rounding_q8), kMostError_q8));
  }

  CheapestPair found(int32_t log2_g_q24, Way way) const noexcept {
    return {least(log2_g_q24, limit_q24_), said_q8(kLeastError_q8), way, point_sums_, cubics_};
  }

  /// What is known after a sum; true when it is good enough.
  bool judge(const LambertSum& sum, const ErrorModel& model, Way way) noexcept {
    if (sum.log2_exchange_q24 == kNoExchange) {
      result_ = nothing();
      return false;
    }
    fill_traits(sum, least(by_kernel_q24(kernel_), limit_q24_), &traits_);
    const Patch& carrier = carries(i_, j_) ? i_ : j_;
    const int32_t factor_q8 = q8(sum.log2_exchange_q24 - carrier.shape->log2_area_q24);
    const bool good = guess(model);
    result_ = found(sum.log2_exchange_q24, way);
    result_.log2_error_q8 =
        said_q8(greatest(greatest(kSumRounding_q8 - factor_q8, kLeastError_q8), sum.log2_dark_q8));
    return good;
  }

  bool sum(const LambertPair& pair, int points, const ErrorModel& model, Way way) noexcept {
    const LambertRun run(scene_, pair, points);
    const LambertSum sum = run.sum();
    point_sums_ = uint16_t(point_sums_ + sum.point_sums);
    return judge(sum, model, way);
  }

  /// Nine points; halvings until the sum is good enough, or there is nothing left to halve.
  CheapestPair refine(const LambertPair& pair) noexcept {
    const uint16_t before = point_sums_;
    LambertRun run(scene_, pair, kRefinedPoints);
    for (Way way = Way::nine_points;; way = Way::refined) {
      const LambertSum sum = run.sum();
      point_sums_ = uint16_t(before + sum.point_sums);
      if (judge(sum, models_.refined, way) || !run.halve_worst()) return result_;
    }
  }

  const ErrorModels& models_;
  const urad_scene& scene_;
  const Patch &i_, &j_;
  bool estimate_;
  Cuts cuts_;
  PairKernel kernel_;  // points into cuts_
  PairTraits traits_;
  CheapestPair result_;
  int32_t limit_q24_ = 0;
  int32_t guess_q8_ = 0, floor_q8_ = 0;
  int16_t wanted_q8_ = 0;
  uint16_t point_sums_ = 0, cubics_ = 0;
};

CheapestPair cheapest(const ErrorModels& models, const urad_scene& scene, const Patch& i,
                      const Patch& j, Side side, const urad_net* net, int16_t log2_error_q8,
                      bool estimate, urad_counters* counters) noexcept {
  Search search(models, scene, i, j, estimate);
  const CheapestPair pair = search.begin(side) ? search.run(net, log2_error_q8) : search.nothing();
  if (pair.way == Way::none) {
    ++counters->skipped_facing;
    return pair;
  }
  ++counters->evaluated;
  if (search.cut()) ++counters->clipped;
  if (pair.way == Way::kernel) ++counters->far_pairs;
  if (pair.way > Way::network) ++counters->near_pairs;
  return pair;
}

}  // namespace

CheapestPair cheapest_exchange(const ErrorModels& models, const urad_scene& scene, const Patch& i,
                               const Patch& j, const urad_net* net, int16_t log2_error_q8,
                               urad_counters* counters) noexcept {
  return cheapest(models, scene, i, j, Side::both, net, log2_error_q8, true, counters);
}

const ErrorModels& error_models() noexcept { return kErrorModels; }

CheapestPair cheapest_exchange(const urad_scene& scene, const Patch& i, const Patch& j,
                               const urad_net* net, int16_t log2_error_q8,
                               urad_counters* counters) noexcept {
  return cheapest_exchange(kErrorModels, scene, i, j, net, log2_error_q8, counters);
}

int32_t cheapest_of_source(const PairSource& source, const Patch& i, const Patch& j,
                           Side side) noexcept {
  const CheapestPair pair = cheapest(kErrorModels, *source.scene, i, j, side, source.net,
                                     source.log2_error_q8, false, source.counters);
  if (source.ways) ++source.ways[int(pair.way)];
  return pair.log2_exchange_q24;
}

bool exchange_by(const urad_scene& scene, const Patch& i, const Patch& j, Way way,
                 const urad_net* net, int32_t* log2_exchange_q24, PairTraits* traits) noexcept {
  Cuts cuts;
  PairKernel kernel;
  int32_t limit_q24 = 0;
  bool cut = false;
  if (!clipped_kernel(scene, i, j, &cuts, &kernel, &limit_q24, &cut)) return false;
  *traits = {};
  fill_traits(scene, i, j, cuts, kernel, traits);
  int32_t log2_g_q24 = least(by_kernel_q24(kernel), limit_q24);
  if (way == Way::network) {
    if (!net) return false;
    log2_g_q24 = by_network_q24(kernel, *net);
  } else if (way != Way::kernel) {
    const LambertSum sum = lambert_refined(scene, i, j, int(way) - int(Way::point) + 1, 0);
    if (sum.log2_exchange_q24 == kNoExchange) return false;
    fill_traits(sum, log2_g_q24, traits);
    log2_g_q24 = sum.log2_exchange_q24;
  }
  *log2_exchange_q24 = least(log2_g_q24, limit_q24);
  return true;
}

int refined_stops(const urad_scene& scene, const Patch& i, const Patch& j, RefinedStop* stop,
                  int room) noexcept {
  PairTraits traits;
  int32_t by_kernel = 0;
  LambertPair pair;
  if (!exchange_by(scene, i, j, Way::kernel, nullptr, &by_kernel, &traits) ||
      !lambert_pair(scene, i, j, &pair))
    return 0;
  LambertRun run(scene, pair, kRefinedPoints);
  int count = 0;
  do {
    const LambertSum sum = run.sum();
    if (sum.log2_exchange_q24 == kNoExchange) continue;
    fill_traits(sum, by_kernel, &traits);
    stop[count++] = {sum.log2_exchange_q24, traits};
  } while (count < room && run.halve_worst());
  return count;
}

}  // namespace urad
