// error_guess.hpp -- the guess of an ErrorModel, and whether it is low enough, which takes less.
#pragma once
#include "urad/error_model.hpp"
#include "urad/sigmoid.hpp"

#if defined(__SSE2__) && (defined(__clang__) || __GNUC__ >= 12)
#define URAD_GUESS_VECTORS 1
#include "urad/error_guess_vectors.hpp"
#else
#define URAD_GUESS_VECTORS 0
#endif

namespace urad {

/// One neuron at a time.
namespace plain {

/// sum + weights times traits.
inline int32_t add_traits(int32_t sum, const int16_t* weight, const ErrorModel& model,
                          const PairTraits& traits) noexcept {
  sum = add_products(sum, weight, traits.log2_q8, kPairTraits);
  if (model.traits <= kPairTraits) return sum;
  return add_products(sum, weight + kPairTraits, traits.log2_q8 + kPairTraits,
                      kTraits - kPairTraits);
}

/// What all but the hidden neurons say.
inline int32_t linear_error_q8(const ErrorModel& model, const PairTraits& traits) noexcept {
  return model.bias_q8 + model.shift_q8[int(traits.pair_class)] +
         round_shift(add_traits(0, model.skip_q10, model, traits), 10);
}

/// What neuron h adds: between 0 and its output weight.
inline int32_t neuron_q8(const ErrorModel& model, const PairTraits& traits, int h) noexcept {
  constexpr int32_t kFlat_q11 = 32767;  // the sigmoid is flat beyond +-16
  const int32_t z_q11 =
      round_shift(add_traits(model.hidden_bias_q18[h], model.weight_q10[h], model, traits), 7);
  const int32_t flat_q11 = z_q11 > kFlat_q11 ? kFlat_q11 : z_q11 < -kFlat_q11 ? -kFlat_q11 : z_q11;
  return round_shift(model.out_q8[h] * int32_t{sigmoid_uq15(int16_t(flat_q11))}, 15);
}

inline int32_t error_q8(const ErrorModel& model, const PairTraits& traits) noexcept {
  int32_t error = linear_error_q8(model, traits);
  for (int h = 0; h < kErrorHidden; ++h) error += neuron_q8(model, traits, h);
  return error;
}

inline bool error_within(const ErrorModel& model, const PairTraits& traits,
                         int32_t most_q8) noexcept {
  int32_t low = linear_error_q8(model, traits), high = low;
  for (const int16_t out : model.out_q8) (out < 0 ? low : high) += out;
  for (int h = 0; low <= most_q8 && high > most_q8; ++h) {
    const int32_t added = neuron_q8(model, traits, h), out = model.out_q8[h];
    low += out < 0 ? added - out : added;
    high += out < 0 ? added : added - out;
  }
  return high <= most_q8;
}

}  // namespace plain

#if URAD_GUESS_VECTORS
namespace guesses = four_at_once;
#else
namespace guesses = plain;
#endif

/// log2 of the relative error, Q7.8.
inline int32_t error_q8(const ErrorModel& model, const PairTraits& traits) noexcept {
  return guesses::error_q8(model, traits);
}

/// Whether error_q8() is at most `most_q8`: neurons are asked until the others cannot change that.
inline bool error_within(const ErrorModel& model, const PairTraits& traits,
                         int32_t most_q8) noexcept {
  return guesses::error_within(model, traits, most_q8);
}

}  // namespace urad
