// cheapest.hpp -- the cheapest way to a form factor that is accurate enough, and how accurate it
// is.
//
//   kernel       moment kernel; with third moments, where a patch has no centre of symmetry and
//                they may matter                                               third_order.hpp
//   network      moment kernel times a general network, if there is one
//   point        exact sum at the carrier's middle (of each of its pieces)              lambert.hpp
//   four points  exact sum at 2 x 2 points of each piece
//   nine points  exact sum at 3 x 3 points of each piece
//   refined      exact sum at 3 x 3 points of cells, halved where they are in doubt
//
// in this order of cost. What a way is off by is guessed by a small network before it is gone, or,
// for sums, when it is (error_model.hpp). The networks are fitted to random pairs and moved until
// what they say holds for 99 % of other pairs (src/cheapest_models.hpp). Below that guess no estimate
// goes under what the grid of coordinates leaves open, or what cells may hold that no point has seen
// (src/cheapest_floor.hpp); kernel and network are not asked where moments say nothing
// (moments_do()).
#pragma once
#include "urad/error_guess.hpp"
#include "urad/form_factor.hpp"

namespace urad {

enum class Way : uint8_t { none, kernel, network, point, four_points, nine_points, refined };
inline constexpr int kWays = 7;

/// log2 G (Q7.24, or kNoExchange), how it was found, and the estimate of log2 of its relative error
/// (Q7.8): the true error is below it for 99 % of pairs of any kind. Of Way::none: -32767 where the
/// two cannot exchange anything; 0, all of it, where they lie on each other's planes within rounding.
struct CheapestPair {
  int32_t log2_exchange_q24;
  int16_t log2_error_q8;
  Way way;
  uint16_t point_sums;  ///< points of all the sums that were tried
  uint16_t cubics;      ///< of third moments (third_order.hpp)
};

/// The cheapest way whose estimate is at most 2^log2_error; if none is, the refined sum, which says
/// what it reached. net null: without networks. (i, j) and (j, i) give the same bits. Counted as
/// exchange_log2_q24() counts; a kernel alone counts as a far pair, a sum as a near one.
///   Cost   a pair for which the kernel will do: the kernel, 8 log2, 8 products of 16 bits; third
///          moments where they may matter
CheapestPair cheapest_exchange(const urad_scene& scene, const Patch& i, const Patch& j,
                               const urad_net* net, int16_t log2_error_q8,
                               urad_counters* counters) noexcept;

/// Its constants.
const ErrorModels& error_models() noexcept;

/// The same by other constants: what fits them.
CheapestPair cheapest_exchange(const ErrorModels& models, const urad_scene& scene, const Patch& i,
                               const Patch& j, const urad_net* net, int16_t log2_error_q8,
                               urad_counters* counters) noexcept;

/// One way, whatever it costs and however wrong it is, and the traits of the pair: what constants
/// are fitted to. The kernel goes without third moments. False when the pair exchanges nothing, or
/// only its sum can tell (`traits` is then undefined).
bool exchange_by(const urad_scene& scene, const Patch& i, const Patch& j, Way way,
                 const urad_net* net, int32_t* log2_exchange_q24, PairTraits* traits) noexcept;

/// A refined sum after so many halvings.
struct RefinedStop {
  int32_t log2_exchange_q24;
  PairTraits traits;
};

/// The sum at nine points and after each of the halvings that may follow, as long as there are some
/// and room for them; how many there are.
int refined_stops(const urad_scene& scene, const Patch& i, const Patch& j, RefinedStop* stop,
                  int room) noexcept;

/// For PairSource::exchange: the cheapest way below source.log2_error_q8, counted in
/// source.ways[kWays] where that is not null.
int32_t cheapest_of_source(const PairSource& source, const Patch& i, const Patch& j,
                           Side side) noexcept;

/// log2 of a relative error as an estimate is written: 0.01 is -1701. 1e-6 <= error <= 1.
inline constexpr int16_t kPercentError_q8 = -1701;

}  // namespace urad
