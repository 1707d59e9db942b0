// error_model.hpp -- what a form factor is off by, guessed by a small network from what was seen on
// the way to it.
//
//   log2 error = bias + shift[class] + sum skip_k t_k + sum out_h sigma(bias_h + sum weight_hk t_k)
//
// with traits t in Q7.8 (cheapest.hpp); error_guess.hpp works it out. A network, because errors have
// several causes: the order of a rule, an edge nearby, rounding; which of them rules is a bend that no
// sum of logarithms has.
//
//   Width   |t| <= 24, |weight| <= 12, |bias| <= 300, at most 26 traits: sums below 2^31
//   Cost    hidden (traits + 1) + traits products of 16 bits, hidden sigmoids
#pragma once
#include "urad/lambert.hpp"

namespace urad {

/// What errors follow. Logarithms to base 2 in Q7.8, within +-24; "carrier" is the patch that
/// carries the points.
enum Trait {
  trait_bends_carrier,  ///< 2 s + 12 a s + 4 |c s/(m.w)|: T2 if nothing cancelled
  trait_bends_receiver,
  trait_bend,            ///< |log2 of the bend|
  trait_rho,             ///< rho
  trait_cosine_carrier,  ///< p or q
  trait_cosine_receiver,
  trait_fill_carrier,  ///< slivers are low
  trait_fill_receiver,
  trait_size_carrier,  ///< s
  trait_size_receiver,
  trait_areas,   ///< the receiver's area by the carrier's
  trait_grain,   ///< a scene unit by the lower height: what rounded vertices can do
  trait_factor,  ///< the kernel's factor of the smaller patch
  trait_facing,  ///< -4 n_i.n_j; no logarithm
  trait_shapes,  ///< how many are no parallelograms; no logarithm. 0 with third moments: the same
                 ///< guess then does for all
  trait_cut,     ///< 4 where the receiver was cut and 8 where the carrier; no logarithm
  kPairTraits,
  trait_off = kPairTraits,  ///< |log2 of the sum by the kernel|
  trait_sum,                ///< from here on, SumTrait
  kTraits = trait_sum + kSumTraits
};

enum class PairClass : uint8_t {
  symmetric,  ///< two parallelograms: odd moments vanish
  lopsided,   ///< at least one of another shape
  near,       ///< rho above 0.35: walls that meet, large plates
  cut,        ///< at least one cut at the other's plane
};
inline constexpr int kPairClasses = 4;

struct PairTraits {
  int16_t log2_q8[kTraits];
  PairClass pair_class;
};

inline constexpr int kErrorHidden = 16;
inline constexpr int kErrorWeightLimit_q10 = 12 * 1024;

/// Neurons with a greater output weight come first: fewer of them tell whether an error is low enough
/// (error_within()). Weights of traits that the model does not have are 0.
struct ErrorModel {
  uint8_t traits;  ///< at most kPairTraits, or kTraits
  int16_t weight_q10[kErrorHidden][kTraits];
  int32_t hidden_bias_q18[kErrorHidden];
  int16_t out_q8[kErrorHidden], skip_q10[kTraits], bias_q8;
  int16_t shift_q8[kPairClasses];
};

/// Whether moments say something of a pair. Beyond, the series of which the kernel has two terms
/// diverges, and no network has been trained.
///   rho <= 0.35, and T2 at most 2 on either side if nothing cancelled
constexpr bool moments_do(const PairTraits& traits) noexcept {
  constexpr int16_t most_rho_q8 = -388, most_bends_q8 = 256;
  return traits.log2_q8[trait_rho] <= most_rho_q8 &&
         traits.log2_q8[trait_bends_carrier] <= most_bends_q8 &&
         traits.log2_q8[trait_bends_receiver] <= most_bends_q8;
}

/// By the ways that have one.
struct ErrorModels {
  ErrorModel kernel, network, point, four_points;
  ErrorModel refined;      ///< nine points, and what comes of halving them
  ErrorModel before_four;  ///< a guess at four points before they are computed: as often too low
                           ///< as too high
};

}  // namespace urad
